// checks.h -- what several parts of a simulator check: poses, speeds, receivers, indices of sonars.

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "insonify/geometry.h"
#include "insonify/scenario.h"

namespace insonify {

/// @param object  What the pose is, for the message: "world_from_vehicle".
/// @throws Error for a position out of coordinate()'s limits, and for a quaternion that is not of unit norm.
void check_pose(std::string_view object, const Pose& pose);

/// @param scenario  Of the calibrated model; its sonars and receivers are valid by themselves.
/// @throws Error for the first beam pattern, focus, pulse or gain that the sonar cannot have.
void check_receivers(const Scenario& scenario);

/// Motion in a ping is computed to first order in speed over sound speed.
/// @throws Error "trajectory[1] comes to 120 m/s from the one before; with motion_in_ping at most 100 m/s".
void check_speeds(const Trajectory& trajectory);

/// Time of a ping [s]: number times period, within the spans one after the other; the last of them has no end.
[[nodiscard]] double ping_time(std::span<const PingSpan> spans, double period, std::uint64_t number);

/// Rounds up to three digits.
/// @param value  > 0.
[[nodiscard]] inline double rounded_up(double value) {
  const double digit = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::ceil(value / digit) * digit;
}

/// The index itself.
/// @param count  Number of sonars.
/// @throws Error "sonar = 5 must be from 0 to 1, the last".
[[nodiscard]] std::size_t sonar_index(int sonar, std::size_t count);

}  // namespace insonify
