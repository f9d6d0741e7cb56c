// find_thrusters.h -- positions of the vehicle's thrusters in the frame of a sonar's head, and whether they are hidden.

#pragma once

#include <optional>
#include <span>

#include "echo/engine.h"
#include "insonify/thruster.h"

namespace insonify {

/// Writes the position of each thruster in the frame of the head [m], or none if the path is blocked. Does not
/// allocate.
void find_thrusters(std::span<const Thruster> thrusters, const Pose& vehicle_from_head, const Pose& world_from_vehicle,
                    Engine& engine, std::span<std::optional<Vec3>> places);

}  // namespace insonify
