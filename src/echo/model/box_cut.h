// box_cut.h -- a few boxes around a scene: rays that miss them all need not be sent.

#pragma once

#include <vector>

#include "echo/model/ray_lanes.h"
#include "insonify/scene.h"

namespace insonify {

/// Boxes that together hold every triangle of a scene: first around the objects, then around parts of them where that
/// leaves more water outside, a cut through the tree of boxes that a ray tracer would build.
class BoxCut {
 public:
  /// @param origin  World position that the rays' coordinates are relative to.
  void set(const Scene& scene, const Vec3& origin);

  /// Of an instance with `moving` set.
  void move(int instance, const Pose& scene_from_mesh);

  /// One bit a lane, set where the ray may meet something between its near and far end. The bits of lanes that
  /// hold no ray are arbitrary.
  [[nodiscard]] unsigned may_meet(const RayLanes& rays) const;

  /// Boxes there are.
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
