// reference_engine.cpp -- brute force, written to be obviously right.

#include "echo/reference_engine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "echo/mirror_paths.h"
#include "echo/ray_limits.h"
#include "echo/secondary_echo.h"

namespace insonify {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Where a ray meets a triangle: distance and the weights of its second and third corner.
struct Crossing {
  double distance = kFar, u = 0, v = 0;
};

// Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection" (1997); both sides count.
Crossing cross_triangle(const Ray& ray, const Vec3& corner, const Vec3& edge1, const Vec3& edge2) {
  const Vec3 p = ray.direction.cross(edge2);
  const double determinant = edge1.dot(p);
  if (determinant == 0) {
    return {};
  }
  const Vec3 from_corner = ray.origin - corner;
  const double u = from_corner.dot(p) / determinant;
  const Vec3 q = from_corner.cross(edge1);
  const double v = ray.direction.dot(q) / determinant;
  const double distance = edge2.dot(q) / determinant;
  const bool inside = u >= 0 && v >= 0 && u + v <= 1;
  return inside && distance > ray.min_distance && distance < ray.max_distance ? Crossing{distance, u, v} : Crossing{};
}

}  // namespace

void ReferenceEngine::set_scene(const Scene& scene) {
  scene_ = &scene;
  triangles_.clear();
  first_triangle_.clear();
  reflectivity_.clear();
  const Box3 bounds = scene.bounds();
  origin_ = scene.instances.empty() ? Vec3::Zero() : Vec3(0.5 * (bounds.low + bounds.high));
  reliefs_.set(scene, origin_);
  for (const Material& material : scene.materials) {
    reflectivity_.push_back(static_cast<float>(material.effective_reflectivity()));
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    first_triangle_.push_back(triangles_.size());
    triangles_.resize(triangles_.size() + scene.instances[i].mesh->triangles.size());
    place_instance(static_cast<int>(i), scene.instances[i].world_from_mesh);
  }
}

void ReferenceEngine::move_instance(int instance, const Pose& world_from_mesh) {
  place_instance(instance, world_from_mesh);
  reliefs_.move(instance, world_from_mesh);
}

void ReferenceEngine::place_instance(int index, const Pose& world_from_mesh) {
  const Instance& instance = scene_->instances[index];
  const Mesh& mesh = *instance.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const auto corner = [&](int k) { return world_from_mesh * mesh.vertices[corners[k]].cast<double>().eval(); };
    Triangle& triangle = triangles_[first_triangle_[index] + t];
    triangle.corner = corner(0);
    triangle.edge1 = corner(1) - triangle.corner;
    triangle.edge2 = corner(2) - triangle.corner;
    for (int k = 0; k < 3; ++k) {
      triangle.normal[k] = world_from_mesh.orientation * mesh.normals[corners[k]].cast<double>();
    }
    triangle.instance = static_cast<std::uint16_t>(index);
    triangle.material = instance.materials[mesh.slot_of(t)];
  }
}

ReferenceEngine::Meeting ReferenceEngine::nearest(const Ray& ray) const {
  Crossing best;
  const Triangle* hit = nullptr;
  for (const Triangle& triangle : triangles_) {
    const Crossing crossing = cross_triangle(ray, triangle.corner, triangle.edge1, triangle.edge2);
    if (crossing.distance < best.distance) {
      best = crossing;
      hit = &triangle;
    }
  }
  if (hit == nullptr) {
    return {.distance = kFar};
  }
  const auto number = static_cast<std::size_t>(hit - triangles_.data()) - first_triangle_[hit->instance];
  const Vec3 normal =
      ((1 - best.u - best.v) * hit->normal[0] + best.u * hit->normal[1] + best.v * hit->normal[2]).normalized();
  const Vec3 point = ray.origin + best.distance * ray.direction;
  const ReliefPoint relief = reliefs_.at(hit->instance, static_cast<std::uint32_t>(number),
                                         (point - origin_).cast<float>(), normal.cast<float>());
  return {best.distance,
          normal,
          (normal - relief.gradient.cast<double>()).normalized(),
          relief.gradient,
          reflectivity_[hit->material] * relief.reflectivity,
          relief.reflectivity,
          hit->instance,
          hit->material,
          static_cast<std::size_t>(hit - triangles_.data())};
}

