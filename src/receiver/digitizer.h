// digitizer.h -- the whole numbers that an instrument delivers.

#pragma once

#include <cstdint>
#include <span>

#include "insonify/sonar_config.h"

namespace insonify {

/// Maps intensities to counts from 0 to 2^bits - 1, the greatest at full scale and beyond; L is the level re full
/// scale.
///
///   gamma        most x 10^(exponent L / 20)       linear in amplitude: exponent 1
///   logarithmic  most x (1 + L / mapping_range_db)
///
/// Rounded to the nearest count, halves to the even one.
class Digitizer {
 public:
  /// @param full_scale_db  Level of the greatest count, as intensities are recorded [dB].
  Digitizer(const SonarConfig& sonar, double full_scale_db);

  /// @param counts  One for each intensity; written.
  void digitize(std::span<const float> intensities, std::span<std::uint16_t> counts) const;

 private:
  Mapping mapping_;
  float most_, per_full_scale_;
  float exponent_ = 0;  // Of intensity, or of counts per unit of its logarithm.
};

}  // namespace insonify
