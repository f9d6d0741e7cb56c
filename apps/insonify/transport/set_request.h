// set_request.h -- changes settings at the request of another program.

#pragma once

#include <functional>
#include <string>

#include "insonify/live_loop.h"

namespace insonify {

/// Passes settings, such as max_range=20, to a loop.
/// @param text    One setting per line; empty lines are ignored.
/// @param answer  Called once, in one of the loop's threads or in this one, with "done: " and the text, or "refused: "
///                and the reason, which is also printed.
void request_settings(LiveLoop& loop, const std::string& text, std::function<void(const std::string&)> answer);

}  // namespace insonify
