// ray_lanes.h -- sixteen rays as arrays of components, independent of any ray-tracing library.

#pragma once

namespace insonify {

/// Rays that are computed together.
inline constexpr int kRayLanes = 16;

/// Sixteen rays in memory that somebody else holds: each pointer is to kRayLanes values.
struct RayLanes {
  const float *origin_x, *origin_y, *origin_z;           ///< [m]
  const float *direction_x, *direction_y, *direction_z;  ///< Of unit length.
  const float *near, *far;                               ///< Distances between which a ray counts [m].
};

}  // namespace insonify
