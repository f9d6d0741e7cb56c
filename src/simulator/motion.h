// motion.h -- objects of the world that follow a trajectory of their own.

#pragma once

#include <vector>

#include "insonify/scenario.h"

namespace insonify {

/// An instance that moves, and how its mesh lies in the object that the trajectory places.
struct MovingPart {
  int instance = 0;
  int motion = 0;         ///< Index into Scenario::motions.
  Pose object_from_mesh;  ///< The object's frame is where the trajectory has it at time 0.

  [[nodiscard]] Pose world_from_mesh(const Scenario& scenario, double time) const {
    return scenario.motions[motion].trajectory.at(time) * object_from_mesh;
  }
};

/// Finds the instances that the motions name: those of that very name, and all whose name starts with it and "::".
/// Marks them moving.
/// @throws Error for a motion whose object is not there or already moves; the message lists the objects there are.
[[nodiscard]] std::vector<MovingPart> find_moving_parts(const Scenario& scenario, Scene& scene);

}  // namespace insonify
