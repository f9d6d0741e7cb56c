// tree.h -- a subsea Christmas tree on its guide base: x towards its ROV panel, y to its production wing, z up from the
// mud line on the well's axis.

#pragma once

#include "kit/modelling.h"

// Measures [m]. Those of API 17D are of a guide-line tree for an 18 3/4 in wellhead.
inline constexpr double kPostCircle = 1.829;         ///< Guide posts stand on a radius of 6 ft (API 17D).
inline constexpr double kPostRadius = 0.1095;        ///< 8 5/8 in tube (API 17D).
inline constexpr double kPostTop = 4.05;             ///< Top of the posts' heads.
inline constexpr double kConductorRadius = 0.381;    ///< 30 in conductor housing.
inline constexpr double kWellheadTop = 1.42;         ///< Top of the 18 3/4 in high-pressure housing.
inline constexpr double kConnectorRadius = 0.62;     ///< Collet connector of the wellhead.
inline constexpr double kBlockFoot = 2.16;           ///< Valve block: from here ...
inline constexpr double kBlockTop = 3.62;            ///< ... to here,
inline constexpr double kBlockHalfWidth = 0.44;      ///< and as far as this to all four sides.
inline constexpr double kTreeTop = 4.80;             ///< Top of the tree cap's re-entry mandrel.
inline constexpr double kFrameHalfWidth = 1.62;      ///< Middle of the bumper rails.
inline constexpr double kFrameTop = 4.25;            ///< Middle of the upper rails.
inline constexpr double kPanelX = 1.50;              ///< Face of the ROV panel.
inline constexpr double kProductionRadius = 0.0841;  ///< 6 5/8 in pipe.
inline constexpr double kAnnulusRadius = 0.0445;     ///< 3 1/2 in pipe.

/// A valve's row and column on the ROV panel.
struct ValvePlace {
  double y, z;
};
inline constexpr ValvePlace kMasterValves[] = {{0.21, 2.46}, {-0.21, 2.46}};  ///< Production, annulus.
inline constexpr ValvePlace kSwabValves[] = {{0.21, 3.30}, {-0.21, 3.30}};
inline constexpr ValvePlace kWingValves[] = {{0.76, 2.88}, {-0.74, 2.88}};
inline constexpr ValvePlace kCrossoverValve{0.0, 2.88};

/// Middle of a guide post: corner 0..3, anticlockwise from +x +y [m].
[[nodiscard]] Vec2 post_place(int corner);

// Its parts.
[[nodiscard]] Shape make_guide_base();     ///< Temporary and permanent guide base, housing and posts.
[[nodiscard]] Shape make_valve_tree();     ///< Connector, block, valves, wings, choke and cap.
[[nodiscard]] Shape make_flow_loops();     ///< Production and annulus loops, hubs and tubing.
[[nodiscard]] Shape make_tree_frame();     ///< Sleeves with funnels, frame, bumper rails and anodes.
[[nodiscard]] Shape make_tree_controls();  ///< ROV panel, control pod and stab plate.

/// All of it.
[[nodiscard]] Shape make_christmas_tree();
