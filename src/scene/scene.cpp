// scene.cpp -- counts, bounds and names of what there is to insonify.

#include "insonify/scene.h"

#include <limits>

namespace insonify {

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const Instance& instance : instances) {
    count += instance.mesh->triangles.size();
  }
  return count;
}

Box3 Scene::bounds() const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box3 box{Vec3::Constant(kFar), Vec3::Constant(-kFar)};
  for (const Instance& instance : instances) {
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

int Scene::find_instance(std::string_view name) const {
  const std::string scope = std::string(name) + "::";
  int inside = -1;
  bool ambiguous = false;
  for (std::size_t i = 0; i < instances.size(); ++i) {
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
