// box_cut.h -- about 64 boxes that enclose the scene: rays that miss them all need not be traced.

#pragma once

#include <vector>

#include "insonify/scene.h"

namespace insonify {

/// Number of rays that are processed together.
inline constexpr int kRayLanes = 16;

/// Pointers to the components of sixteen rays: kRayLanes values each, which belong to the caller.
struct RayLanes {
  const float *origin_x, *origin_y, *origin_z;           ///< [m]
  const float *direction_x, *direction_y, *direction_z;  ///< Unit length.
  const float *near, *far;                               ///< Ends of the ray, as distances from its origin [m].
};

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

  /// Corners of axis-parallel boxes.
  struct Boxes {
    std::vector<float> low[3], high[3];  ///< [axis][box]

    [[nodiscard]] std::size_t size() const { return low[0].size(); }
    void resize(std::size_t count);
  };

 private:
  void put(std::size_t box, const Vec3f& low, const Vec3f& high);
  void add_group(std::size_t first, std::size_t last);

  Boxes boxes_;   // Those of static objects, group by group, then those of moving ones.
  Boxes groups_;  // The box around each group: rays that miss it are not tested against the group's boxes.
  std::vector<std::size_t> group_end_;  // Index of the first box after each group.
  struct Moving {
    int instance;
    std::size_t box;
    Vec3f low, high;  // In the mesh's frame.
  };
  std::vector<Moving> moving_;
};

}  // namespace insonify
