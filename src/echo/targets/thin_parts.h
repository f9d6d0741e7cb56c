// thin_parts.h -- finds the parts of a scene that are thin in two directions, and cuts them into short pieces.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "echo/engine.h"

namespace insonify {

/// Ropes, chains, nets and rods of a scene as short pieces. Each has the area of its surface by the direction of the
/// normal, from which ThinEchoes computes its echo in closed form, wherever it lies among the samples of a fan.
struct ThinParts {
  static constexpr float kThickest = 0.1F;  ///< Parts are thinner than this in two directions [m].
  static constexpr std::size_t kMostPieces =
      20'000;  ///< Most pieces of a scene; what would be more stays with the lattice.

  /// Surface of one piece with about one normal. Frame: that of the mesh.
  struct Patch {
    Vec3f normal;         ///< Unit length.
    Vec3f around, along;  ///< Its turns over the patch, in the sense of TurnProducts; 0 for a flat one.
    Vec3f offset;         ///< From the axis of the piece to the middle of the patch [m].
    float area;           ///< [m^2]
  };

  struct Piece {
    SurfaceLabel surface;
    Vec3f middle;     ///< Mesh frame [m].
    Vec3f half;       ///< From the middle to one end, along the axis [m]; 0 where it has no axis.
    float thickness;  ///< As LeftOut has it [m].
    std::uint32_t first_patch, last_patch;
  };

  std::vector<Piece> pieces;  ///< Those of an instance are together.
  std::vector<Patch> patches;
  std::shared_ptr<const LeftOut> triangles;  ///< Null where nothing is thin.
  std::vector<std::string> left_out;         ///< Names of instances with too many pieces.
};

/// @param engine  With the scene as it is; its rays measure the thickness.
[[nodiscard]] ThinParts find_thin_parts(const Scene& scene, Engine& engine);

/// An instance's triangles, with the thickness of the body and the direction of its axis.
struct ThinTriangle {
  std::uint32_t triangle;
  float thickness;  ///< [m]
  int along;        ///< Coordinate of the mesh frame that the axis is closest to: 0, 1 or 2.
};

/// Measures the thickness of one instance by rays: that at the middle of each triangle along its normal to the opposite
/// wall, and half-way there the least extent across. The greater of both is the second smallest extent of the body.
/// Surfaces with relief are left out.
[[nodiscard]] std::vector<ThinTriangle> find_thin_triangles(const Scene& scene, int instance, Engine& engine);

/// Cuts the thin triangles of an instance into pieces and adds these.
/// @param slab  Length of a piece along the coordinate of its axis, in thicknesses.
/// @return False where there would be more than ThinParts::kMostPieces; then `parts` is as it was.
[[nodiscard]] bool cut_thin_triangles(const Instance& instance, int index, const std::vector<ThinTriangle>& thin,
                                      float slab, ThinParts& parts);

}  // namespace insonify
