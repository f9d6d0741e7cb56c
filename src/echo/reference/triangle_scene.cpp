// triangle_scene.cpp -- intersects a ray with all triangles of the objects that it may meet.

#include "echo/reference/triangle_scene.h"

#include <algorithm>
#include <limits>

#include "echo/laws/laws.h"

namespace insonify {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Intersection of a ray and a triangle: distance, and the barycentric weights of the second and third corner.
struct Crossing {
  double distance = kFar, u = 0, v = 0;
};

// Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection" (1997). Both sides of a triangle are hit.
Crossing cross_triangle(const Ray& ray, const Vec3& corner, const Vec3& edge1, const Vec3& edge2) {
  const Vec3 p = ray.direction.cross(edge2);
  const double determinant = edge1.dot(p);
  if (determinant == 0) {
    return {};
  }
  const Vec3 from_corner = ray.origin - corner;
  const double u = from_corner.dot(p) / determinant;
  if (u < 0 || u > 1) {
    return {};
  }
  const Vec3 q = from_corner.cross(edge1);
  const double v = ray.direction.dot(q) / determinant;
  const double distance = edge2.dot(q) / determinant;
  const bool inside = v >= 0 && u + v <= 1;
  return inside && distance > ray.min_distance && distance < ray.max_distance ? Crossing{distance, u, v} : Crossing{};
}

}  // namespace

void TriangleScene::place(int index, const Pose& world_from_mesh) {
  poses_[index] = world_from_mesh;
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
  Eigen::AlignedBox3d box;
  for (const Vec3f& vertex : mesh.vertices) {
    box.extend(vertex.cast<double>());
  }
  balls_[index] = {world_from_mesh * box.center(), 0.25 * box.diagonal().squaredNorm()};
}

// Calls visit(triangle) with the triangles of all objects whose ball the ray's line passes, until it returns true.
template <typename Visit>
void TriangleScene::visit_near(const Ray& ray, const Visit& visit) const {
  constexpr double kRounding = 1e-9;
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    const Vec3 there = balls_[i].middle - ray.origin;
    const double square = there.squaredNorm(), along = there.dot(ray.direction);
    if (square - along * along > balls_[i].square + kRounding * (square + balls_[i].square)) {
      continue;
    }
    for (std::size_t t = first_triangle_[i]; t < first_triangle_[i + 1]; ++t) {
      if (visit(triangles_[t])) {
        return;
      }
    }
  }
}

void TriangleScene::set(const Scene& scene, const Vec3& origin) {
  scene_ = &scene;
  origin_ = origin;
  water_ = WaterPlane::of(scene, Vec3::Zero());
  triangles_.clear();
  first_triangle_.clear();
  reflectivity_.clear();
  reliefs_.set(scene, origin);
  for (const Material& material : scene.materials) {
    reflectivity_.push_back(static_cast<float>(material.effective_reflectivity()));
  }
  faces_.clear();
  poses_.assign(scene.instances.size(), {});
  balls_.assign(scene.instances.size(), {});
  Workers alone(1);
  for (const Instance& instance : scene.instances) {
    faces_.push_back(instance.present ? shared_faces(instance.mesh, alone) : nullptr);
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    first_triangle_.push_back(triangles_.size());
    if (scene.instances[i].present) {
      triangles_.resize(triangles_.size() + scene.instances[i].mesh->triangles.size());
      place(static_cast<int>(i), scene.instances[i].world_from_mesh);
    }
  }
  first_triangle_.push_back(triangles_.size());
}

void TriangleScene::move(int instance, const Pose& world_from_mesh) {
  place(instance, world_from_mesh);
  reliefs_.move(instance, world_from_mesh);
}

RayHit TriangleScene::nearest_straight(const Ray& ray) const {
  Crossing best;
  const Triangle* hit = nullptr;
  visit_near(ray, [&](const Triangle& triangle) {
    const Crossing crossing = cross_triangle(ray, triangle.corner, triangle.edge1, triangle.edge2);
    if (crossing.distance < best.distance) {
      best = crossing;
      hit = &triangle;
    }
    return false;
  });
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

// By chords of half the length of other engines', between places on the ray itself.
RayHit TriangleScene::nearest_bent(const Ray& ray) const {
  const double step = 0.5 * double{refraction_->chord()};
  const double end = std::min(ray.max_distance, ray.min_distance + 2 * refraction_->reach());
  const auto apparent = [&](double distance) { return Vec3(ray.origin + distance * ray.direction); };
  Vec3 here = refraction_->true_place(apparent(ray.min_distance));
  for (double from = ray.min_distance, to = from; from < end; from = to) {
    to = std::min(from + step, end);
    const Vec3 there = refraction_->true_place(apparent(to));
    const double length = (there - here).norm();
    constexpr double kOver = 1 + 1e-9;  // So that nothing lies between two chords.
    RayHit hit = nearest_straight({here, (there - here) / length, 0, length * kOver});
    if (hit.met()) {
      hit.distance = from + hit.distance / length * (to - from);
      const Vec3 at = apparent(hit.distance);
      hit.normal = refraction_->apparent_direction(at, hit.normal);
      hit.bent = refraction_->apparent_direction(at, hit.bent);
      hit.gradient = refraction_->apparent_direction(at, Vec3(hit.gradient.cast<double>())).cast<float>();
      return hit;
    }
    here = there;
  }
  return {.distance = kFar};
}

bool TriangleScene::blocked_straight(const Ray& ray) const {
  bool is_blocked = false;
  visit_near(ray, [&](const Triangle& triangle) {
    is_blocked = cross_triangle(ray, triangle.corner, triangle.edge1, triangle.edge2).distance < kFar;
    return is_blocked;
  });
  return is_blocked;
}

FaceEdges TriangleScene::face_edges(const RayHit& mirror, const Vec3& point) const {
  if (bends()) {
    return {};  // Faces are not plane in apparent space.
  }
  const MeshFaces& found = *faces_[mirror.instance];
  const std::size_t number = mirror.triangle - first_triangle_[mirror.instance];
  if (found.face_of.empty() || found.face_of[number] == MeshFaces::kNone) {
    return {};
  }
  const Face& face = found.faces[found.face_of[number]];
  const Pose& pose = poses_[mirror.instance];
  const Vec3 corner = scene_->instances[mirror.instance].mesh->vertices[face.corner].cast<double>();
  const Vec3 from_corner = pose.orientation.inverse() * (point - pose * corner);
  return FaceEdges::of(face, from_corner.cast<float>(), pose.orientation.toRotationMatrix().cast<float>());
}

precise::RayTube TriangleScene::tube(const RayHit& mirror, const Vec3& direction) const {
  const Triangle& triangle = triangles_[mirror.triangle];
  return precise::ray_tube(
      {precise::triple_of(triangle.edge1), precise::triple_of(triangle.edge2), precise::triple_of(triangle.normal[0]),
       precise::triple_of(triangle.normal[1]), precise::triple_of(triangle.normal[2])},
      precise::triple_of(direction), precise::triple_of(mirror.bent), mirror.distance);
}

}  // namespace insonify
