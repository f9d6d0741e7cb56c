// sonar_index.h -- rejects invalid indices of sonars.

#pragma once

#include <cstddef>

namespace insonify {

/// The index itself.
/// @param count  Number of sonars.
/// @throws Error "sonar = 5 must be from 0 to 1, the last".
[[nodiscard]] std::size_t sonar_index(int sonar, std::size_t count);

}  // namespace insonify
