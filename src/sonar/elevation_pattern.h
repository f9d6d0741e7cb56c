// elevation_pattern.h -- transmit and receive pattern of a vertical line array over elevation.

#pragma once

#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// One-way intensity gain |p|^2 of a vertical line array used for transmission and reception:
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

  /// @param array  The array's window and faults, one way (its pattern is applied twice). Its direction and width are
  ///               the sonar's elevation_center and elevation_aperture.
  ElevationPattern(const ArraySettings& array, const SonarConfig& sonar);

  // Edges of the sector that contains all elevations above the floor, within kSteepestElevation of level [rad].
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  /// |p|^2 at an elevation [rad]; outside the sector, the value at its edge.
  [[nodiscard]] double intensity(double elevation) const { return look_up(intensity_, elevation); }

  /// Envelope of |p|, one way: the maximum of |p| at this elevation and farther from the axis, and at least the floor.
  /// It falls monotonically from the axis outwards, over nulls and side lobes.
  [[nodiscard]] double envelope(double elevation) const { return look_up(envelope_, elevation); }

 private:
  [[nodiscard]] double look_up(const std::vector<float>& table, double elevation) const;

  double low_ = 0, high_ = 0, steps_per_radian_ = 0;
  std::vector<float> intensity_, envelope_;  // Tables at evenly spaced elevations from low_ to high_.
};

}  // namespace insonify
