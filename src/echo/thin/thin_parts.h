// thin_parts.h -- parts of a scene that are thin in two directions (ropes, rods, nets, balls) and small plane faces, as
// short pieces.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "echo/engine.h"

namespace insonify {

/// Ropes, chains, nets, rods, small round bodies and small plane faces of a scene as short pieces. Each lists its
/// surface area by direction of the normal, from which ThinEchoes computes its echo in closed form, however few samples
/// of the lattice hit it.
struct ThinParts {
  static constexpr float kThickest = 0.1F;       ///< Parts are at most this thick in two directions [m].
  static constexpr float kThickestRound = 1.0F;  ///< The same of parts whose surface is round [m].

  /// Share by which a size that rays measure may exceed a limit: they do so in world coordinates, which are rounded,
  /// and what people build is often exactly as thick as a limit.
  static constexpr double kTolerance = 0.01;

  static constexpr float kTurnStep = 0.2618F;  ///< Spacing of the normals of patches around the axis: 15 degrees [rad].
  static constexpr std::size_t kMostThickPieces =
      64;  ///< Most pieces of an instance that are thicker than kThickest and of no compact body. The round parts of an
           ///< assembly with more hide each other, which the lattice sees better.
  static constexpr std::size_t kMostStrips = 4096;  ///< Most strips of small plane faces of a scene.
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
    float thickness;  ///< As LeftOut::thickness [m]; of a strip the width of its face.
    std::uint32_t first_patch, last_patch;
    Vec3f side = Vec3f::Zero();  ///< From the middle of a strip to its long side, in the mesh frame [m]; else 0.
    bool glints = false;         ///< Whether FaceGlints computes the coherent share of its lobe.

    [[nodiscard]] bool is_strip() const { return side != Vec3f::Zero(); }  ///< Whether it is a strip of a small face.
  };

  std::vector<Piece> pieces;  ///< Grouped by instance; strips behind all others, grouped likewise.
  std::vector<Patch> patches;
  std::shared_ptr<const LeftOut> triangles;  ///< Null if nothing is thin.
  std::vector<std::string> left_out;         ///< Names of instances with too many pieces.
};

/// @param engine  Has the scene; its rays measure the thickness.
[[nodiscard]] ThinParts find_thin_parts(const Scene& scene, Engine& engine, Workers& workers);

/// A triangle of a thin part, with the part's thickness and direction.
struct ThinTriangle {
  std::uint32_t triangle;
  float thickness;    ///< [m]
  int along;          ///< Coordinate of the mesh frame closest to the part's axis: 0, 1 or 2.
  int body = -1;      ///< Number of the compact body that it is of, which is one piece; -1: of none.
  bool copy = false;  ///< Whether it covers another one, and so has no surface of its own.
};

/// Compact bodies of an instance, and what is thin of the rest, measured by rays: from the middle of each triangle
/// along its normal to the opposite side, and from the midpoint of that ray the smallest extent across it. The larger
/// of both is the second smallest extent of the body. Where it is more than kThickest, the surface must be round:
/// its normal turns by a radian or more over the distance to the opposite side (2 on a ball). Surfaces with relief are
/// left out.
[[nodiscard]] std::vector<ThinTriangle> find_thin_triangles(const Scene& scene, int instance, Engine& engine,
                                                            Workers& workers);

/// Finds smooth connected surfaces without relief that are at most twice as long as they are thick, such as balls and
/// pebbles. Their thickness is the second smallest side of their bounding box in the mesh frame; also kThickestRound or
/// more. Cut into slabs, such a body would fall into parts with few normals each.
/// @param first_of  repeated_triangles() of its mesh.
/// @return By triangle, in order.
[[nodiscard]] std::vector<ThinTriangle> find_compact_bodies(const Instance& instance,
                                                            const std::vector<std::uint32_t>& first_of = {});

/// Cuts the thin triangles of an instance into pieces, and adds these to `parts`.
/// @param slab  Length of a piece along coordinate ThinTriangle::along [thicknesses].
/// @return False if there would be more than ThinParts::kMostPieces; `parts` is then unchanged.
[[nodiscard]] bool cut_thin_triangles(const Instance& instance, int index, const std::vector<ThinTriangle>& thin,
                                      float slab, ThinParts& parts);

}  // namespace insonify
