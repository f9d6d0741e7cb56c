// sampling_error.h -- how far the mean image of a ping is from that of a converged one.

#pragma once

#include <span>

namespace insonify {

/// Sampling error of one or more images, without noise and speckle. Levels are compared where either image is within
/// `range_db` of the loudest cell of the converged one; what is lower reads as that level, as in a picture that ends
/// there.
class SamplingError {
 public:
  /// @param range_db  [dB], > 0.
  explicit SamplingError(double range_db) : range_db_(range_db) {}

  /// Adds one image. Nothing is added where the converged one is zero everywhere.
  /// @param full_scale  The level that `range_db` is counted from; as a rule the largest value of the converged ping.
  void add(std::span<const float> image, std::span<const float> converged, float full_scale);

  [[nodiscard]] double rms_db() const;    ///< Root of the mean squared difference of levels [dB]; 0 without cells.
  [[nodiscard]] double spots() const;     ///< Share of the cells that are more than 6 dB too loud.
  [[nodiscard]] double holes() const;     ///< Share of the cells that are more than 6 dB too faint.
  [[nodiscard]] double level_db() const;  ///< Sum of the images re the sum of the converged ones [dB]; 0 without cells.

 private:
  double range_db_;
  double squares_ = 0, sum_ = 0, converged_sum_ = 0;
  long long cells_ = 0, spots_ = 0, holes_ = 0;
};

}  // namespace insonify
