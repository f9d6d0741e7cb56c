// ferry.h -- the wrecked car ferry, in its own frame: x forward from the transom, y to port, z up from the keel.

#pragma once

#include "kit/modelling.h"

inline constexpr double kFerryLength = 52;   ///< [m]
inline constexpr double kFerryBreadth = 12;  ///< Without fenders and flare [m].

// Lines of the hull [m]. x is 0..kFerryLength.
[[nodiscard]] double keel_height(double x);
[[nodiscard]] double deck_edge_height(double x);
/// @param level  0 at the keel, 1 at the deck edge.
[[nodiscard]] double hull_half_breadth(double x, double level);
/// A point of the shell's face. `girth` runs from 0 at the keel round the bilge to 1 at the deck edge; side is +1 to
/// port, -1 to starboard.
inline constexpr double kBottomGirth = 0.22;  ///< Share of the girth that is flat bottom.
[[nodiscard]] Vec3 hull_point(double x, double girth, int side);
/// Height of the car deck, arched so that water runs off.
[[nodiscard]] double deck_height(double x, double y);

// Its parts.
[[nodiscard]] Shape make_shell();           ///< Plating with the torn hole.
[[nodiscard]] Shape make_framing();         ///< Frames, stringers and bulkheads inside, seen through the hole.
[[nodiscard]] Shape make_deck();            ///< Car deck, hatch, bulwarks, ramps and deck gear.
[[nodiscard]] Shape make_superstructure();  ///< House, wheelhouse, funnel, mast, davits, rails.
[[nodiscard]] Shape make_ferry();           ///< All of it, strained by the wrecking.
