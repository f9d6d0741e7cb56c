// bearing_frame.cpp -- chooses the axes in which bearings are measured.

#include "sonar/bearing_frame.h"

#include <cmath>

namespace insonify {

BearingFrame::BearingFrame(const Eigen::Matrix3d& frame_from_sonar) {
  const Vec3 up = frame_from_sonar.col(2);
  const bool level_x = std::abs(up.x()) < 0.8;
  const int normal = !level_x ? 0 : std::abs(up.y()) > std::abs(up.z()) ? 1 : 2;
  axes.col(0) = level_x ? Vec3::UnitX() : Vec3::UnitZ();
  axes.col(2) = Vec3::Unit(normal) * (up[normal] < 0 ? -1 : 1);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  const Vec3 seen = frame_from_sonar.transpose() * axes.col(0);
  offset = -std::atan2(seen.y(), seen.x());
}

}  // namespace insonify
