// numpy_pings.h -- an array as pings: which of its axes are bins and beams, and their scales.

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/foreign/foreign_tables.h"
#include "io/foreign/numpy_array.h"

namespace insonify {

/// Lengths of pings, bins and beams, and how far apart neighbours on each lie in the array.
struct ArrayAxes {
  std::array<std::uint64_t, 3> length = {1, 1, 1}, stride = {0, 0, 0};
};

/// What the last two axes of an array are.
enum class AxisOrder { kBinBeam, kBeamBin, kPingBin };

/// @throws Error for more than three axes.
[[nodiscard]] ArrayAxes axes_of(const std::vector<std::uint64_t>& shape, AxisOrder order, const std::string& name);

/// One ping, the beams of each bin together.
[[nodiscard]] std::vector<std::byte> ping_in(const NumpyArray& array, const ArrayAxes& axes, std::uint64_t ping);

/// Tables whose `intensity` is the array.
[[nodiscard]] std::unique_ptr<ForeignTables> tables_of(const std::filesystem::path& path, NumpyArray array,
                                                       const ArrayAxes& axes);

/// What an archive says about the axes, and what is assumed where it says nothing.
struct ArrayScales {
  std::vector<double> azimuths = {}, ranges = {};  ///< [beam] Positive to port [rad]; [bin] [m].
  double most_range = 0;                           ///< [m]; 0: unknown.
};

/// Describes the sonar of an array by its scales.
void describe_array(ForeignTables& tables, const ArrayAxes& axes, const ArrayScales& scales);

}  // namespace insonify
