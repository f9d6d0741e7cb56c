// alike.cpp -- sorts instances by mesh, materials and reliefs.

#include "scene/alike.h"

#include <set>
#include <tuple>

namespace insonify {

std::vector<std::size_t> first_alike(const Scene& scene) {
  const auto look_of = [&](std::size_t i) {
    const Instance& instance = scene.instances[i];
    return std::tie(instance.mesh, instance.materials, instance.reliefs, instance.endless);
  };
  const auto before = [&](std::size_t a, std::size_t b) { return look_of(a) < look_of(b); };
  std::set<std::size_t, decltype(before)> firsts(before);
  std::vector<std::size_t> first(scene.instances.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    first[i] = scene.instances[i].present ? *firsts.insert(i).first : i;
  }
  return first;
}

}  // namespace insonify
