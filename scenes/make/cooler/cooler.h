// cooler.h -- a subsea cooler: banks of bare pipes in a frame on a mudmat, cooled by the sea that moves through them.
//
// Its own frame: x along the pipes from inlet to outlet, z up from the top of the mudmat, the ROV's side at +y.

#pragma once

#include "kit/modelling.h"

// Frame [m]: axes of its members.
inline constexpr double kCoolerLength = 9.0;     ///< Between the corner columns, along x.
inline constexpr double kCoolerWidth = 4.4;      ///< Along y.
inline constexpr double kCoolerHeight = 3.3;     ///< Height of the top ring above the mudmat.
inline constexpr double kColumnRadius = 0.1365;  ///< NPS 10: 273 mm over all (ASME B36.10).
inline constexpr double kMudmatOverhangX = 1.9;  ///< By which the mudmat stands out beyond the frame's axes.
inline constexpr double kMudmatOverhangY = 0.75;

// Cooling pipes [m].
inline constexpr double kCoilRadius = 0.0572;  ///< NPS 4: 114.3 mm over all (ASME B36.10).
inline constexpr double kCoilPitch = 0.305;    ///< Between passes: a long-radius return bend, 12 in (ASME B16.9).
inline constexpr int kCoilPasses = 9;
inline constexpr int kCoilBanks = 8;
inline constexpr double kBankPitch = 0.48;
inline constexpr double kPassLength = 6.6;  ///< Straight part.
inline constexpr double kLowestPass = 0.55;
inline constexpr double kHighestPass = kLowestPass + (kCoilPasses - 1) * kCoilPitch;

// Headers and the piping that the pipelines are bolted to.
inline constexpr double kHeaderRadius = 0.162;  ///< NPS 12: 323.9 mm over all (ASME B36.10).

/// Where the piping of the inlet and the outlet ends, just outside their flanges; the spools go on along -x and +x.
inline const Vec3 kCoolerInlet{-6.95, 0.9, 0.75};
inline const Vec3 kCoolerOutlet{6.95, -0.9, kLowestPass};

// Its parts.
[[nodiscard]] Shape make_cooler_frame();   ///< Mudmat, columns, rings, bracing, lifting points, guide posts, anodes.
[[nodiscard]] Shape make_cooler_coils();   ///< Banks of serpentine pipe in their racks.
[[nodiscard]] Shape make_cooler_piping();  ///< Headers, risers with valves, ROV panel.
[[nodiscard]] Shape make_cooler();         ///< All of it.
