// stabilise.cpp -- replaces the angles of a housing by those at which its beams are held.

#include "sonar/stabilise.h"

#include <cmath>
#include <numbers>

namespace insonify {

Pose stabilised(const SonarConfig& sonar, const Pose& world_from_sonar, const Vec3& velocity) {
  if (!sonar.is_multibeam() || !(sonar.roll_stabilised || sonar.pitch_stabilised || sonar.yaw_stabilised)) {
    return world_from_sonar;
  }
  constexpr double kSlowest = 0.05;
  const Eigen::AngleAxisd down(std::numbers::pi / 2, Vec3::UnitY());  // As SonarConfig::vehicle_from_sonar().
  Vec3 rpy = rpy_from_orientation(world_from_sonar.orientation * down.inverse());
  if (sonar.roll_stabilised) {
    rpy.x() = 0;
  }
  if (sonar.pitch_stabilised) {
    rpy.y() = 0;
  }
  if (sonar.yaw_stabilised && velocity.head<2>().norm() >= kSlowest) {
    rpy.z() = std::atan2(velocity.y(), velocity.x());
  }
  return {world_from_sonar.position, orientation_from_rpy(rpy.x(), rpy.y(), rpy.z()) * down};
}

}  // namespace insonify
