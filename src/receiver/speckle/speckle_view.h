// speckle_view.h -- pose of a transducer in the frame of the scatterers: the world, or a moved object.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/geometry.h"
#include "receiver/ping_motion.h"

namespace insonify {

/// A transducer's pose in a frame, with the axes in which bearings are measured.
struct SpeckleView {
  Vec3 position = Vec3::Zero();                                    ///< [m]
  Eigen::Matrix3d frame_from_sonar = Eigen::Matrix3d::Identity();  ///< Rotation.
  /// Columns: directions of bearing 0 and 90 degrees, and their normal; all are axes of the frame. Bearing 0 is x, or z
  /// if x is nearly normal to the plane of the fan.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  double bearing_offset = 0;  ///< Bearing in the frame minus bearing in the sonar frame [rad].

  explicit SpeckleView(const Pose& frame_from_sonar = {});
};

/// Poses of a transducer relative to the world and to each displaced object.
struct SpeckleViews {
  SpeckleView world;
  struct OfObject {
    std::uint16_t instance;  ///< Index into Scene::instances.
    SpeckleView view;
  };
  std::vector<OfObject> objects;

  /// Sets the views of one ping. Allocates only if there are more displaced objects than ever before.
  void set(const Pose& world_from_sonar, std::span<const DisplacedInstance> displaced);

  /// The view in the frame of a surface's scatterers; in the world for kNoSurface.
  [[nodiscard]] const SpeckleView& of(SurfaceLabel surface) const;
};

}  // namespace insonify
