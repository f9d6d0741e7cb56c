// reference_reflections.cpp -- the secondary echoes of one lattice column: reflected rays, and their ways back.

#include <algorithm>
#include <cmath>

#include "echo/laws/laws.h"
#include "echo/mirror/double_passage.h"
#include "echo/mirror/secondary_echo.h"
#include "echo/model/hit.h"
#include "echo/reference/reference_column.h"

namespace insonify {
namespace {

Triple triple(const Vec3& v) {
  return triple_of(v.cast<float>());
}

MirrorSample mirror_sample(const Ray& ray, const RayHit& hit) {
  return mirror_sample(triple(ray.direction), triple(hit.bent), static_cast<float>(hit.distance));
}

}  // namespace

// multipath.md, "Footprints": the change to the next row above, or else below, if it hit the same surface.
MirrorChange ReferenceColumn::change_along(int row) const {
  for (const int other : {row + 1, row - 1}) {
    if (other >= 0 && other < rows_ && hits_.surface[other] == hits_.surface[row]) {
      return mirror_change(mirror_sample(rays_[row], first_[row]), mirror_sample(rays_[other], first_[other]));
    }
  }
  return {};
}

// The same for the neighbouring column.
MirrorChange ReferenceColumn::change_across(int row) const {
  const int other = column_ ^ 1;
  if (other < plan_.lattice.columns && plan_.lattice.touches_next(std::min(column_, other))) {
    const Ray ray = ray_of(other, row);
    const RayHit hit = scene_.nearest(ray);
    if (hit.met() && hit.surface() == hits_.surface[row]) {
      return mirror_change(mirror_sample(rays_[row], first_[row]), mirror_sample(ray, hit));
    }
  }
  return {};
}

// multipath.md, "Three echoes": traces the reflected ray of a hit. A rough mirror reflects it by one facet or as a
// smooth one; see "Rough mirrors" there. None if the ray hits nothing.
std::optional<ReferenceColumn::Reflection> ReferenceColumn::reflect(int row) {
  Vec3 normal = first_[row].bent;
  float share = 1;
  const FacetSlopes slopes =
      facet_slopes(static_cast<std::uint32_t>(column_), static_cast<std::uint32_t>(row), plan_.stagger);
  const float slope = plan_.has_facets()
                          ? facet_slope(slope_of(plan_.scatter.steepness(hits_.surface[row])),
                                        plan_.mirror_roughness(hits_.surface[row]), hits_.facing[row], slopes.pick)
                          : 0;
  const Vec3 point = rays_[row].origin + rays_[row].direction * first_[row].distance;
  FaceEdges edges;
  if (plan_.model == EchoModel::kCalibrated) {
    edges = scene_.face_edges(first_[row], point);
  }
  const FaceTilt diffraction = FaceTilt::of(edges, static_cast<std::uint32_t>(column_), static_cast<std::uint32_t>(row),
                                            plan_.stagger, plan_.wavelength(), hits_.facing[row]);
  if (slope > 0 || edges.finite) {
    const MirrorFacet facet = mirror_facet(triple(rays_[row].direction), triple(normal),
                                           triple_of(first_[row].gradient), slope, slopes, diffraction.tilt);
    normal = Vec3(facet.normal.x, facet.normal.y, facet.normal.z).normalized();
    share = facet.share;
    if (share == 0) {
      return {};
    }
  }
  const Vec3 direction = rays_[row].direction - 2 * rays_[row].direction.dot(normal) * normal;
  Reflection path{.row = row, .share = share, .edges = edges};
  path.ray = {point, direction.normalized(), kRayClearance, plan_.reach()};
  path.second = scene_.nearest(path.ray);
  ++counts_.secondary;
  if (!path.second.met()) {
    return {};
  }
  path.point = path.ray.origin + path.ray.direction * path.second.distance;
  path.back = world_from_sonar_.position - path.point;
  path.there = static_cast<float>(first_[row].distance + path.second.distance);
  path.path_length = static_cast<float>(first_[row].distance + path.second.distance + path.back.norm());
  path.footprint =
      path_footprint(change_along(row), hits_.selected[row], change_across(row),
                     {static_cast<float>(path.second.distance), triple(path.ray.direction), triple(path.second.bent),
                      triple(-path.back.normalized()), path.there, static_cast<float>(path.back.norm())});
  return path;
}

// Whether the straight path from the second surface to the sonar is unobstructed.
bool ReferenceColumn::return_leg_is_clear(const Reflection& path) {
  ++counts_.return_legs;
  return !scene_.blocked({path.point, path.back.normalized(), kRayClearance, path.back.norm() - double{kRayClearance}});
}

// paper-model.md, "Secondary echoes": one echo, in the beam of launch. Its strength is the product of both surfaces'
// and of the absorption along the whole path.
void ReferenceColumn::deposit_paper_echo(const Reflection& path, EchoGrid& grid) {
  if (0.5F * path.path_length >= plan_.reach() || !return_leg_is_clear(path)) {
    return;
  }
  const double rest = double{path.path_length} - 2 * first_[path.row].distance;
  const double strength =
      double{hits_.strength[path.row]} * precise::paper_strength(path.second.bent.dot(path.ray.direction),
                                                                 path.second.reflectivity, plan_.neper_per_metre, rest);
  Echo echo =
      secondary_echo(plan_, column_, path.row, hits_.selected[path.row], path.path_length, path.second.surface());
  echo.half_length = path.footprint.once;
  echo.power = static_cast<float>(plan_.shape.model().shape(strength));
  deposit(plan_, echo, grid);
}

// multipath.md, "Rough mirrors": double_passage() of a path.
double ReferenceColumn::interference(const Reflection& path, const Vec3& smooth,
                                     const precise::FacetReturn& over) const {
  const auto seen = [&](const Vec3& direction) { return triple(world_from_sonar_.orientation.inverse() * direction); };
  return double{double_passage(plan_, column_,
                               {.to_mirror = seen(rays_[path.row].direction),
                                .specular = seen(smooth),
                                .on = seen(path.ray.direction),
                                .range = static_cast<float>(first_[path.row].distance),
                                .across = static_cast<float>(path.second.distance),
                                .over = {static_cast<float>(over.glint), static_cast<float>(over.variance),
                                         static_cast<float>(over.coherence)}})};
}

// multipath.md, "Three echoes", "Mirrors of finite size" and "Rough mirrors": the intensities dI_1 and dI_2.
precise::MirrorIntensities ReferenceColumn::intensities(const Reflection& path) const {
  const RayHit& mirror = first_[path.row];
  const Scattering& reflecting = plan_.scatter.scattering(mirror.surface());
  const precise::Triple direction = precise::triple_of(rays_[path.row].direction),
                        normal = precise::triple_of(mirror.bent), on = precise::triple_of(path.ray.direction),
                        second = precise::triple_of(path.second.bent);
  const double across = path.second.distance, there = mirror.distance + across, rho = mirror.distance * across / there;
  const double cosine = std::abs(precise::dot(direction, normal)), slope = reflecting.rms_slope;
  const double coherence = precise::coherent_share(plan_.mirror_roughness(mirror.surface()), cosine);
  const FaceEdges& edges = path.edges;
  const auto side = [&](int axis) {
    const precise::Triple along = {edges.axes[axis].x, edges.axes[axis].y, edges.axes[axis].z};
    return precise::face_side_of_ray(edges.low[axis], edges.high[axis], along, direction, on, normal, cosine, slope);
  };
  const precise::SecondAngles at = precise::second_angles(second, -1 * on, precise::triple_of(path.back.normalized()));
  precise::FacetReturn over = {at.arriving, 0, 1};
  double in_phase = 1;
  if (plan_.has_facets()) {
    const double held = edges.finite ? precise::held_on_face(side(0), side(1), rho) : 1;
    const precise::Triple smooth = precise::reflect(direction, normal);
    over = precise::facet_return({slope, coherence, cosine, mirror.distance, across, held}, on, smooth, second);
    in_phase = interference(path, {smooth.x, smooth.y, smooth.z}, over);
  }
  precise::MirrorIntensities intensities = precise::mirror_intensities(
      {.reflectance = precise::mirrored_by(reflecting, cosine) * std::pow(double{mirror.texture}, 2),
       .share = path.share,
       .there = there,
       .back = path.back.norm(),
       .spread = precise::tube_spread(scene_.tube(mirror, rays_[path.row].direction), across, there),
       .returned = edges.finite ? precise::face_return(side(0), side(1), coherence, rho, plan_.wavelength()) : 1,
       .at = at,
       .texture = path.second.texture,
       .over = over},
      precise::second_surface_of(plan_.scatter.scattering(path.second.surface()), at, slope), plan_.neper_per_metre);
  intensities.twice *= in_phase;
  return intensities;
}

// multipath.md, "Return over the water's surface": out over the mirror and back over the surface, and the reciprocal
// path.
void ReferenceColumn::deposit_echoes_by_water(const Reflection& path, EchoGrid& grid, std::vector<Echo>& arrivals) {
  const WaterPlane& water = scene_.water();
  const float weight = water_weight(plan_, column_, path.row);
  if (plan_.max_surfaces < 3 || !water.exists() || scene_.bends() || water.holds(path.ray.origin.z()) || weight == 0) {
    return;
  }
  const Vec3& sonar = world_from_sonar_.position;
  const std::optional<WaterPath> back = WaterPath::of(plan_, water, sonar, path.point);
  if (!back || 0.5 * (double{path.there} + back->length) >= double{plan_.reach()}) {
    return;
  }
  const Vec3f direction = (world_from_sonar_.orientation.inverse() * back->arrival).cast<float>();
  const RayHit& mirror = first_[path.row];
  const Scattering& reflecting = plan_.scatter.scattering(mirror.surface());
  const double reflected = double{path.share} *
                           precise::mirrored_by(reflecting, mirror.bent.dot(rays_[path.row].direction)) *
                           std::pow(double{mirror.texture}, 2);
  const double power =
      water_intensity(plan_, *back, plan_.scatter.scattering(path.second.surface()), double{path.second.texture},
                      reflected, path.second.bent, path.ray.direction, double{path.there});
  if (power == 0 || !plan_.receives(direction)) {
    return;
  }
  counts_.return_legs += 2;
  const double last = back->length - back->first;
  if (scene_.blocked({path.point, back->out, double{kRayClearance}, back->first - back->near}) ||
      scene_.blocked({back->bounce, -back->arrival, back->near, last - double{kRayClearance}})) {
    return;
  }
  Echo echo = secondary_echo(plan_, column_, path.row, hits_.selected[path.row],
                             path.there + static_cast<float>(back->length), path.second.surface());
  echo.order = 3;
  echo.weight *= weight;
  echo.half_length =
      path_footprint(change_along(path.row), hits_.selected[path.row], change_across(path.row),
                     {static_cast<float>(path.second.distance), triple(path.ray.direction), triple(path.second.bent),
                      triple(-back->out), path.there, static_cast<float>(back->length)})
          .once;
  const ReciprocalEchoes echoes =
      reciprocal_echoes(plan_, column_, path.row, echo, static_cast<float>(power), plan_.arrival_from(direction));
  deposit(plan_, echoes.launched, grid);
  arrivals.push_back(echoes.arriving);
}

// multipath.md, "Three echoes": the echo over the mirror both ways, and the two reciprocal echoes over the mirror one
// way. One of these arrives from the mirror; the other from the second surface, so that it may be in another beam.
void ReferenceColumn::deposit_mirror_echoes(const Reflection& path, EchoGrid& grid, std::vector<Echo>& arrivals) {
  const precise::MirrorIntensities intensity = intensities(path);
  Echo echo =
      secondary_echo(plan_, column_, path.row, hits_.selected[path.row], path.path_length, path.second.surface());
  if (plan_.max_surfaces > 2 && path.there < plan_.reach()) {
    Echo twice = echo;
    twice.order = 3;
    twice.path_length = 2 * path.there;
    twice.half_length = path.footprint.twice;
    twice.power = static_cast<float>(intensity.twice) * plan_.lattice.pattern_in(column_)[path.row];
    deposit(plan_, twice, grid);
  }
  deposit_echoes_by_water(path, grid, arrivals);
  const Vec3 towards = world_from_sonar_.orientation.inverse() * -path.back.normalized();
  const Vec3f arrival_direction = towards.cast<float>();
  if (intensity.once == 0 || 0.5F * echo.path_length >= plan_.reach() || !plan_.receives(arrival_direction) ||
      !return_leg_is_clear(path)) {
    return;
  }
  echo.half_length = path.footprint.once;
  const ReciprocalEchoes echoes = reciprocal_echoes(plan_, column_, path.row, echo, static_cast<float>(intensity.once),
                                                    plan_.arrival_from(arrival_direction));
  deposit(plan_, echoes.launched, grid);
  arrivals.push_back(echoes.arriving);
}

}  // namespace insonify
