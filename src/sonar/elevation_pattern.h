// elevation_pattern.h -- patterns over elevation of a sonar's transmitter and receiver, each a vertical line array.

#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Evenly spaced elevations at which a table has values.
struct PatternAxis {
  double low = 0;               ///< Elevation of the first value [rad].
  double steps_per_radian = 0;  ///< [1/rad]

  /// The value at an elevation [rad], interpolated; outside the table, that at its edge.
  [[nodiscard]] double look_up(const std::vector<float>& table, double elevation) const;
};

/// One-way intensity gain of a vertical line array, 1 on its axis. Without errors it is |g|^2 of x = (L / wavelength)
/// u, where g is ArrayPattern's, u the sine of the angle off the axis, and the length L makes the width at half power
/// equal to the aperture. With independent errors of N = 2 L / wavelength parts, it is the mean over arrays:
///
///     (|g|^2 + k sinc^2(u / 2)) / (1 + k),   k = (exp(a^2 + f^2) - 1) / (N taper efficiency)
///
/// where a and f are the standard deviations of the logarithm of amplitude and of phase, and sinc^2(u / 2) is the
/// pattern of one part (J. Ruze, Nuovo Cimento 9, suppl. 3, 364 (1952); Van Trees, Optimum Array Processing (2002),
/// section 2.6.3).
class VerticalArray {
 public:
  /// @param array     Window, one way, and errors: element_error_db and element_error, for a continuous line too.
  /// @param aperture  Width at half power without errors [rad].
  VerticalArray(const ArraySettings& array, double aperture);

  [[nodiscard]] double length() const { return length_; }  ///< L [wavelengths].
  [[nodiscard]] double intensity(double sine) const;       ///< Gain at u.

 private:
  ArrayPattern pattern_;
  double length_;
  double scattered_;  // k.
};

/// VerticalArray over elevation, around elevation_center. The array is baffled: the gain is 0 more than 90 degrees off
/// its axis. Values are interpolated in a table, with an error of at most 1e-4 of the peak.
class ElevationPattern {
 public:
  /// Two-way gain re the peak below which elevations are not sampled [dB].
  static constexpr double kFloorDb = -40;

  /// @param array     As VerticalArray's.
  /// @param aperture  As VerticalArray's [rad].
  /// @param center    Its direction: SonarConfig::elevation_center [rad].
  /// @param floor_db  One-way gain re the peak below which elevations do not count [dB].
  ElevationPattern(const ArraySettings& array, double aperture, double center, double floor_db = 0.5 * kFloorDb);

  // Edges of the sector that contains all elevations above the floor, within kSteepestElevation of level [rad].
  [[nodiscard]] double low() const { return axis_.low; }
  [[nodiscard]] double high() const { return high_; }

  /// |p|^2 at an elevation [rad]; outside the sector, the value at its edge.
  [[nodiscard]] double intensity(double elevation) const { return axis_.look_up(intensity_, elevation); }

  /// Envelope of |p|, one way: the maximum of |p| at this elevation and farther from the axis, and at least the floor.
  /// It falls monotonically from the axis outwards, over nulls and side lobes.
  [[nodiscard]] double envelope(double elevation) const { return axis_.look_up(envelope_, elevation); }

  /// The table of intensity(), and its elevations.
  [[nodiscard]] const PatternAxis& axis() const { return axis_; }
  [[nodiscard]] const std::vector<float>& table() const { return intensity_; }

 private:
  PatternAxis axis_;
  double high_ = 0;
  std::vector<float> intensity_, envelope_;  // Tables at evenly spaced elevations from low() to high().
};

/// Transmitter or receiver across elevations: an array, or a top hat.
struct ElevationWay {
  std::optional<ArraySettings> array = {};  ///< Absent: a top hat.
  double aperture = 0;                      ///< Full height; at half power with an array [rad].
};

/// Patterns across elevations of transmitter and receiver, which may differ, and the sector that is sampled: where both
/// count, and their product is above ElevationPattern::kFloorDb.
class ElevationPatterns {
 public:
  /// @param sent    Absent: as `received`.
  /// @param center  Direction of both [rad].
  ElevationPatterns(const ElevationWay& received, const std::optional<ElevationWay>& sent, double center);

  [[nodiscard]] bool is_top_hat() const { return !received_ && !sent_; }
  [[nodiscard]] bool differ() const { return differ_; }  ///< Whether transmitter and receiver do.

  /// Half the height of the sector of top hats [rad].
  [[nodiscard]] double half() const { return half_; }

  // Edges of the sector [rad].
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  // One-way patterns; null for a top hat.
  [[nodiscard]] const ElevationPattern* sent() const { return differ_ ? pointer(sent_) : pointer(received_); }
  [[nodiscard]] const ElevationPattern* received() const { return pointer(received_); }

  /// Envelope of the amplitude, one way: the geometric mean of both.
  [[nodiscard]] double envelope(double elevation) const;

 private:
  [[nodiscard]] static const ElevationPattern* pointer(const std::optional<ElevationPattern>& pattern) {
    return pattern ? &*pattern : nullptr;
  }
  void cut_to_floor();

  bool differ_;
  std::optional<ElevationPattern> sent_, received_;  // sent_ only where they differ.
  double half_, low_ = -HUGE_VAL, high_ = HUGE_VAL;
};

/// A one-way gain |p|^2; 1 within a top hat.
[[nodiscard]] inline double gain_at(const ElevationPattern* pattern, double elevation) {
  return pattern != nullptr ? pattern->intensity(elevation) : 1.0;
}

}  // namespace insonify
