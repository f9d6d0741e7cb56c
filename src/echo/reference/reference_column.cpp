// reference_column.cpp -- the echoes of one lattice column, in the order of docs/concepts.

#include "echo/reference/reference_column.h"

#include <algorithm>
#include <cmath>

#include "echo/model/face_return.h"
#include "echo/model/mirror_facet.h"
#include "echo/model/ray_limits.h"
#include "echo/model/secondary_echo.h"

namespace insonify {
namespace {

Triple triple(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

MirrorSample mirror_sample(const Ray& ray, const RayHit& hit) {
  return MirrorSample::of(triple(ray.direction), triple(hit.bent), static_cast<float>(hit.distance));
}

}  // namespace

ColumnFrame::ColumnFrame(const Lattice& lattice, int column, const Pose& world_from_sonar) {
  const double cosine = lattice.cos_azimuth[column], sine = lattice.sin_azimuth[column];
  const bool cone = lattice.shape == BeamShape::kCone;
  const Eigen::Quaterniond& turn = world_from_sonar.orientation;
  along = turn * Vec3(cosine, cone ? 0 : sine, 0);
  up = turn * Vec3(0, 0, cone ? cosine : 1);
  across = cone ? turn * Vec3(0, cosine, 0) : up.cross(along);
  beside = turn * Vec3(0, cone ? sine : 0, 0);
}

Vec3 ColumnFrame::direction(const Lattice& lattice, int column, int row) const {
  return (along * double{lattice.cosines(column)[row]} + up * double{lattice.sines(column)[row]} + beside).normalized();
}

ReferenceColumn::ReferenceColumn(const TriangleScene& scene, const LeftOut* left_out, const PingPlan& plan,
                                 SecondarySampling sampling, int column, const Pose& world_from_sonar)
    : scene_(scene),
      left_out_(left_out),
      plan_(plan),
      sampling_(sampling),
      column_(column),
      rows_(plan.lattice.rows),
      world_from_sonar_(world_from_sonar),
      frame_(plan.lattice, column, world_from_sonar),
      rays_(rows_),
      first_(rows_),
      strip_(1, rows_),
      hits_(strip_.column(0)),
      segments_(rows_) {
  hits_.rows = rows_;
  hits_.has_relief = scene.has_relief();
}

Ray ReferenceColumn::ray_of(int column, int row) const {
  const ColumnFrame frame = column == column_ ? frame_ : ColumnFrame(plan_.lattice, column, world_from_sonar_);
  return {world_from_sonar_.position, frame.direction(plan_.lattice, column, row), 0, plan_.true_max_range};
}

// Traces one ray per row to its first surface.
void ReferenceColumn::trace_primary_rays(const Workers& workers) {
  for (int row = 0; row < rows_; ++row) {
    workers.check_stop();
    rays_[row] = ray_of(column_, row);
    first_[row] = scene_.nearest(rays_[row]);
    if (first_[row].met()) {
      store_hit(row);
    }
  }
  counts_.primary += rows_;
  make_normals_unit(plan_, hits_);
}

void ReferenceColumn::store_hit(int row) {
  const RayHit& hit = first_[row];
  const Vec3f normal = hit.normal.cast<float>(), direction = rays_[row].direction.cast<float>();
  hits_.surface[row] = hit.surface();
  hits_.triangle[row] = scene_.in_mesh(hit);
  hits_.range[row] = static_cast<float>(hit.distance);
  hits_.normal_x[row] = normal.x();
  hits_.normal_y[row] = normal.y();
  hits_.normal_z[row] = normal.z();
  hits_.reflectivity[row] = hit.reflectivity;
  hits_.gradient_x[row] = hit.gradient.x();
  hits_.gradient_y[row] = hit.gradient.y();
  hits_.gradient_z[row] = hit.gradient.z();
  hits_.texture[row] = hit.texture;
  hits_.direction_x[row] = direction.x();
  hits_.direction_y[row] = direction.y();
  hits_.direction_z[row] = direction.z();
}

// scattering.md, "Curved surfaces": the share sqrt(s^4 / det S) and the sine s sqrt(w' S^-1 w), from the matrix.
LobeWidening<double> ReferenceColumn::widening(int row) const {
  if (!hits_.curved) {
    return {};
  }
  const Vec3 ray = rays_[row].direction, normal = hits_.has_relief ? first_[row].bent : first_[row].normal;
  const Vec3 up = Vec3f(hits_.turn_up_x[row], hits_.turn_up_y[row], hits_.turn_up_z[row]).cast<double>();
  const Vec3 side = Vec3f(hits_.turn_side_x[row], hits_.turn_side_y[row], hits_.turn_side_z[row]).cast<double>();
  const Vec3 one = ray.unitOrthogonal(), two = ray.cross(one);
  const auto across = [&](const Vec3& v) { return Eigen::Vector2d(v.dot(one), v.dot(two)); };
  const Eigen::Vector2d u = across(up), v = across(side), w = across(normal);
  const double variance = std::pow(plan_.scatter.scattering(hits_.surface[row]).rms_slope, 2);
  const Eigen::Matrix2d covariance =
      variance * Eigen::Matrix2d::Identity() + double{kFootprintVariance} * (u * u.transpose() + v * v.transpose());
  const double sine_square = variance * w.dot(covariance.inverse() * w);
  return {.share = variance * variance / covariance.determinant(), .spared = w.dot(w) - sine_square};
}

// What each row's echo adds to the grid per unit of solid angle: docs/concepts/calibrated-model.md, "An echo", and
// paper-model.md, "From a hit to an echo".
void ReferenceColumn::compute_powers() {
  const double gamma = plan_.neper_per_metre;
  for (int row = 0; row < rows_; ++row) {
    if (!first_[row].met()) {
      hits_.strength[row] = hits_.power[row] = 0;
    } else if (plan_.model == EchoModel::kCalibrated) {
      const double texture = hits_.has_relief ? first_[row].texture : 1.0F;
      hits_.power[row] =
          static_cast<float>(primary_intensity(plan_.scatter.scattering(hits_.surface[row]), hits_.facing[row], texture,
                                               gamma, first_[row].distance, widening(row)));
    } else {
      const double strength =
          paper_strength(hits_.facing[row], first_[row].reflectivity, gamma, 2 * first_[row].distance);
      hits_.strength[row] = static_cast<float>(strength);
      hits_.power[row] = static_cast<float>(plan_.shape.model().shape(strength));
    }
  }
}

// How the echoes of the rows are spread over range bins: paper-model.md, "From echoes to bins".
void ReferenceColumn::deposit_primary_echoes(EchoGrid& grid) {
  SurfaceSums sums;
  sums.prepare(plan_.sonar.bin_count);
  measure_column(
      plan_, column_,
      {frame_.along.cast<float>(), frame_.across.cast<float>(), frame_.up.cast<float>(), frame_.beside.cast<float>()},
      hits_, segments_);
  compute_powers();
  if (left_out_ != nullptr) {
    leave_out(*left_out_, plan_, hits_);
  }
  finish_column(plan_, sampling_, column_, hits_, segments_);
  deposit_column(plan_, column_, hits_, segments_, sums, grid);
}

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
  if (other < plan_.lattice.columns) {
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
      FacetSlopes::of(static_cast<std::uint32_t>(column_), static_cast<std::uint32_t>(row), plan_.stagger);
  const float slope = plan_.has_facets()
                          ? facet_slope(1 / std::sqrt(2 * plan_.scatter.steepness(hits_.surface[row])),
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
    const MirrorFacet facet =
        mirror_facet(triple(rays_[row].direction), triple(normal), triple(first_[row].gradient.cast<double>()), slope,
                     slopes, diffraction.tilt);
    normal = Vec3(facet.normal.x, facet.normal.y, facet.normal.z).normalized();
    share = facet.share;
    if (share == 0) {
      return {};
    }
  }
  const Vec3 direction = rays_[row].direction - 2 * rays_[row].direction.dot(normal) * normal;
  Reflection path{.row = row, .share = share};
  path.ray = {point, direction.normalized(), kRayClearance, plan_.reach()};
  path.second = scene_.nearest(path.ray);
  ++counts_.secondary;
  if (!path.second.met()) {
    return {};
  }
  path.point = path.ray.origin + path.ray.direction * path.second.distance;
  path.back = world_from_sonar_.position - path.point;
  path.there = static_cast<float>(first_[row].distance + path.second.distance);
  path.returned = edges.finite ? returned(edges, row, path) : 1;
  path.path_length = static_cast<float>(first_[row].distance + path.second.distance + path.back.norm());
  path.footprint =
      path_footprint(change_along(row), hits_.selected[row], change_across(row),
                     {static_cast<float>(path.second.distance), triple(path.ray.direction), triple(path.second.bent),
                      triple(-path.back.normalized()), path.there, static_cast<float>(path.back.norm())});
  return path;
}

// multipath.md, "Mirrors of finite size": the share of the sound that comes back by the face.
float ReferenceColumn::returned(const FaceEdges& edges, int row, const Reflection& path) const {
  const Triple direction = triple(rays_[row].direction), normal = triple(first_[row].bent),
               half = triple(path.ray.direction) - direction;
  const float cosine = std::abs(hits_.facing[row]);
  const float slope = 1 / std::sqrt(2 * plan_.scatter.steepness(hits_.surface[row]));
  const auto side = [&](int axis) {
    const Triple& along = edges.axes[axis];
    return face_side(edges.low[axis], edges.high[axis], half.dot(along) / std::abs(half.dot(normal)),
                     direction.dot(along), cosine, slope);
  };
  const double near = first_[row].distance, across = path.second.distance;
  return face_return(side(0), side(1), fast_exp(-plan_.mirror_roughness(hits_.surface[row]) * cosine * cosine),
                     static_cast<float>(near * across / (near + across)), plan_.wavelength());
}

// Whether the straight line from the second surface to the sonar is unobstructed.
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
      double{hits_.strength[path.row]} *
      paper_strength(path.second.bent.dot(path.ray.direction), path.second.reflectivity, plan_.neper_per_metre, rest);
  Echo echo =
      secondary_echo(plan_, column_, path.row, hits_.selected[path.row], path.path_length, path.second.surface());
  echo.half_length = path.footprint.once;
  echo.power = static_cast<float>(plan_.shape.model().shape(strength));
  deposit(plan_, echo, grid);
}

// multipath.md, "Three echoes": the intensities dI_1 and dI_2.
MirrorIntensities ReferenceColumn::intensities(const Reflection& path) const {
  const RayHit& mirror = first_[path.row];
  const Vec3 in = -path.ray.direction, out = path.back.normalized();
  const double across = path.second.distance, there = mirror.distance + across;
  const RayTube tube = scene_.tube(mirror, rays_[path.row].direction);
  const double tube_area =
      std::abs(double{tube.constant} + across * (double{tube.linear} + across * double{tube.quadratic}));
  return mirror_intensities({.mirror = plan_.scatter.scattering(mirror.surface()),
                             .second = plan_.scatter.scattering(path.second.surface()),
                             .incidence = mirror.bent.dot(rays_[path.row].direction),
                             .mirror_texture = mirror.texture,
                             .second_texture = path.second.texture,
                             .share = path.share,
                             .there = there,
                             .back = path.back.norm(),
                             .spread = tube_area / (there * there),
                             .returned = path.returned,
                             .in = path.second.bent.dot(in),
                             .out = path.second.bent.dot(out),
                             .half = path.second.bent.dot((in + out).normalized()),
                             .facet = in.dot((in + out).normalized())},
                            plan_.neper_per_metre);
}

// multipath.md, "Back by the water's surface": out by the mirror and back by the surface, and the reciprocal path.
void ReferenceColumn::deposit_echoes_by_water(const Reflection& path, EchoGrid& grid, std::vector<Echo>& arrivals) {
  const WaterPlane& water = scene_.water();
  const float weight = water_weight(plan_, column_, path.row);
  if (plan_.max_surfaces < 3 || !water.exists() || water.holds(path.ray.origin.z()) || weight == 0) {
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
  const double incidence = std::abs(mirror.bent.dot(rays_[path.row].direction));
  const double reflected = double{path.share} * reflecting.reflectance(incidence) * reflecting.mirror_share(incidence) *
                           std::pow(double{mirror.texture}, 2);
  const double power =
      water_intensity(plan_, *back, plan_.scatter.scattering(path.second.surface()), double{path.second.texture},
                      reflected, path.second.bent, path.ray.direction, double{path.there});
  if (power == 0 || !plan_.receives(direction)) {
    return;
  }
  counts_.return_legs += 2;
  const double last = (back->bounce - sonar).norm(), near = double{kRayClearance} / std::max(back->out.z(), 0.02);
  if (scene_.blocked({path.point, back->out, double{kRayClearance}, back->length - last - near}) ||
      scene_.blocked({back->bounce, (sonar - back->bounce) / last, near, last - double{kRayClearance}})) {
    return;
  }
  const PingPlan::Arrival arrival = plan_.arrival_from(direction);
  Echo echo = secondary_echo(plan_, column_, path.row, hits_.selected[path.row],
                             path.there + static_cast<float>(back->length), path.second.surface());
  echo.order = 3;
  echo.weight *= weight;
  echo.half_length =
      path_footprint(change_along(path.row), hits_.selected[path.row], change_across(path.row),
                     {static_cast<float>(path.second.distance), triple(path.ray.direction), triple(path.second.bent),
                      triple(-back->out), path.there, static_cast<float>(back->length)})
          .once;
  const float received = static_cast<float>(power) * arrival.pattern;
  echo.power = received * arrival.transmitted / plan_.lattice.transmitted[column_];  // The reciprocal path.
  deposit(plan_, echo, grid);
  echo.power = received;
  echo.azimuth = arrival.bearing;
  echo.elevation = arrival.elevation;
  arrivals.push_back(echo);
}

// multipath.md, "Three echoes": the echo by the mirror both ways, and the two reciprocal echoes by the mirror one way.
// One of these arrives from the mirror; the other from the second surface, so that it may be in another beam.
void ReferenceColumn::deposit_mirror_echoes(const Reflection& path, EchoGrid& grid, std::vector<Echo>& arrivals) {
  const MirrorIntensities intensity = intensities(path);
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
  const PingPlan::Arrival arrival = plan_.arrival_from(arrival_direction);
  echo.half_length = path.footprint.once;
  const float power = static_cast<float>(intensity.once) * arrival.pattern;
  echo.power = power * arrival.transmitted / plan_.lattice.transmitted[column_];  // The reciprocal path.
  deposit(plan_, echo, grid);
  echo.power = power;
  echo.azimuth = arrival.bearing;
  echo.elevation = arrival.elevation;
  arrivals.push_back(echo);
}

RayCounts ReferenceColumn::insonify(EchoGrid& grid, std::vector<Echo>& arrivals, const Workers& workers) {
  deposit_primary_echoes(grid);
  for (int row = 0; row < rows_ && sampling_ != SecondarySampling::kNone; ++row) {
    workers.check_stop();
    if (hits_.selected[row] == 0) {
      continue;
    }
    const std::optional<Reflection> path = reflect(row);
    if (path && plan_.model == EchoModel::kCalibrated) {
      deposit_mirror_echoes(*path, grid, arrivals);
    } else if (path) {
      deposit_paper_echo(*path, grid);
    }
  }
  return counts_;
}

}  // namespace insonify
