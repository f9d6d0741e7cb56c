// scenario_keys.h -- which keys a scenario file may have, and where.

#pragma once

#include <string>
#include <vector>

namespace insonify {

[[nodiscard]] std::vector<std::string> scenario_keys();

/// Keys of one entry of `sonars`.
[[nodiscard]] std::vector<std::string> sonar_keys();

/// Those of their parts, as paths: "water.depth", "receiver.noise", "sampling.rows".
/// @param sonar  Prefix of paths in a sonar's parts: "sonars[0]"; "" if they all refer to a sonar.
[[nodiscard]] std::vector<std::string> part_keys(const std::string& sonar = "");

}  // namespace insonify
