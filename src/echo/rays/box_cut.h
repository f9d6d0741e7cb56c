// box_cut.h -- about 64 boxes that enclose the scene: rays that miss them all need not be traced.

#pragma once

#include <vector>

#include "echo/rays/ray_lanes.h"
#include "insonify/scene.h"

namespace insonify {

/// Boxes that together contain every triangle of a scene: a cut through the bounding volume hierarchy that a ray tracer
/// would build, some levels below its root.
class BoxCut {
 public:
  /// @param origin  World position that the rays' coordinates are relative to.
  void set(const Scene& scene, const Vec3& origin);

  /// Moves the box of an instance whose `moving` is set.
  void move(int instance, const Pose& scene_from_mesh);

  /// Bit i is set if ray i passes through a box between its near and far end, so that it may hit something. The bits of
  /// unused lanes are arbitrary.
  [[nodiscard]] unsigned may_meet(const RayLanes& rays) const;

  /// Number of boxes.
  [[nodiscard]] std::size_t size() const { return low_[0].size(); }

 private:
  void put(std::size_t box, const Vec3f& low, const Vec3f& high);
  void resize(std::size_t boxes);

  std::vector<float> low_[3], high_[3];  // [axis][box]
  struct Moving {
    int instance;
    std::size_t box;
    Vec3f low, high;  // In the mesh's frame.
  };
  std::vector<Moving> moving_;
};

}  // namespace insonify
