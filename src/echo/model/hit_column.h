// hit_column.h -- what the rays of one lattice column met, and what follows from it sample by sample.

#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "echo/grid/echo.h"
#include "echo/model/ping_plan.h"
#include "echo/model/secondary_sampling.h"

namespace insonify {

/// One lattice column, row by row from the lower edge of the aperture up; lies in a HitStrip. An engine fills in the
/// first group; a sample without a hit has kNoSurface, range 0, reflectivity 0 and any normal. evaluate_column() works
/// out the second.
struct HitColumn {
  int rows;  ///< Nothing is met in this row and beyond, except where it ends the lattice; the rest is not looked at.

  // From the engine.
  SurfaceLabel* surface;
  std::uint32_t* triangle;                         ///< Of its instance's mesh; anything where nothing was met.
  float *direction_x, *direction_y, *direction_z;  ///< Of the rays, see aim_column().
  float* range;                                    ///< True distance [m].
  float *normal_x, *normal_y, *normal_z;           ///< Of any length, in the frame of the ColumnAxes.
  float* reflectivity;                             ///< Of the surface's material.
  bool has_relief;  ///< The engine filled in gradients; without them evaluate_column() leaves `escapes` alone.
  float *gradient_x, *gradient_y, *gradient_z;  ///< ReliefPoint::gradient, in the frame of the normals.
  float* texture;                               ///< ReliefPoint::reflectivity, which `reflectivity` holds already.

  // Worked out.
  float* facing;    ///< Of ray and unit normal: the cosine of incidence, of either sign; 0 where relief turns it away.
  float* strength;  ///< `paper`: |facing| x reflectivity x absorption there and back, 0..1.
  float* power;     ///< What is deposited per unit of weight. `paper`: S(strength); `calibrated`: see ScatterTable.
  float* selected;  ///< How many hits the reflected ray stands for; 0 when none is sent or nothing was hit.
  float* escapes;   ///< 1, or 0 where relief mirrors the ray into the surface: nothing is sent on from there.
};

/// The memory of neighbouring columns: little enough to stay in the nearest cache.
class HitStrip {
 public:
  HitStrip(int columns, int rows) { resize(columns, rows); }
  void resize(int columns, int rows);

  [[nodiscard]] HitColumn column(int column);

  /// The same sample of the next column is so many values further. Every row may be written up to kPadding values
  /// beyond its end; what is written there is never read.
  [[nodiscard]] int stride() const { return stride_; }
  static constexpr int kPadding = 16;

 private:
  int columns_ = 0, stride_ = 0;
  std::vector<SurfaceLabel> surface_;
  std::vector<std::uint32_t> triangle_;
  std::vector<float> values_;  // [field][column][row]
};

/// How the samples of a column hang together: what lies between each and the next.
struct FootprintSegments {
  explicit FootprintSegments(int rows = 0) { resize(rows); }
  void resize(int rows);

  // Of each sample.
  std::vector<float> normal_along, normal_up;  ///< Of the unit normal, along the column's directions.
  std::vector<float> normal_beside;            ///< Of the unit normal times ColumnAxes::beside; cones only.
  std::vector<float> position;                 ///< In bins from the near edge of bin 0.
  std::vector<float> reach;           ///< By how much the position changes from the middle of the column to its edge.
  std::vector<std::uint32_t> turned;  ///< Sum of the shares that are followed, from some sample up to this one.

  // From each sample to the next, where both lie on one unbroken surface; see FootprintSegment.
  std::vector<std::uint8_t> joined;  ///< Whether they do.
  std::vector<float> low, high;      ///< Ends, reach included, within the bins.
  std::vector<float> power, half_rise, density, elevation;
};

/// A column's directions, along cos t + up sin t + beside, in the frame the normals are given in. Of a bearing a, in
/// the axes x, y and z of the sonar frame:
struct ColumnAxes {
  Vec3f along;   ///< x cos a + y sin a; on a cone x cos a.
  Vec3f across;  ///< y cos a - x sin a; on a cone y cos a.
  Vec3f up;      ///< z; on a cone z cos a.
  Vec3f beside;  ///< 0; on a cone y sin a.
};

/// @param axes  Forward, port and up, as columns.
ColumnAxes column_axes(const Lattice& lattice, int column, const Eigen::Matrix3f& axes);

/// Fills in the directions of a column's rays.
void aim_column(const Lattice& lattice, int column, const ColumnAxes& axes, const HitColumn& hits);

/// Computes everything that follows from the hits of column `column` of the lattice: measure_column(), fill_powers()
/// and finish_column(), one after another.
void evaluate_column(const PingPlan& plan, SecondarySampling sampling, int column, const ColumnAxes& axes,
                     const HitColumn& hits, FootprintSegments& segments);

/// Geometry of the column: makes normals unit length, finds which neighbours lie on one unbroken surface, and tilts the
/// normals by the relief. Fills in `facing`, `escapes` and the per-sample values of the segments, which are those of
/// the surface without its relief.
void measure_column(const PingPlan& plan, int column, const ColumnAxes& axes, const HitColumn& hits,
                    FootprintSegments& segments);

/// Fills in `power`, and in the `paper` model `strength`: paper_strength() with PaperModel::shape(), or
/// primary_intensity(), in single precision.
void fill_powers(const PingPlan& plan, const HitColumn& hits);

/// Fills in the segments between neighbours, and `selected`.
void finish_column(const PingPlan& plan, SecondarySampling sampling, int column, const HitColumn& hits,
                   FootprintSegments& segments);

/// Rows of a column that are evaluated: those up to the last hit and one more, which ends the last segment.
[[nodiscard]] inline int evaluated_rows(const Lattice& lattice, const HitColumn& hits) {
  return std::min(hits.rows + 1, lattice.rows);
}

}  // namespace insonify
