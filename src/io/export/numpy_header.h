// numpy_header.h -- what an .npy array begins with.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace insonify {

/// Version 1.0: magic, length, and a Python dictionary of type and shape, filled up to a multiple of 64 bytes.
/// @param type  As NumPy spells it: "<f4".
[[nodiscard]] std::string numpy_header(const std::string& type, const std::vector<std::uint64_t>& shape);

}  // namespace insonify
