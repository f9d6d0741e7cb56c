// fan_view.h -- finds the clusters of triangles that lie in a fan, and their columns.

#pragma once

#include <vector>

#include "echo/cpu/raster_scene.h"
#include "echo/model/flat_plan.h"

namespace insonify {

/// Finds the columns of a lattice in an interval of azimuths, by a table.
class ColumnFinder {
 public:
  /// Allocates only if it needs more memory than ever before.
  void prepare(const Lattice& lattice);

  /// Columns [first, last) that contain all with low <= azimuth <= high, and perhaps a few more.
  struct Columns {
    int first, last;
  };
  [[nodiscard]] Columns between(float low, float high) const;

 private:
  int columns_ = 0;
  std::vector<int> first_;  // [step] First column whose azimuth is at most that of the step's upper edge.
  float port_ = 0;          // Azimuth of the first column [rad].
  float steps_per_radian_ = 0;
};

/// The part of a RasterScene that one ping can hit: poses of its parts relative to the sonar, and the clusters in the
/// fan.
class FanView {
 public:
  /// Allocates only if it needs more memory than ever before.
  void look(const RasterScene& scene, const FlatPlan& plan, const Pose& scene_from_sonar);

  struct Placement {
    Eigen::Matrix3f sonar_from_part;
    Vec3f sonar;  // Position in the part's frame. It is subtracted before rotating, to keep precision far from the
                  // origin.
  };
  struct Visible {
    std::uint32_t cluster;
    int first_column, last_column;  // Columns of the lattice, [first, last).
  };
  [[nodiscard]] const Placement& placement(int instance) const { return placements_[instance]; }
  [[nodiscard]] const std::vector<Visible>& visible() const { return visible_; }
  [[nodiscard]] const ColumnFinder& finder() const { return finder_; }

 private:
  [[nodiscard]] ColumnFinder::Columns columns_of(const Sphere& sphere, const Placement& placement,
                                                 const FlatPlan& plan) const;

  ColumnFinder finder_;
  std::vector<Placement> placements_;
  std::vector<Visible> visible_;
};

}  // namespace insonify
