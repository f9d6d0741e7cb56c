// ground_truth.h -- how much ground truth is recorded for each bin.

#pragma once

namespace insonify {

/// Which ground truth pings and recordings hold for each bin (docs/concepts/ground-truth.md). More of it costs time and
/// memory, and does not change echoes.
enum class GroundTruth {
  kNone,    ///< None.
  kLabels,  ///< Instance, material and elevation of the surface that gave the majority of the bin's energy.
  kFull  ///< The strongest instances with their shares, the spread of elevation, path order, shadow and the direct echo
         ///< (calibrated model).
};

/// Instances listed per bin with kFull.
inline constexpr int kStrongestCount = 3;

}  // namespace insonify