bool ReferenceEngine::blocked(const Ray& ray) const {
  for (const Triangle& triangle : triangles_) {
    if (cross_triangle(ray, triangle.corner, triangle.edge1, triangle.edge2).distance < kFar) {
      return true;
    }
  }
  return false;
}

void ReferenceEngine::trace(std::span<const Ray> rays, std::span<Hit> hits) {
  workers_.for_each(static_cast<int>(rays.size()), [&](int i, int) {
    const Meeting meeting = nearest(rays[i]);
    hits[i] = {.distance = meeting.distance};
    if (meeting.met()) {
      const bool from_behind = meeting.normal.dot(rays[i].direction) > 0;
      hits[i] = {meeting.distance, from_behind ? Vec3(-meeting.bent) : meeting.bent, meeting.instance, meeting.material,
                 meeting.reflectivity};
    }
  });
}

void ReferenceEngine::insonify(const PingPlan& plan, const Pose& world_from_sonar, std::uint64_t, EchoGrid& grid,
                               BeamSink* sink) {
  const int per_beam = plan.lattice.columns_per_beam;
  std::vector<RayCounts> counts(plan.sonar.beam_count);
  std::vector<std::vector<Echo>> arrivals(plan.sonar.beam_count);
  workers_.for_each(plan.sonar.beam_count, [&](int beam, int) {
    grid.clear(beam, beam + 1);
    for (int column = beam * per_beam; column < (beam + 1) * per_beam; ++column) {
      insonify_column(plan, column, world_from_sonar, grid, arrivals[beam], counts[beam]);
    }
  });
  for (const std::vector<Echo>& of_beam : arrivals) {
    for (const Echo& echo : of_beam) {
      deposit(plan, echo, grid);
    }
  }
  counts_ = {};
  for (const RayCounts& of_beam : counts) {
    counts_.primary += of_beam.primary;
    counts_.secondary += of_beam.secondary;
    counts_.return_legs += of_beam.return_legs;
  }
  if (sink != nullptr) {
    sink->take(0, plan.sonar.beam_count);
  }
}

