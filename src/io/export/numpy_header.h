// numpy_header.h -- the header of an .npy array.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace insonify {

/// Version 1.0: magic, length, and a Python dictionary of type and shape, filled up to a multiple of 64 bytes.
/// @param type  NumPy's name: "<f4".
[[nodiscard]] std::string numpy_header(const std::string& type, const std::vector<std::uint64_t>& shape);

}  // namespace insonify
