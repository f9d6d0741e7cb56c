// motion.cpp -- which instances a motion moves.

#include "simulator/motion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "insonify/error.h"

namespace insonify {
namespace {

bool belongs_to(const std::string& instance, const std::string& object) {
  return instance == object || instance.starts_with(object + "::");
}

// The first parts of the instances' scoped names.
std::set<std::string> object_names(const Scene& scene) {
  std::set<std::string> names;
  for (const Instance& instance : scene.instances) {
    names.insert(instance.name.substr(0, instance.name.find("::")));
  }
  return names;
}

}  // namespace

std::vector<MovingPart> find_moving_parts(const Scenario& scenario, Scene& scene) {
  std::vector<MovingPart> parts;
  for (std::size_t m = 0; m < scenario.motions.size(); ++m) {
    const Motion& motion = scenario.motions[m];
    const std::size_t before = parts.size();
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      Instance& instance = scene.instances[i];
      if (!belongs_to(instance.name, motion.object)) {
        continue;
      }
      if (instance.moving) {
        throw Error(fmt::format("{}motions[{}].object = {} moves {} a second time", motion.where, m, motion.object,
                                instance.name));
      }
      instance.moving = true;
      parts.push_back(
          {static_cast<int>(i), static_cast<int>(m), motion.trajectory.at(0).inverse() * instance.world_from_mesh});
    }
    if (parts.size() == before) {
      throw Error(fmt::format("{}motions[{}].object = {} is not in the world; there are {}", motion.where, m,
                              motion.object, fmt::join(object_names(scene), ", ")));
    }
  }
  return parts;
}

}  // namespace insonify
