// drawn_sonar.h -- what camera views draw of a sonar: its housing, a small cylinder, and the volume that it insonifies.

#pragma once

#include <utility>
#include <vector>

#include "insonify/sonar_config.h"

namespace insonify {

/// A capped cylinder along the acoustic axis, or upright for a scanning head. The transducer end is darker.
class Housing {
 public:
  /// @param radius  [m]
  Housing(const SonarConfig& sonar, const Pose& world_from_sonar, double radius);

  struct Cut {
    double distance = 0;  ///< From the ray's origin [m]; infinite for a miss.
    Vec3 normal = Vec3::Zero();
    bool transducer = false;
  };
  [[nodiscard]] Cut cut(const Ray& ray) const;

 private:
  Pose housing_from_world_;  // z along the cylinder.
  Pose world_from_housing_;
  double radius_, low_, high_;  // The cylinder reaches from low_ to high_ along z.
  double band_;                 // The transducer is above this z.
};

/// Limits in azimuth, elevation and range, in the frame of the housing. A scanning sonar's sector is all that its head
/// sweeps. That of a side-scan sonar is two, each in the frame of its side.
class InsonifiedSector {
 public:
  InsonifiedSector(const SonarConfig& sonar, const Pose& world_from_sonar);

  [[nodiscard]] const Pose& world_from_sonar() const { return world_from_sonar_; }
  [[nodiscard]] double max_range() const { return max_range_; }  ///< [m]

  // Limits [rad]; on a full circle the azimuths differ by 2 pi.
  [[nodiscard]] double low_azimuth() const { return low_azimuth_; }
  [[nodiscard]] double high_azimuth() const { return high_azimuth_; }
  [[nodiscard]] double low_elevation() const { return low_elevation_; }
  [[nodiscard]] double high_elevation() const { return high_elevation_; }

  /// World position at a range [m] and at fractions of both apertures: 0 is starboard or lower, 1 port or upper. Across
  /// a side-scan sonar, the lower half of the fractions are those of its starboard side.
  [[nodiscard]] Vec3 point_at(double range, double across, double along) const;

  /// Angle from a point inside the sector to the nearest azimuth or elevation limit [rad]; negative for points outside
  /// the sector or its range interval.
  [[nodiscard]] double inside_by(const Vec3& point) const;

  /// Edges as short line segments: from the sonar along the four corners, and around the far end.
  [[nodiscard]] std::vector<std::pair<Vec3, Vec3>> edges() const;

 private:
  [[nodiscard]] Vec3 point_of(std::size_t aperture, double range, double across, double along) const;
  [[nodiscard]] double inside_of(std::size_t aperture, const Vec3& point) const;

  Pose world_from_sonar_;
  std::vector<Pose> world_from_apertures_;
  double low_azimuth_, high_azimuth_, low_elevation_, high_elevation_;
  double min_range_, max_range_;
  bool full_circle_;
};

}  // namespace insonify
