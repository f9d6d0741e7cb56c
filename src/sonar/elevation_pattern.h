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

/// One-way intensity gain |p|^2 of a vertical line array:
///
///     p(elevation) = g((L / wavelength) sin(elevation - elevation_center))
///
/// where g is ArrayPattern's and the length L makes the width at half power equal to the elevation aperture. The array
/// is baffled: the gain is 0 more than 90 degrees off its axis. Values are interpolated in a table, with an error of at
/// most 1e-4 of the peak.
class ElevationPattern {
 public:
  /// Two-way gain re the peak below which elevations are not sampled [dB].
  static constexpr double kFloorDb = -40;

  /// @param array     The array's window, one way.
  /// @param aperture  Its width at half power [rad].
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
