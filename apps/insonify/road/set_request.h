// set_request.h -- settings of the scenario that another program asks for by a message.

#pragma once

#include <functional>
#include <string>

#include "insonify/live_loop.h"

namespace insonify {

/// Passes settings, such as max_range=20, on to a loop.
/// @param text    One setting a line; empty lines do not count.
/// @param answer  Called once, in a thread of the loop's or in this one, with "done: " and the text, or "refused: " and
///                the reason, which the user is told too.
void request_settings(LiveLoop& loop, const std::string& text, std::function<void(const std::string&)> answer);

}  // namespace insonify
