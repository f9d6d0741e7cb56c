// elevation_pattern.h -- how an upright array sends and hears across elevations.

#pragma once

#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// The intensity |p|^2, one way, with which an upright line array sends and hears: that of one
///
///     p(elevation) = g((L / wavelength) sin(elevation - elevation_center))
///
/// with g of ArrayPattern and L such that it is as wide at half power as the elevation aperture. It is baffled: nothing
/// goes or comes more than 90 degrees off its axis. Looked up in a table, to 1e-4 of the peak and mostly far better.
class ElevationPattern {
 public:
  /// Sent and heard, re the peak [dB]: what is weaker is not sampled.
  static constexpr double kFloorDb = -40;

  /// @param array  One way: it is used twice. At the sonar's elevation_center and of its elevation_aperture.
  ElevationPattern(const ArraySettings& array, const SonarConfig& sonar);

  // The sector that holds every elevation above the floor, within kSteepestElevation of level [rad].
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  /// |p|^2 at an elevation of the sector [rad]; at its edge beyond.
  [[nodiscard]] double intensity(double elevation) const { return look_up(intensity_, elevation); }

  /// The most that |p| is here or farther from the axis, but not less than the floor, one way: what falls from the axis
  /// outwards, over nulls and side lobes alike.
  [[nodiscard]] double envelope(double elevation) const { return look_up(envelope_, elevation); }

 private:
  [[nodiscard]] double look_up(const std::vector<float>& table, double elevation) const;

  double low_ = 0, high_ = 0, steps_per_radian_ = 0;
  std::vector<float> intensity_, envelope_;  // Evenly from low_ to high_.
};

}  // namespace insonify
