// ground_truth.h -- how much ground truth is recorded for each bin.

#pragma once

#include <cstdint>

#include "insonify/words.h"

namespace insonify {

/// Which ground truth pings and recordings hold for each bin (docs/concepts/ground-truth.md). More of it costs time and
/// memory, and does not change echoes.
enum class GroundTruth {
  kNone,    ///< Nothing.
  kLabels,  ///< Instance, material and elevation of the surface that gave most of the echo.
  kFull  ///< The strongest instances with their shares, the spread of elevation, path order, shadow and the direct echo
         ///< (calibrated model).
};
template <>
constexpr auto words_of<GroundTruth>() {
  return EnumWords<GroundTruth, 3>{
      {{"none", GroundTruth::kNone}, {"labels", GroundTruth::kLabels}, {"full", GroundTruth::kFull}}};
}

/// Instances listed per bin with kFull.
inline constexpr int kStrongestCount = 3;

/// Instance or material of a bin without an echo.
inline constexpr std::uint16_t kNoLabel = 0xffff;

/// Path orders kept apart: 1 (primary, after one surface), 2 (secondary), 3.
inline constexpr int kPathOrders = 3;

}  // namespace insonify
