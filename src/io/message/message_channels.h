// message_channels.h -- topics and types of the messages about one sonar, and definitions of the ROS types: their .msg
// files without comments.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "insonify/messages.h"

namespace insonify {

/// Channels of the sonar called `name` in topics.
[[nodiscard]] std::vector<MessageChannel> message_channels(const std::string& name, MessageForm form,
                                                           const MessageOptions& options, const SonarConfig& sonar);

/// The definition of a type, followed by those of all types that it is made of: each after a line of 80 equals signs
/// and a line "MSG: package/Type".
/// @param type  "sensor_msgs/Image"; must be one of those in message_channels.cpp.
[[nodiscard]] std::string message_definition(std::string_view type, MessageForm form);

/// The checksum by which ROS 1 identifies a type that has a channel.
[[nodiscard]] std::string_view ros1_checksum(std::string_view type);

}  // namespace insonify
