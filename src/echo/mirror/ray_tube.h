// ray_tube.h -- ray-tube spreading after reflection by a mirror that may be curved.

#pragma once

#include <array>

#include "insonify/geometry.h"

namespace insonify {

/// Cross section of a ray tube per unit of solid angle at the sonar, at the distance `across` behind the mirror:
/// |constant + linear across + quadratic across^2| [m^2].
struct RayTube {
  float constant = 0, linear = 0, quadratic = 1;

  [[nodiscard]] static RayTube of_plane(float range) { return {range * range, 2 * range, 1}; }
};

/// Ray tube of a mirror given by a triangle with vertex normals, which are interpolated linearly: Igehy, "Tracing ray
/// differentials", SIGGRAPH 1999. For a sphere of radius a, hit at an angle t from its normal at the range r, the area
/// is r^2 (1 + across (1/r + 2/(a cos t))) (1 + across (1/r + 2 cos t/a)). Equal normals make a plane.
/// @param normals    Unit length, on either side.
/// @param direction  Direction of the incident sound, unit length.
/// @param normal     Unit normal at the hit with relief, on either side.
/// @param range      Distance from the sonar to the hit [m].
[[nodiscard]] RayTube ray_tube(const std::array<Vec3f, 3>& corners, const std::array<Vec3f, 3>& normals,
                               const Vec3f& direction, const Vec3f& normal, float range);

}  // namespace insonify
