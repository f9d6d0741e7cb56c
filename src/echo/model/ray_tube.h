// ray_tube.h -- how wide sound spreads by way of a mirror that may be curved.

#pragma once

#include <array>

#include "insonify/geometry.h"

namespace insonify {

/// The area square to the sound, per unit of the solid angle it left the sonar in, at a distance across from the
/// mirror: |constant + linear x across + quadratic x across^2| [m^2].
struct RayTube {
  float constant = 0, linear = 0, quadratic = 1;

  [[nodiscard]] static RayTube of_plane(float range) { return {range * range, 2 * range, 1}; }
};

/// Of a mirror given by a triangle and the normals at its corners, between which they run linearly: Igehy, "Tracing ray
/// differentials", SIGGRAPH 1999. Of a sphere of radius a, met at an angle t from its normal at the range r, the area
/// is r^2 (1 + across (1/r + 2/(a cos t))) (1 + across (1/r + 2 cos t/a)); equal normals make a plane.
/// @param normals    Of unit length, on either side.
/// @param direction  In which the sound comes, of unit length.
/// @param normal     That it is mirrored about, of unit length, on either side; relief included.
/// @param range      From the sonar [m].
[[nodiscard]] RayTube ray_tube(const std::array<Vec3f, 3>& corners, const std::array<Vec3f, 3>& normals,
                               const Vec3f& direction, const Vec3f& normal, float range);

}  // namespace insonify
