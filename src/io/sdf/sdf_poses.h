// sdf_poses.h -- poses as libsdformat has them.

#pragma once

#include <map>
#include <sdf/World.hh>
#include <string>

#include "insonify/geometry.h"
#include "io/sdf/sdf_math.h"

namespace insonify {

[[nodiscard]] Pose pose_of(const sdf_math::Pose3d& pose);

/// Poses of models in the world at the time when Gazebo saved it, by name. The first of several states is used, as in
/// Gazebo.
[[nodiscard]] std::map<std::string, Pose> sdf_saved_poses(const sdf::World& world);

}  // namespace insonify
