// speckle_view.h -- a transducer in the frame that scatterers are fixed in: the world, or an object that has moved.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/geometry.h"
#include "receiver/displaced_instance.h"

namespace insonify {

/// A transducer's pose in a frame, with the axes in which bearings are counted there.
struct SpeckleView {
  Vec3 position = Vec3::Zero();                                    ///< [m]
  Eigen::Matrix3d frame_from_sonar = Eigen::Matrix3d::Identity();  ///< Rotation.
  /// Columns: bearing 0, bearing 90 degrees and their normal, all axes of the frame. Bearing 0 is x, or z where x is
  /// nearly normal to the plane of the fan.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  double bearing_offset = 0;  ///< Added to a bearing in the sonar frame, gives the bearing in the frame [rad].

  explicit SpeckleView(const Pose& frame_from_sonar = {});
};

/// A transducer seen from the world and from the objects that have left their places in the scene.
struct SpeckleViews {
  SpeckleView world;
  struct OfObject {
    std::uint16_t instance;  ///< Index into Scene::instances.
    SpeckleView view;
  };
  std::vector<OfObject> objects;

  /// Sets the views of one ping. Allocates only for more displaced objects than ever before.
  void set(const Pose& world_from_sonar, std::span<const DisplacedInstance> displaced);

  /// The frame of a surface's scatterers; that of kNoSurface is the world.
  [[nodiscard]] const SpeckleView& of(SurfaceLabel surface) const;
};

}  // namespace insonify
