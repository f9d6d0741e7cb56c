// reference_engine.cpp -- brute force, written to be obviously right.

#include "echo/reference/reference_engine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "echo/model/ray_limits.h"

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

const EngineKind ReferenceEngine::kKind = {.name = "reference", .make = [](int threads) -> std::unique_ptr<Engine> {
                                             return std::make_unique<ReferenceEngine>(threads);
                                           }};

void ReferenceEngine::set_scene(const Scene& scene) {
  scene_ = &scene;
  triangles_.clear();
  first_triangle_.clear();
  reflectivity_.clear();
  origin_ = scene.middle();
  reliefs_.set(scene, origin_);
  boxes_.set(scene, origin_);
  for (const Material& material : scene.materials) {
    reflectivity_.push_back(static_cast<float>(material.effective_reflectivity()));
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    first_triangle_.push_back(triangles_.size());
    if (scene.instances[i].present) {
      triangles_.resize(triangles_.size() + scene.instances[i].mesh->triangles.size());
      place_instance(static_cast<int>(i), scene.instances[i].world_from_mesh);
    }
  }
}

void ReferenceEngine::move_instance(int instance, const Pose& world_from_mesh) {
  place_instance(instance, world_from_mesh);
  reliefs_.move(instance, world_from_mesh);
  boxes_.move(instance, {world_from_mesh.position - origin_, world_from_mesh.orientation});
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

void ReferenceEngine::insonify(const PingPlan& plan, const Pose& world_from_sonar, EchoGrid& grid, BeamSink* sink) {
  const int per_beam = plan.lattice.columns_per_beam;
  counts_ = {};
  const std::span<const Ray> rays = probes_.aim(plan, world_from_sonar);
  trace(rays, probes_.hits());
  const SecondarySampling sampling = probes_.choose(plan, origin_, boxes_);
  counts_.secondary = probes_.hits().size();
  std::vector<RayCounts> counts(plan.sonar.beam_count);
  std::vector<std::vector<Echo>> arrivals(plan.sonar.beam_count);
  workers_.for_each(plan.sonar.beam_count, [&](int beam, int) {
    grid.clear(beam, beam + 1);
    for (int column = beam * per_beam; column < (beam + 1) * per_beam; ++column) {
      insonify_column(plan, sampling, column, world_from_sonar, grid, arrivals[beam], counts[beam]);
    }
  });
  for (const std::vector<Echo>& of_beam : arrivals) {
    for (const Echo& echo : of_beam) {
      deposit(plan, echo, grid);
    }
  }
  for (const RayCounts& of_beam : counts) {
    counts_.primary += of_beam.primary;
    counts_.secondary += of_beam.secondary;
    counts_.return_legs += of_beam.return_legs;
  }
  if (sink != nullptr) {
    sink->take(0, plan.sonar.beam_count);
  }
}

}  // namespace insonify
