// message_channels.h -- topics and types of the messages about one sonar.

#pragma once

#include <string>
#include <vector>

#include "insonify/messages.h"

namespace insonify {

/// Channels of the sonar called `name` in topics.
/// @param raw  Whether to include one for raw images.
[[nodiscard]] std::vector<MessageChannel> message_channels(const std::string& name, MessageForm form, bool raw);

}  // namespace insonify
