// definitions.h -- definitions of the ROS message types in use: their .msg files without comments.

#pragma once

#include <string>
#include <string_view>

#include "insonify/messages.h"

namespace insonify {

/// The definition of a type, followed by those of all types that it is made of: each after a line of 80 equals signs
/// and a line "MSG: package/Type".
/// @param type  "sensor_msgs/Image"; must be one of those in definitions.cpp.
[[nodiscard]] std::string message_definition(std::string_view type, MessageForm form);

/// The checksum by which ROS 1 identifies a type that has a channel.
[[nodiscard]] std::string_view ros1_checksum(std::string_view type);

}  // namespace insonify
