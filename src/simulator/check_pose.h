// check_pose.h -- rejects invalid poses.

#pragma once

#include <string_view>

#include "insonify/geometry.h"

namespace insonify {

/// @param object  What the pose is, for the message: "world_from_vehicle".
/// @throws Error for a position out of coordinate()'s limits, and for a quaternion that is not of unit norm.
void check_pose(std::string_view object, const Pose& pose);

}  // namespace insonify
