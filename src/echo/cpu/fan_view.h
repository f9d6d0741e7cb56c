// fan_view.h -- which of a scene's triangles lie in a fan, and in which of its columns.

#pragma once

#include <vector>

#include "echo/cpu/raster_scene.h"
#include "echo/model/ping_plan.h"

namespace insonify {

/// Which columns of a lattice an interval of azimuths may touch.
class ColumnFinder {
 public:
  /// Allocates only when it needs more memory than any before.
  void prepare(const Lattice& lattice);

  /// Columns [first, last) that hold every column with low <= azimuth <= high, perhaps a few more.
  struct Columns {
    int first, last;
  };
  [[nodiscard]] Columns between(float low, float high) const;

 private:
  int columns_ = 0;
  std::vector<int> first_;  // [step]: first column whose azimuth is not above that of the step's upper edge.
  float port_ = 0;          // Azimuth of the first column [rad].
  float steps_per_radian_ = 0;
};

/// What one ping sees of a RasterScene: how its parts lie around the sonar, and which clusters are in reach.
class FanView {
 public:
  /// Allocates only when it needs more memory than any before.
  void look(const RasterScene& scene, const PingPlan& plan, const Pose& scene_from_sonar);

  struct Placement {
    Eigen::Matrix3f sonar_from_part;
    Vec3f sonar;  // In the part's coordinates: taken away before turning, so that far-off scenes lose no precision.
  };
  struct Visible {
    std::uint32_t cluster;
    int first_column, last_column;  // Of the lattice, [first, last).
  };
  [[nodiscard]] const Placement& placement(int instance) const { return placements_[instance]; }
  [[nodiscard]] const std::vector<Visible>& visible() const { return visible_; }
  [[nodiscard]] const ColumnFinder& finder() const { return finder_; }

 private:
  [[nodiscard]] ColumnFinder::Columns columns_of(const Sphere& sphere, const Placement& placement,
                                                 const PingPlan& plan) const;

  ColumnFinder finder_;
  std::vector<Placement> placements_;
  std::vector<Visible> visible_;
};

}  // namespace insonify
