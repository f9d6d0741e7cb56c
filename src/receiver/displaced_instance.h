// displaced_instance.h -- an instance of the scene that is not where the scene has it.

#pragma once

#include <cstdint>

#include "insonify/geometry.h"

namespace insonify {

struct DisplacedInstance {
  std::uint16_t instance = 0;  ///< Index into Scene::instances.
  Pose home_from_here = {};    ///< Maps the world of this ping so that the instance comes to its place in the scene.
};

}  // namespace insonify
