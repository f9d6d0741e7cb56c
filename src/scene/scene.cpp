// scene.cpp -- triangle count, bounds, and look-up of instances by name.

#include "insonify/scene.h"

#include <fmt/format.h>

#include <limits>

#include "insonify/error.h"

namespace insonify {

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
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box3 box{Vec3::Constant(kFar), Vec3::Constant(-kFar)};
  for (const Instance& instance : instances) {
    if (!instance.present || instance.endless) {
      continue;
    }
    for (const auto& triangle : instance.mesh->triangles) {
      for (const std::uint32_t corner : triangle) {
        const Vec3 point = instance.world_from_mesh * instance.mesh->vertices[corner].cast<double>();
        box.low = box.low.cwiseMin(point);
        box.high = box.high.cwiseMax(point);
      }
    }
  }
  return box;
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
