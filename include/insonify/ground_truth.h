// ground_truth.h -- how much is kept of where the echo in each bin came from.

#pragma once

#include <cstdint>

namespace insonify {

/// What pings and recordings tell of each bin beside its intensity. More costs time and memory, and changes no echo.
enum class GroundTruth {
  kNone,    ///< Nothing.
  kLabels,  ///< Instance, material and elevation of the surface that gave most of the echo.
  kFull  ///< The strongest instances with their shares, the spread of elevation, path order, shadow and the direct echo
         ///< (calibrated model).
};

/// Instances that kFull names in each bin.
inline constexpr int kStrongestCount = 3;

/// Instance or material of a bin in which nothing echoed.
inline constexpr std::uint16_t kNoLabel = 0xffff;

/// Path orders kept apart: 1 (primary, after one surface), 2 (secondary), 3.
inline constexpr int kPathOrders = 3;

}  // namespace insonify
