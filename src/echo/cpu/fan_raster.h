// fan_raster.h -- rasterises triangles into the columns and rows of a fan, instead of tracing primary rays.

#pragma once

#include <array>
#include <vector>

#include "base/parallel.h"
#include "echo/cpu/fan_view.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// Finds the nearest triangle for every column and row of neighbouring columns of a lattice, at exactly the point where
/// a ray would hit it. Rows are equally spaced in slope (see Lattice), in which a triangle's depth is linear; its edges
/// are linear in tan(elevation) at any azimuth, so that triangles need no clipping, even behind or around the sonar. An
/// edge that two triangles share is computed from the same end for both, so that no sample falls between them.
class FanRaster {
 public:
  static constexpr int kTogether = 16;  ///< Columns, or rows, processed together.

  /// @param workers  Asked, between clusters of triangles, whether to stop.
  explicit FanRaster(const Workers& workers) : workers_(workers) {}

  /// Draws columns [first, last).
  /// @throws Interrupted
  void draw(const RasterScene& scene, const FanView& view, const FlatPlan& plan, int first_column, int last_column);

  /// Fills in the engine's group of `hits` for one of these columns, except directions.
  /// @return Number of rows up to the last hit.
  int read(int column, const HitColumn& hits);

 private:
  static constexpr std::size_t kShadings = 256;
  static constexpr std::uint32_t kNothing = 0xffffffff;

  // A triangle's label, and its interpolated normal as a linear function of the direction d: d.x edges[0] + d.y
  // edges[1] + d.z edges[2], of any length, on the side given by the winding.
  struct Shading {
    std::uint32_t triangle = kNothing;  // As in nearest_.
    std::uint32_t in_mesh = 0;
    SurfaceLabel surface = kNoSurface;
    float reflectivity = 0;
    std::array<Vec3f, 3> edges = {Vec3f::Zero(), Vec3f::Zero(), Vec3f::Zero()};
  };

  // The columns that are drawn, padded to a multiple of kTogether.
  struct Columns {
    int count = 0;
    std::vector<float> cos_azimuth, sin_azimuth, first_slope;
    void set(const Lattice& lattice, int first, int last);
  };

  void clear(float max_range);
  void draw_cluster(const TriangleCluster& cluster, int first_column, int last_column);
  [[nodiscard]] Shading shading_of(std::uint32_t triangle) const;
  const Shading& known_shading(std::uint32_t triangle);

  const Workers& workers_;
  const RasterScene* scene_ = nullptr;
  const FanView* view_ = nullptr;
  const FlatPlan* plan_ = nullptr;
  int first_column_ = 0, stride_ = 0;
  Columns columns_;
  std::vector<float> nearness_;         // [column][row] 1 / distance along the middle elevation: linear in slope.
  std::vector<std::uint32_t> nearest_;  // [column][row] Nearest triangle: block x kBlockSize + lane, or kNothing.
  std::vector<Shading> shadings_;       // Cache of triangles read recently, at index triangle modulo kShadings.
  Shading no_shading_;
};

}  // namespace insonify
