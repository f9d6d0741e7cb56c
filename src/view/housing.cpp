// housing.cpp -- intersection of a ray with a capped cylinder.

#include "view/housing.h"

#include <cmath>
#include <limits>

namespace insonify {

Housing::Housing(const SonarConfig& sonar, const Pose& world_from_sonar, double radius) : radius_(radius) {
  const bool scans = sonar.scans();
  world_from_housing_ = world_from_sonar;
  if (!scans) {  // Turns z onto the acoustic axis.
    world_from_housing_.orientation =
        world_from_sonar.orientation * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY());
  }
  housing_from_world_ = world_from_housing_.inverse();
  low_ = scans ? -2.4 * radius : -2.8 * radius;
  high_ = scans ? 0.8 * radius : 0;
  band_ = scans ? -0.5 * radius : -0.6 * radius;
}

Housing::Cut Housing::cut(const Ray& ray) const {
  const Vec3 origin = housing_from_world_ * ray.origin;
  const Vec3 along = housing_from_world_.orientation * ray.direction;
  Cut nearest{.distance = std::numeric_limits<double>::infinity()};
  const auto consider = [&](double distance, const Vec3& normal, double z) {
    if (distance > ray.min_distance && distance < nearest.distance) {
      nearest = {distance, world_from_housing_.orientation * normal, z > band_};
    }
  };
  for (const double cap : {low_, high_}) {
    const double distance = (cap - origin.z()) / along.z();
    const Vec3 point = origin + distance * along;
    if (along.z() != 0 && std::hypot(point.x(), point.y()) <= radius_) {
      consider(distance, Vec3(0, 0, cap == high_ ? 1 : -1), cap);
    }
  }
  const double a = along.head<2>().squaredNorm();
  const double b = origin.head<2>().dot(along.head<2>());
  const double c = origin.head<2>().squaredNorm() - radius_ * radius_;
  if (a > 0 && b * b >= a * c) {
    const double distance = (-b - std::sqrt(b * b - a * c)) / a;
    const Vec3 point = origin + distance * along;
    if (point.z() >= low_ && point.z() <= high_) {
      consider(distance, Vec3(point.x(), point.y(), 0) / radius_, point.z());
    }
  }
  return nearest;
}

}  // namespace insonify
