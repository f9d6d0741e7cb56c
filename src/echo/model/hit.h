// hit.h -- what a single ray met, for the few rays that are not part of a lattice.

#pragma once

#include <cstdint>

#include "insonify/geometry.h"
#include "insonify/ground_truth.h"

namespace insonify {

/// Where a ray first meets the scene.
struct Hit {
  double distance = 0;         ///< From the ray's origin [m]; infinite for a miss.
  Vec3 normal = Vec3::Zero();  ///< Unit shading normal on the surface's side of the ray, world frame; with relief.
  std::uint16_t instance = kNoLabel;  ///< Index into Scene::instances, kNoLabel for a miss.
  std::uint16_t material = kNoLabel;  ///< Index into Scene::materials.
  float reflectivity = 0;             ///< Of the surface there: its material's, times that of its relief.
};

}  // namespace insonify
