// tank.h -- a test tank and the vehicle-sized box that hangs in it.

#pragma once

#include "kit/modelling.h"

// Inside of the basin [m], about x = y = 0; the water's surface is z = 0.
inline constexpr double kTankLength = 23.0;  ///< Along x.
inline constexpr double kTankWidth = 18.81;  ///< Along y.
inline constexpr double kTankDepth = 8.0;    ///< From the surface to the floor.
inline constexpr double kTankRim = 0.45;     ///< Height of the walls above the surface.

/// Basin with walls 0.4 m thick, ladders, pipe inlet, overflow gutter, floor drain, window and rails of a gantry.
[[nodiscard]] Shape make_tank();

/// A vehicle's frame about its centre, 2.4 x 1.3 x 1.8 m: runners, posts, closed panels, thrusters and a float block.
[[nodiscard]] Shape make_vehicle_box();
