// hit.h -- the first surface along a ray, for rays that are not part of a lattice.

#pragma once

#include <cstdint>

#include "echo/laws/laws.h"
#include "insonify/geometry.h"
#include "insonify/ground_truth.h"

namespace insonify {

/// First intersection of a ray with the scene.
struct Hit {
  double distance = 0;                ///< From the ray's origin [m]; infinite for a miss.
  Vec3 normal = Vec3::Zero();         ///< Unit shading normal with relief, world frame, on the side the ray comes from.
  std::uint16_t instance = kNoLabel;  ///< Index into Scene::instances, kNoLabel for a miss.
  std::uint16_t material = kNoLabel;  ///< Index into Scene::materials.
  float reflectivity = 0;             ///< That of the material, times ReliefPoint::reflectivity.
  float texture = 1;                  ///< ReliefPoint::reflectivity.
};

}  // namespace insonify
