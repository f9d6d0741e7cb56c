// ray_lanes.h -- sixteen rays as arrays of components, without a ray-tracing library.

#pragma once

namespace insonify {

/// Number of rays that are processed together.
inline constexpr int kRayLanes = 16;

/// Pointers to the components of sixteen rays: kRayLanes values each, which belong to the caller.
struct RayLanes {
  const float *origin_x, *origin_y, *origin_z;           ///< [m]
  const float *direction_x, *direction_y, *direction_z;  ///< Unit length.
  const float *near, *far;                               ///< Ends of the ray, as distances from its origin [m].
};

}  // namespace insonify
