// hdf5_header.h -- finds the length of a dataset in an HDF5 file.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace insonify {

/// Positions in the file of the 8-byte numbers that say how many rows a chunked dataset has [bytes].
struct GrowthFields {
  std::uint64_t dimension = 0;  ///< First dimension,
  std::uint64_t maximum = 0;    ///< what it may grow to (all ones: anything) and
  std::uint64_t index = 0;      ///< where the root of the chunks' index is (all ones while there are none).
};

/// Finds them in a version 1 object header: "HDF5 File Format Specification Version 2.0", sections IV.A.1.a (version 1
/// object header prefix), IV.A.2.b (dataspace message, version 1) and IV.A.2.i (data layout message, version 3).
/// @param file     The bytes of the file from its start.
/// @param address  Of the object header [bytes].
/// @return         Zeros if the header is of another kind.
[[nodiscard]] GrowthFields find_growth_fields(std::span<const std::byte> file, std::uint64_t address);

}  // namespace insonify
