// ssiv.h -- mock-up of a subsea safety isolation valve: a block valve in a tubular frame on four mudmats.
//
// Its own frame: x along the pipe, z up from the tops of the mudmats, the ROV's side at -y.

#pragma once

#include "kit/modelling.h"

// Frame [m]: axes of its members.
inline constexpr double kSsivLength = 2.6;       ///< Between the legs, along x.
inline constexpr double kSsivWidth = 2.2;        ///< Along y.
inline constexpr double kSsivHeight = 1.75;      ///< Height of the roof's ring above the mudmats.
inline constexpr double kLegRadius = 0.0842;     ///< NPS 6: 168.3 mm over all (ASME B36.10).
inline constexpr double kSsivMudmatSide = 0.95;  ///< Side of each of the four mudmats.

// The pipe through it [m].
inline constexpr double kSsivPipeRadius = 0.1095;  ///< NPS 8: 219.1 mm over all (ASME B36.10).
inline constexpr double kSsivPipeHeight = 0.52;    ///< Height of the pipe's axis.
inline constexpr double kSsivPipeReach = 2.75;     ///< Distance of its ends, which are blind flanges, from the middle.

// Its parts.
[[nodiscard]] Shape make_ssiv_frame();  ///< Legs, rings, bracing, mudmats, lifting points, anodes.
[[nodiscard]] Shape make_ssiv_roof();   ///< Two hatch leaves of bars in the roof, one with its sling on it.
[[nodiscard]] Shape make_ssiv_valve();  ///< Pipe, valve block, actuator, bypass and the ROV panel with its tubing.
[[nodiscard]] Shape make_ssiv();        ///< All of it.
