// hit.h -- the first surface along a ray, for rays that are not part of a lattice; clearance of rays from surfaces.

#pragma once

#include <cstdint>

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

/// Length at both ends of a reflected ray or return leg within which it hits nothing [m]: more than the rounding error
/// of single precision at sonar ranges, less than any detail that a sonar resolves.
inline constexpr float kRayClearance = 1e-3F;

}  // namespace insonify
