// digitizer.h -- quantizes intensities to the integer counts that an instrument delivers.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Maps intensities to counts from 0 to N = 2^bits - 1, by their level L re full scale [dB]:
///
///   gamma        N x 10^(exponent L / 20)         linear in amplitude where the exponent is 1
///   logarithmic  N x (1 + L / mapping_range_db)
///
/// Results are rounded to the nearest integer, halves to the even one, and clipped to 0..N.
class Digitizer {
 public:
  /// @param full_scale_db     Recorded level that gives the count N [dB re the source's at 1 m, after gain].
  /// @param full_scale_share  Automatic gain: adapt() sets the level so that this share of a ping's intensities has the
  ///                          count N, (0, 1].
  Digitizer(const SonarConfig& sonar, double full_scale_db, std::optional<double> full_scale_share = {});

  /// With a full_scale_share, sets full scale to the level that this share of a ping's intensities reaches, within 0.02
  /// dB (0.4 %). Does not allocate.
  /// @param intensities  Without the bins that hold the transmit leak.
  void adapt(std::span<const float> intensities);

  /// @param counts  One per intensity; written.
  void digitize(std::span<const float> intensities, std::span<std::uint16_t> counts) const;

 private:
  static constexpr int kLevels = 1 << 16;

  Mapping mapping_;
  float max_count_, per_full_scale_;  // N, and 1 / the intensity of full scale.
  std::optional<double> share_;
  std::vector<std::uint32_t>
      histogram_;       // [upper half of an intensity: exponent and 8 bits of mantissa] Number of bins.
  float exponent_ = 0;  // kGamma: exponent of intensity. kLogarithmic: counts per unit of its logarithm.
};

}  // namespace insonify
