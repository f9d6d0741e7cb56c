// insonified_sector.h -- the part of space that a sonar looks at, for drawing.

#pragma once

#include <utility>
#include <vector>

#include "insonify/sonar_config.h"

namespace insonify {

/// Of a scanning sonar all that its head sweeps over, seen from the housing.
class InsonifiedSector {
 public:
  InsonifiedSector(const SonarConfig& sonar, const Pose& world_from_sonar);

  [[nodiscard]] const Pose& world_from_sonar() const { return world_from_sonar_; }
  [[nodiscard]] double max_range() const { return max_range_; }  ///< [m]

  // Borders [rad]; of a full circle the azimuths are a whole turn apart.
  [[nodiscard]] double low_azimuth() const { return low_azimuth_; }
  [[nodiscard]] double high_azimuth() const { return high_azimuth_; }
  [[nodiscard]] double low_elevation() const { return low_elevation_; }
  [[nodiscard]] double high_elevation() const { return high_elevation_; }

  /// Place in the world of a range [m] and two shares of the apertures: 0 starboard or lower, 1 port or upper.
  [[nodiscard]] Vec3 point_at(double range, double across, double along) const;

  /// How far inside of the sector's borders a point of the world lies, as an angle [rad]; negative outside or out of
  /// range.
  [[nodiscard]] double inside_by(const Vec3& point) const;

  /// Its edges, in straight pieces: from the sonar along the four corners, and around the far end.
  [[nodiscard]] std::vector<std::pair<Vec3, Vec3>> edges() const;

 private:
  Pose world_from_sonar_, sonar_from_world_;
  double low_azimuth_, high_azimuth_, low_elevation_, high_elevation_;
  double min_range_, max_range_;
  bool full_circle_;
};

}  // namespace insonify
