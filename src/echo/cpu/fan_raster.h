// fan_raster.h -- primary echoes without rays: triangles drawn straight into a fan's columns and rows.

#pragma once

#include <array>
#include <vector>

#include "echo/cpu/fan_view.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// Draws neighbouring columns of a lattice: for every column and row the nearest triangle, exactly where a ray would
/// meet it. Rows are uniform in tan(elevation), along which the edges of a triangle are straight for any one azimuth,
/// so that nothing needs to be clipped: not behind the sonar, not around it. Edges that two triangles share are worked
/// out from the same end, so that no sample falls between them.
class FanRaster {
 public:
  static constexpr int kTogether = 16;  ///< Columns, and rows, worked on side by side.

  /// Draws columns [first, last).
  void draw(const RasterScene& scene, const FanView& view, const PingPlan& plan, int first_column, int last_column);

  /// Takes one of these columns over into `hits`, the group that engines fill in except directions.
  /// @return Rows up to the last that met something.
  int read(int column, const HitColumn& hits);

 private:
  static constexpr std::size_t kShadings = 256;
  static constexpr std::uint32_t kNothing = 0xffffffff;

  // Of one triangle: its normal at d, on the side that it winds to, is the sum of d's components times these, of any
  // length.
  struct Shading {
    std::uint32_t triangle = kNothing;  // As in nearest_.
    std::uint32_t in_mesh = 0;
    SurfaceLabel surface = kNoSurface;
    float reflectivity = 0;
    std::array<Vec3f, 3> edges = {Vec3f::Zero(), Vec3f::Zero(), Vec3f::Zero()};
  };

  // The columns that are drawn, filled up to a multiple of kTogether.
  struct Columns {
    int count = 0;
    std::vector<float> cos_azimuth, sin_azimuth, first_tan;
    void set(const Lattice& lattice, int first, int last);
  };

  void clear(float max_range);
  void draw_cluster(const TriangleCluster& cluster, int first_column, int last_column);
  [[nodiscard]] Shading shading_of(std::uint32_t triangle) const;
  const Shading& known_shading(std::uint32_t triangle);

  const RasterScene* scene_ = nullptr;
  const FanView* view_ = nullptr;
  const PingPlan* plan_ = nullptr;
  int first_column_ = 0, stride_ = 0;
  Columns columns_;
  std::vector<float> nearness_;  // [column][row]: 1 over the distance along the column's axis, which is what is linear.
  std::vector<std::uint32_t> nearest_;  // [column][row]: block and lane.
  std::vector<Shading> shadings_;       // Of triangles read last, each at the place that its number ends with.
  Shading no_shading_;
};

}  // namespace insonify
