// scenario_keys.h -- which keys a scenario file may have, and where.

#pragma once

#include <string>
#include <vector>

namespace insonify {

[[nodiscard]] std::vector<std::string> scenario_keys();

/// Of one entry of `sonars`.
[[nodiscard]] std::vector<std::string> sonar_keys();

/// Those of their parts, as paths: "water.depth", "receiver.noise", "sampling.rows".
/// @param sampling  Path of that part, which belongs to a sonar.
[[nodiscard]] std::vector<std::string> part_keys(const char* sampling = "sampling");

}  // namespace insonify
