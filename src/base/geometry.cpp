// geometry.cpp -- rotations from roll, pitch and yaw, and spherical coordinates.

#include "insonify/geometry.h"

#include <cmath>

namespace insonify {

Eigen::Quaterniond orientation_from_rpy(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
         Eigen::AngleAxisd(roll, Vec3::UnitX());
}

Spherical spherical_from_point(const Vec3& point) {
  const double across = std::hypot(point.x(), point.y());
  return {point.norm(), std::atan2(point.y(), point.x()), std::atan2(point.z(), across)};
}

Vec3 point_from_spherical(const Spherical& spherical) {
  const double across = spherical.range * std::cos(spherical.elevation);
  return {across * std::cos(spherical.azimuth), across * std::sin(spherical.azimuth),
          spherical.range * std::sin(spherical.elevation)};
}

}  // namespace insonify
