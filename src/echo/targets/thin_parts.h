// thin_parts.h -- parts of a scene that are thin in two directions (ropes, rods, nets), as short pieces.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "echo/engine.h"

namespace insonify {

/// Ropes, chains, nets and rods of a scene as short pieces. Each lists its surface area by direction of the normal,
/// from which ThinEchoes computes its echo in closed form, however few samples of the lattice hit it.
struct ThinParts {
  static constexpr float kThickest = 0.1F;  ///< Parts are thinner than this in two directions [m].
  static constexpr std::size_t kMostPieces =
      20'000;  ///< Most pieces of a scene; instances beyond that are left to the lattice.

  /// Surface of one piece with nearly constant normal, in the mesh frame.
  struct Patch {
    Vec3f normal;         ///< Unit length.
    Vec3f around, along;  ///< Changes of the normal over the patch, as in TurnProducts; 0 for a flat one.
    Vec3f offset;         ///< From the axis of the piece to the middle of the patch [m].
    float area;           ///< [m^2]
  };

  struct Piece {
    SurfaceLabel surface;
    Vec3f middle;     ///< In the mesh frame [m].
    Vec3f half;       ///< From the middle to one end, along the axis [m]; 0 for a piece without axis.
    float thickness;  ///< As LeftOut::thickness [m].
    std::uint32_t first_patch, last_patch;
  };

  std::vector<Piece> pieces;  ///< Grouped by instance.
  std::vector<Patch> patches;
  std::shared_ptr<const LeftOut> triangles;  ///< Null if nothing is thin.
  std::vector<std::string> left_out;         ///< Names of instances with too many pieces.
};

/// @param engine  Has the scene; its rays measure the thickness.
[[nodiscard]] ThinParts find_thin_parts(const Scene& scene, Engine& engine);

/// A triangle of a thin part, with the part's thickness and direction.
struct ThinTriangle {
  std::uint32_t triangle;
  float thickness;  ///< [m]
  int along;        ///< Coordinate of the mesh frame closest to the part's axis: 0, 1 or 2.
};

/// Measures the thickness of one instance by rays: from the middle of each triangle along its normal to the opposite
/// side, and from the midpoint of that ray the smallest extent across it. The larger of both is the second smallest
/// extent of the body. Surfaces with relief are left out.
[[nodiscard]] std::vector<ThinTriangle> find_thin_triangles(const Scene& scene, int instance, Engine& engine);

/// Cuts the thin triangles of an instance into pieces, and adds these to `parts`.
/// @param slab  Length of a piece along coordinate ThinTriangle::along [thicknesses].
/// @return False if there would be more than ThinParts::kMostPieces; `parts` is then unchanged.
[[nodiscard]] bool cut_thin_triangles(const Instance& instance, int index, const std::vector<ThinTriangle>& thin,
                                      float slab, ThinParts& parts);

}  // namespace insonify
