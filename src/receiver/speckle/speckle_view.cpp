// speckle_view.cpp -- the views of a ping: of the world and of moved objects.

#include "receiver/speckle/speckle_view.h"

#include <algorithm>

namespace insonify {

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
