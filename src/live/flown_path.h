// flown_path.h -- poses of a steered vehicle as the waypoints that a scenario file can hold.

#pragma once

#include "insonify/live_loop.h"

namespace insonify {

/// Time between the waypoints of a flown path [s].
inline constexpr double kPathStep = 0.05;

/// A waypoint that a scenario file represents exactly: time to 1 us, position to 1 um, angles to 1e-6
/// degrees.
[[nodiscard]] Waypoint exact_waypoint(double time, const Pose& world_from_vehicle);

/// The pose after a time of constant velocities in the vehicle's own frame.
/// @param time  [s], short: the position moves along the initial axes.
[[nodiscard]] Pose flown_on(const Pose& world_from_vehicle, const LiveVelocity& velocity, double time);

}  // namespace insonify
