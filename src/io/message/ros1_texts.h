// ros1_texts.h -- ROS 1's own definitions of its messages, comments included.

#pragma once

#include <string_view>

namespace insonify {

/// The text of a type's .msg file, "" for types that are not of ROS itself, such as those of marine_acoustic_msgs.
/// `rosbag check` takes a bag whose definitions differ from the installed ones, be it in a comment, for one of older
/// messages.
[[nodiscard]] std::string_view ros1_text(std::string_view type);

}  // namespace insonify
