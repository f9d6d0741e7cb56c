// gazebo_shapes.h -- converts the shapes of Gazebo's visuals.

#pragma once

#include <ignition/msgs/geometry.pb.h>
#include <ignition/msgs/pose.pb.h>

#include <string>
#include <variant>

#include "insonify/geometry.h"
#include "insonify/world_parts.h"

namespace insonify {

/// @return  The shape, or the reason for having none: "it has no shape".
[[nodiscard]] std::variant<Shape, std::string> shape_of(const ignition::msgs::Geometry& geometry);

/// An orientation of norm 0, as in an unset message field, counts as identity.
[[nodiscard]] Pose pose_of(const ignition::msgs::Pose& pose);

}  // namespace insonify
