// displaced_instance.h -- an instance that has moved from its pose in the scene.

#pragma once

#include <cstdint>

#include "insonify/geometry.h"

namespace insonify {

struct DisplacedInstance {
  std::uint16_t instance = 0;  ///< Index into Scene::instances.
  Pose home_from_here = {};  ///< Maps world positions of this ping to those with the instance at its pose in the scene.
};

}  // namespace insonify
