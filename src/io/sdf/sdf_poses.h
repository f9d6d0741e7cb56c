// sdf_poses.h -- vectors and poses as libsdformat has them.

#pragma once

#include <sdf/sdf_config.h>

#include <map>
#include <sdf/World.hh>
#include <string>

#include "insonify/geometry.h"

// From Gazebo's library since version 13, from Ignition's before.
#if SDF_MAJOR_VERSION >= 13
#include <gz/math/Pose3.hh>
namespace insonify {
namespace sdf_math = gz::math;
}
#else
#include <ignition/math/Pose3.hh>
namespace insonify {
namespace sdf_math = ignition::math;
}
#endif

namespace insonify {

[[nodiscard]] Pose pose_of(const sdf_math::Pose3d& pose);

/// Poses of models in the world at the time when Gazebo saved it, by name. The first of several states is used, as in
/// Gazebo.
[[nodiscard]] std::map<std::string, Pose> sdf_saved_poses(const sdf::World& world);

}  // namespace insonify
