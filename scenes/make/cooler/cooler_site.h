// cooler_site.h -- the sea bed of the cooler: soft, burrowed and trawled, and where things lie on it.

#pragma once

#include "kit/modelling.h"

/// Where the cooler stands, as in scenes/cooler.sdf: sunk in to its mudmat, one degree off the level.
inline const Vec3 kCoolerPosition{22.5, 2.0, 0.16};
inline constexpr double kCoolerRollDeg = -0.8;
inline constexpr double kCoolerPitchDeg = 0.6;
inline constexpr double kCoolerYawDeg = 62;
[[nodiscard]] Pose world_from_cooler();

/// One of the pipelines, as laid.
struct Route {
  Path plan;                      ///< At z = 0, from end to end.
  double radius;                  ///< Over its coating [m].
  std::vector<double> at;         ///< Stations [m] at which its clearance is known ...
  std::vector<double> clearance;  ///< ... of its underside above the bed [m]; negative where it is sunk in.
};
[[nodiscard]] const Route& inlet_line();   ///< Insulated flowline to the cooler, from starboard.
[[nodiscard]] const Route& outlet_line();  ///< Concrete-coated line from the cooler, to port; crosses the gas line.
[[nodiscard]] const Route& gas_line();     ///< Older line that passes in front of the cooler.
[[nodiscard]] const Route& umbilical();    ///< Thin, over the bed to the cooler's panel.

/// The line's axis in the world, every 0.4 m.
[[nodiscard]] Path axis_of(const Route& route);

/// Height of the bed: undulation, mounds of burrowing animals, furrows of a trawl, and what settled beside the pipes.
[[nodiscard]] double cooler_ground(double x, double y);

/// The bed as a grid, finest where the shipped sonar looks.
[[nodiscard]] Shape make_cooler_bed();
