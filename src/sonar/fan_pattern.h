// fan_pattern.h -- azimuth pattern of a fan's transmitter, or of one element of its receiver.

#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace insonify {

/// Intensity gain sinc^2(l u) of a short line transducer of l wavelengths that is `width` wide at half power, at the
/// sine u of a bearing (Van Trees, Optimum Array Processing (2002), section 2.2). It is 1 on the axis; without a width,
/// everywhere.
class FanPattern {
 public:
  /// @param width  Full width at half power [rad], in (0, pi).
  explicit FanPattern(std::optional<double> width) : length_(width ? kLineWidth / (2 * std::sin(0.5 * *width)) : 0.0) {}

  [[nodiscard]] bool is_flat() const { return length_ == 0; }

  [[nodiscard]] double length() const { return length_; }  ///< [wavelengths]; 0 if flat.

  /// Gain at the sine of a bearing in front, at least kLeast: what divides by it needs no case of its own.
  [[nodiscard]] double intensity(double sine) const {
    const double x = std::numbers::pi * length_ * sine;
    const double gain = std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x;
    return std::max(gain * gain, kLeast);
  }

 private:
  static constexpr double kLineWidth = 0.8858929413781328;  // Width of sinc^2 at half power.
  static constexpr double kLeast = 1e-6;
  double length_;
};

}  // namespace insonify
