// check_speeds.h -- limit of a vehicle's speed with motion in a ping.

#pragma once

#include "insonify/scenario.h"

namespace insonify {

/// Motion in a ping is computed to first order in speed over sound speed.
/// @throws Error "trajectory[1] comes to 120 m/s from the one before; with motion_in_ping at most 100 m/s".
void check_speeds(const Trajectory& trajectory);

}  // namespace insonify
