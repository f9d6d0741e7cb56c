// find_thrusters.h -- where a sonar's head has the thrusters of the vehicle, and which of them it hears.

#pragma once

#include <optional>
#include <span>

#include "echo/engine.h"
#include "insonify/thruster.h"

namespace insonify {

/// Writes the place of each thruster in the frame of the head [m], or none where a surface is in the way. Allocates
/// nothing.
void find_thrusters(std::span<const Thruster> thrusters, const Pose& vehicle_from_head, const Pose& world_from_vehicle,
                    Engine& engine, std::span<std::optional<Vec3>> places);

}  // namespace insonify
