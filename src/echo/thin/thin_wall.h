// thin_wall.h -- a triangle that may be a side of a thin part.

#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "echo/thin/thin_parts.h"
#include "insonify/scene.h"

namespace insonify {

/// A triangle in world coordinates.
struct ThinWall {
  static constexpr double kLeastClearance = 1e-4;  ///< [m]
  static constexpr double kRound = 1;  ///< Least change of the normal of a round surface over the body's depth [rad].

  std::uint32_t triangle;
  Vec3 middle, normal;  ///< The normal points outwards, by the winding.
  double curvature;     ///< Change of the vertices' normals per length, along the edge where it is greatest [rad/m].
  Vec3 around;          ///< That change: a direction around the body, of any length.
  Vec3 edge;            ///< Its shortest edge, of any length.

  /// The triangle, if it has no relief and is narrow enough to be a side of a thin part.
  [[nodiscard]] static std::optional<ThinWall> of(const Instance& instance, std::uint32_t triangle);

  /// Whether a body up to ThinParts::kThickestRound thick may be round here.
  [[nodiscard]] bool is_round() const { return curvature * double{ThinParts::kThickestRound} >= kRound; }

  /// Greatest thickness of a part with this side [m].
  [[nodiscard]] double reach() const {
    return (1 + ThinParts::kTolerance) * double{is_round() ? ThinParts::kThickestRound : ThinParts::kThickest};
  }

  /// Distance from the surface at which rays into the body start [m]: more than coordinates are rounded by.
  [[nodiscard]] double clearance() const {
    return is_round() ? std::max(kLeastClearance, 0.02 / curvature) : kLeastClearance;
  }

  /// Whether a body of that depth [m] is thin even where it is not round.
  [[nodiscard]] static bool is_thin(double depth) {
    return depth <= (1 + ThinParts::kTolerance) * double{ThinParts::kThickest};
  }
  [[nodiscard]] bool may_be_thin(double depth) const { return is_thin(depth) || curvature * depth >= kRound; }
};

}  // namespace insonify
