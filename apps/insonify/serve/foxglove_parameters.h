// foxglove_parameters.h -- what Foxglove's clients read and set as parameters: pause, speed, and each sonar's range.

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "serve/hub.h"

namespace insonify {

/// "/paused", "/speed", and of a simulation "/NAME/max_range" [m] of each sonar, as parameters of the protocol.
/// @param names  Those wanted; empty: all.
[[nodiscard]] nlohmann::json foxglove_parameters(Hub& hub, const std::vector<std::string>& names);

/// Sets one.
/// @param done  Called once, now or later and from any thread, with "" or the reason why it was refused.
/// @throws Error for an unknown parameter or a wrong value.
void set_foxglove_parameter(Hub& hub, const nlohmann::json& parameter, LiveLoop::Done done);

}  // namespace insonify
