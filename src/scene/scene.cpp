// scene.cpp -- triangle count, bounds, and look-up of instances by name.

#include "insonify/scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <map>

#include "insonify/error.h"

namespace insonify {
namespace {

// Extends a box by the corners of all triangles of a mesh.
void extend_by(const Mesh& mesh, const Pose& pose, Eigen::AlignedBox3d& box) {
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      box.extend(pose * mesh.vertices[corner].cast<double>());
    }
  }
}

// Whether a box encloses another, turned by a pose, by more than rounding.
bool encloses(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& other, const Pose& pose) {
  constexpr double kCloseness = 1e-6;  // [m]: of coordinates up to 1e7 m.
  const Vec3 middle = pose * Vec3(other.center());
  const Vec3 half = pose.orientation.toRotationMatrix().cwiseAbs() * (0.5 * other.sizes()) + Vec3::Constant(kCloseness);
  return box.contains(Vec3(middle - half)) && box.contains(Vec3(middle + half));
}

}  // namespace

void check_reach(const Instance& instance, std::string_view what) {
  constexpr const char* kAxes = "xyz";
  for (const Vec3f& vertex : instance.mesh->vertices) {
    const Vec3 point = instance.world_from_mesh * vertex.cast<double>();
    for (int axis = 0; axis < 3; ++axis) {
      if (!coordinate().allow(point[axis])) {
        throw Error(fmt::format("{} reaches {} = {:.10g} m, must be {} m", what, kAxes[axis], point[axis],
                                coordinate().text()));
      }
    }
  }
}

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const Instance& instance : instances) {
    count += instance.present ? instance.mesh->triangles.size() : 0;
  }
  return count;
}

Box3 Scene::bounds() const {
  Eigen::AlignedBox3d box;
  std::map<const Mesh*, Eigen::AlignedBox3d> own;  // In the frames of meshes that have been met before.
  for (const Instance& instance : instances) {
    if (!instance.present || instance.endless) {
      continue;
    }
    const auto [known, is_new] = own.try_emplace(instance.mesh.get());
    if (!is_new && known->second.isEmpty()) {
      extend_by(*instance.mesh, {}, known->second);
    }
    if (is_new || !encloses(box, known->second, instance.world_from_mesh)) {
      extend_by(*instance.mesh, instance.world_from_mesh, box);
    }
  }
  return {box.min(), box.max()};
}

Vec3 Scene::middle() const {
  const Box3 box = bounds();
  return box.low.x() > box.high.x() ? Vec3::Zero() : Vec3(0.5 * (box.low + box.high));
}

int Scene::find_instance(std::string_view name) const {
  const std::string scope = std::string(name) + "::";
  int inside = -1;
  bool ambiguous = false;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (!instances[i].present) {
      continue;
    }
    if (instances[i].name == name) {
      return static_cast<int>(i);
    }
    if (instances[i].name.starts_with(scope)) {
      ambiguous = inside >= 0;
      inside = static_cast<int>(i);
    }
  }
  return ambiguous ? -1 : inside;
}

}  // namespace insonify
