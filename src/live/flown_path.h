// flown_path.h -- poses of a steered vehicle as the waypoints that a scenario file can hold.

#pragma once

#include "insonify/live_loop.h"

namespace insonify {

/// Time between the waypoints of a flown path [s].
inline constexpr double kPathStep = 0.05;

/// A waypoint that a scenario file holds exactly: time and position to a millionth of a second and a metre, angles to a
/// millionth of a degree.
[[nodiscard]] Waypoint exact_waypoint(double time, const Pose& world_from_vehicle);

/// The pose after a time of constant velocities in the vehicle's own axes.
/// @param time  [s], short: the position moves along the axes at its start.
[[nodiscard]] Pose flown_on(const Pose& world_from_vehicle, const LiveVelocity& velocity, double time);

}  // namespace insonify
