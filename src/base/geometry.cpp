// geometry.cpp -- rotations from roll, pitch and yaw, and spherical coordinates.

#include "insonify/geometry.h"

#include <cmath>

namespace insonify {

Eigen::Quaterniond orientation_from_rpy(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
         Eigen::AngleAxisd(roll, Vec3::UnitX());
}

Vec3 rpy_from_orientation(const Eigen::Quaterniond& orientation) {
  const Eigen::Matrix3d r = orientation.toRotationMatrix();
  const double yaw = std::atan2(r(1, 0), r(0, 0));
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  // The roll that is left once yaw is undone: well defined also where pitch is straight up or down.
  const double sine = std::sin(yaw), cosine = std::cos(yaw);
  const double roll = std::atan2(sine * r(0, 2) - cosine * r(1, 2), cosine * r(1, 1) - sine * r(0, 1));
  return {roll, pitch, yaw};
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
