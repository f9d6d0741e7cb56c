// map_relief.h -- one relief at sixteen points of a mesh.

#pragma once

#include "echo/laws/laws.h"
#include "echo/model/reliefs.h"

namespace insonify {

inline constexpr int kHitLanes = ReliefHits::kLanes;

/// Hits on one mesh, in its frame.
struct alignas(64) MeshPoints {
  float x[kHitLanes], y[kHitLanes], z[kHitLanes];                       ///< [m]
  float normal_x[kHitLanes], normal_y[kHitLanes], normal_z[kHitLanes];  ///< Unit length.
  std::uint32_t triangle[kHitLanes];

  [[nodiscard]] Triple normal(int lane) const { return {normal_x[lane], normal_y[lane], normal_z[lane]}; }
};

/// Maps a relief by the triangles' texture coordinates.
/// @param usable   Receives -1 where these are usable, and 0 elsewhere, where the results have no meaning.
/// @param reliefs  Flat; receives the relief, with gradients in the mesh's frame.
void map_by_texture(const Relief& relief, const Mesh& mesh, const MeshPoints& points, std::int32_t* usable,
                    ReliefLanes& reliefs);

/// Maps a relief by position: the three projections along the axes, blended by the components of the normal.
void map_by_position(const Relief& relief, const MeshPoints& points, ReliefLanes& reliefs);

}  // namespace insonify
