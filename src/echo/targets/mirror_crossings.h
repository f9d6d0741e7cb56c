// mirror_crossings.h -- where three perpendicular plane mirrors meet.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "echo/targets/corners.h"
#include "echo/targets/mirror_tree.h"

namespace insonify {

/// Three perpendicular mirrors: their common point, and axes along their common edges. Mirror k is perpendicular to
/// axis k.
struct Crossing {
  Vec3 apex;
  Eigen::Matrix3d axes;
  std::array<std::uint32_t, 3> mirrors;  ///< Indices.
};

/// Reach of the boxes of a MirrorTree for find_crossings(): a triangle of each mirror of a corner is at most this far
/// from the apex [m], as it holds the place at kLeastEdge along two axes, and is flush with the mirror.
inline constexpr double kCrossingReach = 1.5 * Corner::kLeastEdge + PlaneMirror::kFlush;

/// Finds the triples of mirrors each of which has triangles near the two others; in the order of their indices.
/// @param mirrors  The last one may be the water's surface, which has no triangles.
[[nodiscard]] std::vector<Crossing> find_crossings(const std::vector<PlaneMirror>& mirrors, const MirrorTree& tree,
                                                   Workers& workers);

}  // namespace insonify
