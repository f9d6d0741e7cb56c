// ground_truth.h -- how much is kept of where the echo in each bin came from.

#pragma once

namespace insonify {

/// What pings and recordings tell of each bin beside its intensity. More costs time and memory, and changes no echo.
enum class GroundTruth {
  kNone,    ///< Nothing.
  kLabels,  ///< Instance, material and elevation of whatever gave more than half of the echo.
  kFull  ///< The strongest instances with their shares, the spread of elevation, path order, shadow and the direct echo
         ///< (calibrated model).
};

/// Instances that kFull names in each bin.
inline constexpr int kStrongestCount = 3;

}  // namespace insonify
