// hit_column.h -- the hits of one lattice column, and what is computed from them for each sample.

#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "echo/grid/echo.h"
#include "echo/model/flat_plan.h"

namespace insonify {

/// Pointers to the values of one lattice column, one per row, from the lower edge of the aperture up; a HitStrip has
/// the memory. An engine fills in the first group: a sample without a hit has kNoSurface, range 0, reflectivity 0 and
/// any normal. evaluate_column() fills in the second.
struct HitColumn {
  int rows;  ///< Rows from this one on have no hit. Only this row and those below it are evaluated.

  // From the engine.
  SurfaceLabel* surface;
  std::uint32_t* triangle;                         ///< Index in the instance's mesh; arbitrary without a hit.
  float *direction_x, *direction_y, *direction_z;  ///< Directions of the rays, see aim_column().
  float* range;                                    ///< True distance [m].
  float *normal_x, *normal_y, *normal_z;           ///< Any length, in the frame of the ColumnAxes.
  float* reflectivity;                             ///< That of the material, times `texture`.
  bool has_relief;  ///< Whether gradients and textures are set. If not, `escapes` is not set either.
  float *gradient_x, *gradient_y, *gradient_z;  ///< ReliefPoint::gradient, in the frame of the normals.
  float* texture;                               ///< ReliefPoint::reflectivity; `reflectivity` includes it.

  /// Whether sound has passed surfaces on its way to these hits, or passes these: then `reached` and `passed` are set.
  /// An engine sets it to false for the first hits of its rays; evaluate_column() may set it to true.
  bool passing;
  float* reached;  ///< Share of the intensity that the surfaces in front pass, there and back, 0..1.
  float* passed;   ///< Share of it that these surfaces pass on, there and back: from evaluate_column().

  // From evaluate_column().
  float* facing;    ///< Cosine between ray and unit normal, of either sign; 0 where the relief faces away.
  float* strength;  ///< `paper`: |facing| x reflectivity x absorption there and back, 0..1.
  float* power;     ///< Energy per unit of weight. `paper`: S(strength); `calibrated`: see ScatterTable.
  float* selected;  ///< How many hits the reflected ray stands for; 0 if none is traced from here.
  float* escapes;   ///< 0 where the relief reflects the ray into the surface, so that none is traced; else 1.

  // From NormalTurns: change of the unit normal, without relief, over the footprint of the sample.
  bool curved;                                     ///< Whether it changes anywhere; if not, the turns are not set.
  float *turn_up_x, *turn_up_y, *turn_up_z;        ///< From row to row.
  float *turn_side_x, *turn_side_y, *turn_side_z;  ///< From column to column, at constant elevation.
};

/// Memory for neighbouring columns, small enough for the first-level cache.
class HitStrip {
 public:
  HitStrip(int columns, int rows) { resize(columns, rows); }
  void resize(int columns, int rows);

  [[nodiscard]] HitColumn column(int column);

  /// Distance between the same sample of two neighbouring columns, in values. Up to kPadding values beyond the last row
  /// may be written; they are never read.
  [[nodiscard]] int stride() const { return stride_; }
  static constexpr int kPadding = 16;

 private:
  int columns_ = 0, stride_ = 0;
  std::vector<SurfaceLabel> surface_;
  std::vector<std::uint32_t> triangle_;
  std::vector<float> values_;  // [field][column][row]
};

/// The range intervals over which the echoes of a column's samples are spread.
struct FootprintSegments {
  explicit FootprintSegments(int rows = 0) { resize(rows); }
  void resize(int rows);

  // Per sample. The normal is the unit normal without relief.
  std::vector<float> normal_along, normal_up;  ///< Its products with ColumnAxes::along and up.
  std::vector<float> normal_beside;            ///< Its product with ColumnAxes::beside; for cones only.
  std::vector<float> position;                 ///< Range, in bins from the near edge of bin 0.
  std::vector<float> reach;           ///< Change of the position from the middle of the column to its edge [bins].
  std::vector<std::uint32_t> turned;  ///< Scratch memory of select_hits().

  // Between each sample and the next; see FootprintSegment.
  std::vector<std::uint8_t> joined;  ///< Whether both lie on one unbroken surface. If not, the rest has no meaning.
  std::vector<float> low, high;      ///< Ends, `reach` included, limited to the bins.
  std::vector<float> power, half_rise, density, elevation;
};

/// The direction of a column's ray is along cos t + up sin t + beside, with t the elevation (on a cone, the angle along
/// its arc), in the frame that normals are given in. For the bearing a and the axes x, y and z of the sonar:
struct ColumnAxes {
  Vec3f along;   ///< x cos a + y sin a; on a cone x cos a.
  Vec3f across;  ///< Derivative of `along` with respect to a: y cos a - x sin a; on a cone y cos a.
  Vec3f up;      ///< z; on a cone z cos a.
  Vec3f beside;  ///< 0; on a cone y sin a.
};

/// @param axes  The sonar's axes as columns: forward, port and up.
ColumnAxes column_axes(const Lattice& lattice, int column, const Eigen::Matrix3f& axes);

/// Fills in the directions of a column's rays.
void aim_column(const Lattice& lattice, int column, const ColumnAxes& axes, const HitColumn& hits);

/// Makes the normals of a column's hits unit length.
void make_normals_unit(const FlatPlan& plan, const HitColumn& hits);

struct LeftOut;

/// Computes everything that follows from the hits of column `column` of the lattice: measure_column(), find_passing()
/// and weaken_behind() where the plan sees through surfaces, fill_powers(), leave_out() unless `left_out` is null, and
/// finish_column(), one after another. Normals are unit length.
void evaluate_column(const FlatPlan& plan, SecondarySampling sampling, int column, const ColumnAxes& axes,
                     const LeftOut* left_out, HitColumn& hits, FootprintSegments& segments);

/// Geometry of the column: finds which neighbours lie on one unbroken surface, and tilts the normals by the relief.
/// Fills in `facing`, `escapes` and the per-sample values of the segments, which are those of the surface without its
/// relief.
void measure_column(const FlatPlan& plan, int column, const ColumnAxes& axes, const HitColumn& hits,
                    FootprintSegments& segments);

/// Fills in `power`, and in the `paper` model `strength`: paper_strength() with PaperModel::shape(), or
/// primary_intensity().
void fill_powers(const FlatPlan& plan, const HitColumn& hits);

/// Fills in the segments between neighbours, and `selected`.
void finish_column(const FlatPlan& plan, SecondarySampling sampling, int column, const HitColumn& hits,
                   FootprintSegments& segments);

/// Rows of a column that are evaluated: those up to the last hit and one more, which ends the last segment.
[[nodiscard]] inline int evaluated_rows(const Lattice& lattice, const HitColumn& hits) {
  return std::min(hits.rows + 1, lattice.rows);
}

/// Fills in HitColumn::selected of the first `rows` hits of a column. With SecondarySampling::kSome the probability p
/// of a hit grows, within limits, with |facing| x reflectivity in the `paper` model, and with the energy that it
/// reflects in the `calibrated` one; a selected hit has the weight 1/p, so that expected sums of energy and weight are
/// those of kAll. Selection is systematic sampling: p is summed along the column, from a
/// start that depends on the column and the seed, and a hit is selected where the sum passes a whole number. So
/// selected hits are evenly spaced over a surface, and a static scene gives the same ping again.
///
/// @param turned  Scratch memory for `rows` values: the sum of p modulo 1, in units of 2^-32.
void select_hits(const FlatPlan& plan, SecondarySampling sampling, int column, int rows, const HitColumn& hits,
                 std::uint32_t* turned);

}  // namespace insonify
