// speckle_view.cpp -- chooses the axes in which bearings are measured.

#include "receiver/speckle/speckle_view.h"

#include <algorithm>
#include <cmath>

namespace insonify {

SpeckleView::SpeckleView(const Pose& frame_from_sonar_pose)
    : position(frame_from_sonar_pose.position), frame_from_sonar(frame_from_sonar_pose.orientation.toRotationMatrix()) {
  const Vec3 up = frame_from_sonar.col(2);
  const bool level_x = std::abs(up.x()) < 0.8;
  const int normal = !level_x ? 0 : std::abs(up.y()) > std::abs(up.z()) ? 1 : 2;
  axes.col(0) = level_x ? Vec3::UnitX() : Vec3::UnitZ();
  axes.col(2) = Vec3::Unit(normal) * (up[normal] < 0 ? -1 : 1);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  const Vec3 seen = frame_from_sonar.transpose() * axes.col(0);
  bearing_offset = -std::atan2(seen.y(), seen.x());
}

void SpeckleViews::set(const Pose& world_from_sonar, std::span<const DisplacedInstance> displaced) {
  world = SpeckleView(world_from_sonar);
  objects.clear();
  for (const DisplacedInstance& one : displaced) {
    objects.push_back({one.instance, SpeckleView(one.home_from_here * world_from_sonar)});
  }
}

const SpeckleView& SpeckleViews::of(SurfaceLabel surface) const {
  const auto object =
      surface == kNoSurface ? objects.end() : std::ranges::find(objects, instance_of(surface), &OfObject::instance);
  return object == objects.end() ? world : object->view;
}

}  // namespace insonify
