// reference_column.cpp -- one column at a time: out and straight back, and on to a second surface.

#include <algorithm>
#include <cmath>

#include "echo/model/mirror_facet.h"
#include "echo/model/mirror_paths.h"
#include "echo/model/ray_limits.h"
#include "echo/model/secondary_echo.h"
#include "echo/reference/reference_engine.h"

namespace insonify {
namespace {

Triple triple(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// ColumnAxes in double precision, in the world.
struct ColumnFrame {
  Vec3 along, across, up, beside;

  ColumnFrame(const Lattice& lattice, int column, const Pose& world_from_sonar) {
    const double cosine = lattice.cos_azimuth[column], sine = lattice.sin_azimuth[column];
    const bool cone = lattice.shape == BeamShape::kCone;
    const Eigen::Quaterniond& turn = world_from_sonar.orientation;
    along = turn * Vec3(cosine, cone ? 0 : sine, 0);
    up = turn * Vec3(0, 0, cone ? cosine : 1);
    across = cone ? turn * Vec3(0, cosine, 0) : up.cross(along);
    beside = turn * Vec3(0, cone ? sine : 0, 0);
  }
  [[nodiscard]] Vec3 direction(const Lattice& lattice, int column, int row) const {
    return (along * double{lattice.cosines(column)[row]} + up * double{lattice.sines(column)[row]} + beside)
        .normalized();
  }
};

}  // namespace

RayTube ReferenceEngine::tube(const Meeting& mirror, const Vec3& direction) const {
  const Triangle& triangle = triangles_[mirror.triangle];
  const std::array<Vec3f, 3> corners = {Vec3f::Zero(), triangle.edge1.cast<float>(), triangle.edge2.cast<float>()};
  std::array<Vec3f, 3> normals;
  std::ranges::transform(triangle.normal, normals.begin(), [](const Vec3& normal) { return normal.cast<float>(); });
  return ray_tube(corners, normals, direction.cast<float>(), mirror.bent.cast<float>(),
                  static_cast<float>(mirror.distance));
}

void ReferenceEngine::return_mirrored(const PingPlan& plan, const Pose& world_from_sonar, const Mirrored& mirrored,
                                      EchoGrid& grid, std::vector<Echo>& arrivals, RayCounts& counts) const {
  const Meeting& second = mirrored.second;
  const Vec3 point = mirrored.across.origin + mirrored.across.direction * second.distance;
  const Vec3 back = world_from_sonar.position - point;
  const Vec3 in = -mirrored.across.direction, out = back.normalized();
  MirrorPaths paths = {};
  std::ranges::fill(paths.surface, kNoSurface);
  paths.reflectance[0] = mirrored.reflectance;
  paths.share[0] = mirrored.share;
  paths.steepness[0] = mirrored.steepness;
  paths.there[0] = static_cast<float>(mirrored.range + second.distance);
  const auto across = static_cast<float>(second.distance);
  const RayTube& tube = mirrored.tube;
  paths.spread[0] =
      std::abs(tube.constant + across * (tube.linear + across * tube.quadratic)) / (paths.there[0] * paths.there[0]);
  paths.back[0] = static_cast<float>(back.norm());
  paths.in[0] = static_cast<float>(second.bent.dot(in));
  paths.out[0] = static_cast<float>(second.bent.dot(out));
  paths.half[0] = static_cast<float>(second.bent.dot((in + out).normalized()));
  paths.texture[0] = second.texture;
  paths.surface[0] = second.surface();
  MirrorPowers powers;
  fill_mirror_powers(plan.scatter, plan.neper_per_metre, paths, powers);

  Echo echo = mirrored.echo;
  if (plan.max_surfaces > 2 && paths.there[0] < plan.reach()) {
    Echo twice = echo;
    twice.order = 3;
    twice.path_length = 2 * paths.there[0];
    twice.half_length = mirrored.footprint.twice;
    twice.power = powers.twice[0] * mirrored.pattern;
    deposit(plan, twice, grid);
  }
  const Vec3f arrival_direction = (world_from_sonar.orientation.inverse() * -out).cast<float>();
  if (powers.once[0] == 0 || 0.5F * echo.path_length >= plan.reach() || !plan.receives(arrival_direction)) {
    return;
  }
  ++counts.return_legs;
  if (blocked({point, out, kRayClearance, back.norm() - double{kRayClearance}})) {
    return;
  }
  const PingPlan::Arrival arrival = plan.arrival_from(arrival_direction);
  echo.half_length = mirrored.footprint.once;
  echo.power = powers.once[0] * arrival.pattern;
  deposit(plan, echo, grid);
  echo.azimuth = arrival.bearing;
  echo.elevation = arrival.elevation;
  arrivals.push_back(echo);
}

void ReferenceEngine::insonify_column(const PingPlan& plan, SecondarySampling sampling, int column,
                                      const Pose& world_from_sonar, EchoGrid& grid, std::vector<Echo>& arrivals,
                                      RayCounts& counts) const {
  const Lattice& lattice = plan.lattice;
  const int rows = lattice.rows;
  const ColumnFrame frame(lattice, column, world_from_sonar);

  // Out: what does each row meet first?
  std::vector<Meeting> first(rows);
  std::vector<Ray> rays(rows);
  HitStrip strip(1, rows);
  HitColumn hits = strip.column(0);
  hits.rows = rows;
  hits.has_relief = reliefs_.any();
  FootprintSegments segments(rows);
  SurfaceSums sums;
  sums.prepare(plan.sonar.bin_count);
  for (int row = 0; row < rows; ++row) {
    rays[row] = {world_from_sonar.position, frame.direction(lattice, column, row), 0, plan.true_max_range};
    first[row] = nearest(rays[row]);
    if (first[row].met()) {
      hits.surface[row] = first[row].surface();
      hits.range[row] = static_cast<float>(first[row].distance);
      hits.normal_x[row] = static_cast<float>(first[row].normal.x());
      hits.normal_y[row] = static_cast<float>(first[row].normal.y());
      hits.normal_z[row] = static_cast<float>(first[row].normal.z());
      hits.reflectivity[row] = first[row].reflectivity;
      hits.gradient_x[row] = first[row].gradient.x();
      hits.gradient_y[row] = first[row].gradient.y();
      hits.gradient_z[row] = first[row].gradient.z();
      hits.texture[row] = first[row].texture;
      hits.direction_x[row] = static_cast<float>(rays[row].direction.x());
      hits.direction_y[row] = static_cast<float>(rays[row].direction.y());
      hits.direction_z[row] = static_cast<float>(rays[row].direction.z());
    }
  }
  counts.primary += rows;

  // Straight back.
  evaluate_column(
      plan, sampling, column,
      {frame.along.cast<float>(), frame.across.cast<float>(), frame.up.cast<float>(), frame.beside.cast<float>()}, hits,
      segments);
  deposit_column(plan, column, hits, segments, sums, grid);
  if (sampling == SecondarySampling::kNone) {
    return;
  }

  // From a hit to one beside it on the same surface.
  const auto sample = [](const Ray& ray, const Meeting& meeting) {
    return MirrorSample::of(triple(ray.direction), triple(meeting.bent), static_cast<float>(meeting.distance));
  };
  const auto change = [&](int row, const Ray& ray, const Meeting& meeting) {
    return mirror_change(sample(rays[row], first[row]), sample(ray, meeting));
  };
  const auto change_above = [&](int row) {
    for (const int other : {row + 1, row - 1}) {
      if (other >= 0 && other < rows && hits.surface[other] == hits.surface[row]) {
        return change(row, rays[other], first[other]);
      }
    }
    return MirrorChange{};
  };
  const auto change_aside = [&](int row) {
    const int other = column ^ 1;
    if (other < plan.sonar.beam_count * lattice.columns_per_beam) {
      const Vec3 direction = ColumnFrame(lattice, other, world_from_sonar).direction(lattice, other, row);
      const Ray ray{world_from_sonar.position, direction, 0, plan.true_max_range};
      const Meeting meeting = nearest(ray);
      if (meeting.met() && meeting.surface() == hits.surface[row]) {
        return change(row, ray, meeting);
      }
    }
    return MirrorChange{};
  };

  // On to a second surface in the mirror direction, and from there straight back, if nothing is in the way.
  for (int row = 0; row < rows; ++row) {
    if (hits.selected[row] == 0) {
      continue;
    }
    const Vec3 point = rays[row].origin + rays[row].direction * first[row].distance;
    Vec3 normal = first[row].bent;
    float share = 1;
    if (plan.rough_mirrors && plan.model == EchoModel::kCalibrated) {
      const float slope = 1 / std::sqrt(2 * plan.scatter.steepness(hits.surface[row]));
      const FacetSlopes slopes =
          FacetSlopes::of(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), plan.stagger);
      const MirrorFacet facet = mirror_facet(triple(rays[row].direction), triple(normal),
                                             triple(first[row].gradient.cast<double>()), slope, slopes);
      normal = Vec3(facet.normal.x, facet.normal.y, facet.normal.z).normalized();
      share = facet.share;
      if (share == 0) {
        continue;
      }
    }
    const Vec3 mirrored = rays[row].direction - 2 * rays[row].direction.dot(normal) * normal;
    const Ray reflected{point, mirrored.normalized(), kRayClearance, plan.reach()};
    const Meeting second = nearest(reflected);
    ++counts.secondary;
    if (!second.met()) {
      continue;
    }
    const Vec3 second_point = reflected.origin + reflected.direction * second.distance;
    const Vec3 back = world_from_sonar.position - second_point;
    const auto there = static_cast<float>(first[row].distance + second.distance);
    const auto path_length = static_cast<float>(first[row].distance + second.distance + back.norm());
    const PathFootprint footprint =
        path_footprint(change_above(row), hits.selected[row], change_aside(row),
                       {static_cast<float>(second.distance), triple(reflected.direction), triple(second.bent),
                        triple(-back.normalized()), there, static_cast<float>(back.norm())});
    if (plan.model == EchoModel::kCalibrated) {
      const float texture = hits.has_relief ? hits.texture[row] : 1.0F;
      const float reflectance = plan.scatter.reflectance(hits.surface[row]) * texture * texture;
      const Echo echo = secondary_echo(plan, column, row, hits.selected[row], path_length, second.surface());
      return_mirrored(plan, world_from_sonar,
                      {echo, footprint, reflectance, share, plan.scatter.steepness(hits.surface[row]),
                       lattice.pattern_in(column)[row], first[row].distance, tube(first[row], rays[row].direction),
                       reflected, second},
                      grid, arrivals, counts);
      continue;
    }
    if (0.5F * path_length >= plan.reach()) {
      continue;
    }
    ++counts.return_legs;
    if (blocked({second_point, back.normalized(), kRayClearance, back.norm() - double{kRayClearance}})) {
      continue;
    }
    const auto incidence = static_cast<float>(std::abs(second.bent.dot(reflected.direction)));
    Echo echo = secondary_echo(plan, column, row, hits.selected[row], path_length, second.surface());
    echo.half_length = footprint.once;
    const float strength = hits.strength[row] * incidence * second.reflectivity;
    const float rest = path_length - 2 * hits.range[row];
    secondary_powers(plan, 1, &strength, &rest, &echo.power);
    deposit(plan, echo, grid);
  }
}

}  // namespace insonify
