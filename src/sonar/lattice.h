// lattice.h -- sampling lattice of a ping: directions of its rays (columns x rows) and the solid angle of each.

#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/sonar_config.h"
#include "sonar/elevation_pattern.h"

namespace insonify {

/// The numbers of a Lattice.
struct LatticeNumbers {
  BeamShape shape = BeamShape::kWedge;
  bool even_rows = false;  ///< Whether rows are evenly spaced in the slope: see slope_step and first_slope().
  int columns = 0, rows = 0, columns_per_beam = 0;

  // With even_rows. Slopes are tan(elevation - m).
  float cos_middle = 1, sin_middle = 0;  ///< Cosine and sine of m, the middle of the elevation aperture.
  float slope_step = 0;                  ///< Difference of slope between rows.
};

/// Ray directions in columns of constant bearing; the rows of a column lie on an arc, from its lower edge upwards.
///
/// Columns run from port to starboard, `columns_per_beam` in each beam. With wedges, a column lies in the half-plane of
/// its azimuth a; with cones, on a cone around the array, which is along y:
///
///     wedge:  (cos a cos t, sin a cos t, sin t)        t = elevation
///     cone:   (cos a cos t, sin a, cos a sin t)        sin(elevation) = cos a sin t
///
/// Without an elevation pattern (top hat), rows fill the elevation aperture: evenly spaced in the slope tan(t - m) for
/// wedges, m being the aperture's middle, because depth is linear in it, and in t for cones. With a pattern, rows fill
/// its sector with a density proportional to its envelope, so that most lie in the main lobe. The rows of neighbouring
/// columns are staggered by fractions of a row. The stagger is mirror-symmetric about the axis, so that a mirrored
/// scene gives a mirrored ping.
struct Lattice : LatticeNumbers {
  /// @param bearings          Slices that are sampled; columns_per_beam in each. There are no columns in gaps.
  /// @param sonar             Rows, elevations and transmit_width.
  /// @param first_phase       Stagger phase of the outermost columns; other values put the samples at other places.
  /// @param patterns          Across elevations.
  Lattice(const BearingGrid& bearings, int columns_per_beam, const SonarConfig& sonar,
          const ElevationPatterns& patterns, int first_phase = 0);
  Lattice() = default;

  // [column].
  std::vector<float> azimuth;  ///< Bearing, a above [rad].
  std::vector<float> cos_azimuth, sin_azimuth;
  std::vector<float> column_width;     ///< Width of the column in bearing [rad].
  std::vector<float> column_measure;   ///< Width to which solid angle is proportional: in a [rad] for wedges, in sin a
                                       ///< for cones; times transmitted.
  std::vector<float> transmitted;      ///< Intensity gain of the transmitter at the column's bearing; of a scanning
                                       ///< head that of its array one way, without effect on column_measure.
  std::vector<std::uint32_t> row_set;  ///< Index of the column's set of rows: columns of one stagger phase share a set.

  // [set][row], at [set * rows + row].
  std::vector<float> elevation;     ///< [rad]
  std::vector<float> cos_t, sin_t;  ///< Cosine and sine of t, the angle along the column's arc.

  /// Solid angle of the interval between row - 1 and row, per unit of column_measure, weighted by the patterns of
  /// transmission and of reception; unweighted without a pattern. [set][rows + 1]: the first is
  /// from the lower edge of the sector to row 0, the last from the last row to the upper edge, so that they fill the
  /// sector.
  std::vector<float> interval;

  /// Solid angle that a sample represents, per unit of column_measure, weighted by the pattern of transmission. A
  /// sample represents half of the interval on either side, and all of the first and the last one. [set][row].
  std::vector<float> share;

  /// Gain |p|^2 of the receiver in the direction of the row; 1 without a pattern. [set][row].
  std::vector<float> row_pattern;

  /// Solid angle that a sample represents weighted by the pattern of reception, re that by the pattern of transmission:
  /// 1 where the two are the same. [set][row].
  std::vector<float> reciprocal;

  [[nodiscard]] float first_slope(int column) const { return first_slopes[row_set[column]]; }  ///< Slope of row 0.
  std::vector<float> first_slopes;                                                             // [set].

  /// Lower and upper edge of an arc, as cosines and sines of t.
  struct Edges {
    float cos_low, sin_low, cos_high, sin_high;
  };
  std::vector<Edges> edges;  // [set].
  [[nodiscard]] const Edges& edges_of(int column) const { return edges[row_set[column]]; }

  [[nodiscard]] const float* elevations(int column) const { return &elevation[first_of(column, rows)]; }
  [[nodiscard]] const float* cosines(int column) const { return &cos_t[first_of(column, rows)]; }
  [[nodiscard]] const float* sines(int column) const { return &sin_t[first_of(column, rows)]; }
  [[nodiscard]] const float* shares(int column) const { return &share[first_of(column, rows)]; }
  [[nodiscard]] const float* pattern_in(int column) const { return &row_pattern[first_of(column, rows)]; }
  [[nodiscard]] const float* reciprocals(int column) const { return &reciprocal[first_of(column, rows)]; }
  [[nodiscard]] const float* intervals(int column) const { return &interval[first_of(column, rows + 1)]; }

  /// Solid angle of a beam, weighted by the elevation pattern on transmission and reception: the sum of the intervals
  /// of its columns [sr].
  [[nodiscard]] double beam_angle(int beam) const;

  /// Whether a column and the next one are side by side: there is no gap between beams.
  [[nodiscard]] bool touches_next(int column) const { return touching[column] != 0; }
  std::vector<std::uint32_t> touching;  // [column]

  /// See FlatPlan::visit_parts().
  template <typename Self, typename Numbers, typename Table>
  static void visit_parts(Self& self, const Numbers& numbers, const Table& table) {
    numbers(static_cast<std::conditional_t<std::is_const_v<Self>, const LatticeNumbers&, LatticeNumbers&>>(self));
    table("azimuth", self.azimuth);
    table("cos_azimuth", self.cos_azimuth);
    table("sin_azimuth", self.sin_azimuth);
    table("column_width", self.column_width);
    table("column_measure", self.column_measure);
    table("transmitted", self.transmitted);
    table("row_set", self.row_set);
    table("touching", self.touching);
    table("elevation", self.elevation);
    table("cos_t", self.cos_t);
    table("sin_t", self.sin_t);
    table("interval", self.interval);
    table("share", self.share);
    table("row_pattern", self.row_pattern);
    table("reciprocal", self.reciprocal);
    table("first_slopes", self.first_slopes);
    table("row_edges", self.edges);
  }

 private:
  // Index of the first value of a column's set in a table with `each` values per set.
  [[nodiscard]] std::size_t first_of(int column, int each) const {
    return row_set[column] * static_cast<std::size_t>(each);
  }
};

}  // namespace insonify
