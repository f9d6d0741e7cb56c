// speckle_view.h -- pose of a transducer in the frame of the scatterers: the world, or a moved object.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/geometry.h"
#include "receiver/ping_motion.h"
#include "sonar/bearing_frame.h"

namespace insonify {

/// A transducer's pose in a frame, with the axes in which bearings are measured.
struct SpeckleView {
  Vec3 position = Vec3::Zero();      ///< [m]
  Eigen::Matrix3d frame_from_sonar;  ///< Rotation.
  BearingFrame bearings;

  explicit SpeckleView(const Pose& frame_from_sonar_pose = {})
      : position(frame_from_sonar_pose.position),
        frame_from_sonar(frame_from_sonar_pose.orientation.toRotationMatrix()),
        bearings(frame_from_sonar) {}
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
