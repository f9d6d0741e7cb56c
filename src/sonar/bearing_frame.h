// bearing_frame.h -- bearings in a frame such as the world, which stay where they are while a sonar turns.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

/// The axes of a frame in which the bearings of a sonar's fan are measured, and by how much these differ from those in
/// the sonar frame.
struct BearingFrame {
  /// Columns: directions of bearing 0 and 90 degrees, and their normal; all are axes of the frame. Bearing 0 is x, or z
  /// if x is nearly normal to the plane of the fan.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  double offset = 0;  ///< Bearing in the frame minus bearing in the sonar frame [rad].

  /// @param frame_from_sonar  Rotation.
  explicit BearingFrame(const Eigen::Matrix3d& frame_from_sonar);
};

}  // namespace insonify
