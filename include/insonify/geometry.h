// geometry.h -- points, directions, poses and rays, and the two coordinate frames: world and sonar.

#pragma once

#include <Eigen/Geometry>
#include <numbers>

namespace insonify {

// World frame: right-handed, z up. Sonar frame: right-handed, x along the acoustic axis, y to port, z up (REP 103).
// Azimuth turns from +x to +y (to port), elevation from +x to +z (up).
using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;

/// A rigid transform, named after both frames, result first: `p_world = world_from_sonar * p_sonar`.
struct Pose {
  Vec3 position = Vec3::Zero();                                     ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< Unit quaternion.

  [[nodiscard]] Vec3 operator*(const Vec3& point) const { return position + orientation * point; }
  [[nodiscard]] Pose operator*(const Pose& inner) const {
    return {position + orientation * inner.position, (orientation * inner.orientation).normalized()};
  }
  [[nodiscard]] Pose inverse() const {
    const Eigen::Quaterniond back = orientation.conjugate();
    return {-(back * position), back};
  }
};

/// Orientation from roll about x, then pitch about y, then yaw about z, all about fixed axes, as in SDF [rad].
/// Positive pitch looks down.
[[nodiscard]] Eigen::Quaterniond orientation_from_rpy(double roll, double pitch, double yaw);

/// A point in the sonar's spherical coordinates.
struct Spherical {
  double range = 0;      ///< Distance from the sonar [m].
  double azimuth = 0;    ///< Angle in the fan, positive to port [rad], -pi..pi.
  double elevation = 0;  ///< Angle across the fan, positive up [rad], -pi/2..pi/2.
};

/// The angles of such an orientation: roll and yaw within +-pi, pitch within +-pi/2. Straight up and down, where only a
/// sum of roll and yaw is defined, it is split so that orientation_from_rpy() gives the orientation again.
[[nodiscard]] Vec3 rpy_from_orientation(const Eigen::Quaterniond& orientation);

/// Cartesian to spherical coordinates in the sonar frame. Elevation is measured from the x-y plane. (The equation in
/// the paper gives the polar angle from +z, and jumps at z = 0.) The origin maps to zeros.
[[nodiscard]] Spherical spherical_from_point(const Vec3& point);
[[nodiscard]] Vec3 point_from_spherical(const Spherical& spherical);

[[nodiscard]] constexpr double radians_from_degrees(double degrees) {
  return degrees / 180.0 * std::numbers::pi;
}
[[nodiscard]] constexpr double degrees_from_radians(double radians) {
  return radians / std::numbers::pi * 180.0;
}

/// A ray, limited to the interval from min_distance to max_distance.
struct Ray {
  Vec3 origin = Vec3::Zero();      ///< World frame [m].
  Vec3 direction = Vec3::UnitX();  ///< Unit vector, world frame.
  double min_distance = 0;         ///< [m], >= 0
  double max_distance = 1e30;      ///< [m]
};

}  // namespace insonify