MirrorTube ReferenceEngine::tube(const Meeting& mirror, const Vec3& direction) const {
  const Triangle& triangle = triangles_[mirror.triangle];
  const std::array<Vec3f, 3> corners = {Vec3f::Zero(), triangle.edge1.cast<float>(), triangle.edge2.cast<float>()};
  std::array<Vec3f, 3> normals;
  std::ranges::transform(triangle.normal, normals.begin(), [](const Vec3& normal) { return normal.cast<float>(); });
  return mirror_tube(corners, normals, direction.cast<float>(), mirror.bent.cast<float>(),
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
  paths.kept[0] = mirrored.kept;
  paths.steepness[0] = mirrored.steepness;
  paths.there[0] = static_cast<float>(mirrored.range + second.distance);
  const auto across = static_cast<float>(second.distance);
  const MirrorTube& tube = mirrored.tube;
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
  if (plan.max_surfaces > 2 && paths.there[0] < plan.true_max_range) {
    Echo twice = echo;
    twice.order = 3;
    twice.path_length = 2 * paths.there[0];
    twice.power = powers.twice[0] * mirrored.heard;
    deposit(plan, twice, grid);
  }
  const Vec3f heard_from = (world_from_sonar.orientation.inverse() * -out).cast<float>();
  if (powers.once[0] == 0 || 0.5F * echo.path_length >= plan.true_max_range || !plan.hears(heard_from)) {
    return;
  }
  ++counts.return_legs;
  if (blocked({point, out, kRayClearance, back.norm() - double{kRayClearance}})) {
    return;
  }
  const PingPlan::Arrival arrival = plan.arrival_from(heard_from);
  echo.power = powers.once[0] * arrival.heard;
  deposit(plan, echo, grid);
  echo.azimuth = arrival.bearing;
  echo.elevation = arrival.elevation;
  arrivals.push_back(echo);
}

void ReferenceEngine::insonify_column(const PingPlan& plan, int column, const Pose& world_from_sonar, EchoGrid& grid,
                                      std::vector<Echo>& arrivals, RayCounts& counts) const {
  const Lattice& lattice = plan.lattice;
  const int rows = lattice.rows;
  const double cosine = lattice.cos_azimuth[column], sine = lattice.sin_azimuth[column];
  const bool cone = lattice.shape == BeamShape::kCone;
  const Eigen::Quaterniond& turn = world_from_sonar.orientation;
  const Vec3 along = turn * Vec3(cosine, cone ? 0 : sine, 0);
  const Vec3 up = turn * Vec3(0, 0, cone ? cosine : 1);
  const Vec3 across = cone ? turn * Vec3(0, cosine, 0) : up.cross(along);
  const Vec3 beside = turn * Vec3(0, cone ? sine : 0, 0);

  // Out: what does each row meet first?
  std::vector<Meeting> first(rows);
  std::vector<Ray> rays(rows);
  HitStrip strip(1, rows);
  HitColumn hits = strip.column(0);
  hits.rows = rows;
  hits.has_relief = reliefs_.any();
  Stretches stretches(rows);
  SurfaceSums sums;
  sums.prepare(plan.sonar.bin_count);
  for (int row = 0; row < rows; ++row) {
    const Vec3 direction =
        along * double{lattice.cosines(column)[row]} + up * double{lattice.sines(column)[row]} + beside;
    rays[row] = {world_from_sonar.position, direction.normalized(), 0, plan.true_max_range};
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
  evaluate_column(plan, column, {along.cast<float>(), across.cast<float>(), up.cast<float>(), beside.cast<float>()},
                  hits, stretches);
  deposit_column(plan, column, hits, stretches, sums, grid);
  if (plan.secondary == SecondaryEchoes::kNone) {
    return;
  }

  // On to a second surface in the mirror direction, and from there straight back, if nothing is in the way.
  for (int row = 0; row < rows; ++row) {
    if (hits.selected[row] == 0) {
      continue;
    }
    const Vec3 point = rays[row].origin + rays[row].direction * first[row].distance;
    const Vec3& normal = first[row].bent;
    const Vec3 mirrored = rays[row].direction - 2 * rays[row].direction.dot(normal) * normal;
    const Ray onward{point, mirrored.normalized(), kRayClearance, plan.true_max_range};
    const Meeting second = nearest(onward);
    ++counts.secondary;
    if (!second.met()) {
      continue;
    }
    const Vec3 second_point = onward.origin + onward.direction * second.distance;
    const Vec3 back = world_from_sonar.position - second_point;
    const auto path_length = static_cast<float>(first[row].distance + second.distance + back.norm());
    if (plan.model == EchoModel::kCalibrated) {
      const float texture = hits.has_relief ? hits.texture[row] : 1.0F;
      const float kept = plan.scatter.kept(hits.surface[row]) * texture * texture;
      const Echo echo = secondary_echo(plan, column, row, hits.selected[row], path_length, second.surface());
      return_mirrored(plan, world_from_sonar,
                      {echo, kept, plan.scatter.steepness(hits.surface[row]), lattice.heard_in(column)[row],
                       first[row].distance, tube(first[row], rays[row].direction), onward, second},
                      grid, arrivals, counts);
      continue;
    }
    if (0.5F * path_length >= plan.true_max_range) {
      continue;
    }
    ++counts.return_legs;
    if (blocked({second_point, back.normalized(), kRayClearance, back.norm() - double{kRayClearance}})) {
      continue;
    }
    const auto incidence = static_cast<float>(std::abs(second.bent.dot(onward.direction)));
    Echo echo = secondary_echo(plan, column, row, hits.selected[row], path_length, second.surface());
    const float strength = hits.strength[row] * incidence * second.reflectivity;
    const float rest = path_length - 2 * hits.range[row];
    secondary_powers(plan, 1, &strength, &rest, &echo.power);
    deposit(plan, echo, grid);
  }
}

}  // namespace insonify
