// fan_raster.h -- primary echoes without rays: triangles drawn straight into a fan's columns and rows.

#pragma once

#include <vector>

#include "echo/hit_column.h"
#include "echo/raster_scene.h"

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
  ColumnFinder finder_;
  std::vector<Placement> placements_;
  std::vector<Visible> visible_;
};

/// Draws neighbouring columns of a lattice: for every column and row the nearest triangle, exactly where a ray would
/// meet it. Rows are uniform in tan(elevation), along which the edges of a triangle are straight for any one azimuth,
/// so that nothing needs to be clipped: not behind the sonar, not around it. Edges that two triangles share are worked
/// out from the same end, so that no sample falls between them.
class FanRaster {
 public:
  /// Draws columns [first, last).
  void draw(const RasterScene& scene, const FanView& view, const PingPlan& plan, int first_column, int last_column);

  /// Takes one of these columns over into `hits`, the group that engines fill in except directions.
  /// @return Rows up to the last that met something.
  int read(int column, const HitColumn& hits) const;

 private:
  // Of one triangle: its normal at d is the sum of d's components times these, of any length.
  struct Shading {
    Vec3f edges[3];
    SurfaceLabel surface = kNoSurface;
  };
  [[nodiscard]] Shading shading_of(std::uint32_t place) const;
  void draw_cluster(const TriangleCluster& cluster, int first_column, int last_column);

  const RasterScene* scene_ = nullptr;
  const FanView* view_ = nullptr;
  const PingPlan* plan_ = nullptr;
  int first_column_ = 0, stride_ = 0;
  std::vector<float> nearness_;  // [column][row]: 1 over the distance along the column's axis, which is what is linear.
  std::vector<std::uint32_t> nearest_;  // [column][row]: block and lane.
};

}  // namespace insonify
