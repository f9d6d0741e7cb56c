// lattice.h -- in which directions a ping is sampled, and how much of the sector each sample stands for.

#pragma once

#include <cstdint>
#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/sonar_config.h"
#include "sonar/elevation_pattern.h"

namespace insonify {

/// Columns at exact bearings, each an arc of rows from its lower edge up.
///
/// Columns run from port to starboard, `columns_per_beam` in each beam. A wedge's lies in the half-plane of its azimuth
/// a, a cone's around the array, which lies along y:
///
///     wedge:  (cos a cos t, sin a cos t, sin t)        t = elevation
///     cone:   (cos a cos t, sin a, cos a sin t)        sin(elevation) = cos a sin t
///
/// A top hat fills the elevation aperture, its rows even in tan(elevation), where the edges of triangles are straight;
/// on cones they are even in t. An elevation pattern fills its sector, its rows spread by the pattern's envelope: most
/// lie in the main lobe. The rows of neighbouring columns are staggered by fractions of a row, the same fraction in
/// columns that are mirror images of each other, so that a mirrored scene gives a mirrored ping.
struct Lattice {
  /// @param first_phase  Of the outermost columns; other phases sample the same fan elsewhere.
  /// @param pattern      Null: a top hat over the elevation aperture.
  explicit Lattice(const SonarConfig& sonar, int first_phase = 0, BeamShape shape = BeamShape::kWedge,
                   const ElevationPattern* pattern = nullptr);

  BeamShape shape;
  bool even_rows;  ///< Even in tan(elevation): tan_step and first_tan() tell where.
  int columns = 0, rows = 0, columns_per_beam = 0;

  // One a column.
  std::vector<float> azimuth;  ///< Bearing, a above [rad].
  std::vector<float> cos_azimuth, sin_azimuth;
  std::vector<float> column_width;     ///< Bearing it stands for [rad].
  std::vector<float> column_measure;   ///< The same, as solid angles grow with it: in a [rad]; on cones in sin a.
  std::vector<std::uint32_t> row_set;  ///< Which of the sets of rows it has.

  // One a row and set, at [set * rows + row].
  std::vector<float> elevation;     ///< [rad]
  std::vector<float> cos_t, sin_t;  ///< Where on its column's arc.

  /// What the sonar hears of what it sends between row - 1 and row, as a solid angle per unit of column_measure: the
  /// integral of |p|^4 over it, or all of it without a pattern. At [set * (rows + 1) + row]. The first is from the
  /// lower edge of the sector to row 0, the last from the last row to the upper edge: together they fill the sector.
  std::vector<float> interval;

  /// What the sonar sends into the part that a sample stands for, alike: the integral of |p|^2. The part is half of the
  /// intervals on both sides, and all of the first and the last. At [set * rows + row].
  std::vector<float> share;

  /// |p|^2 in the rows, one way; 1 without a pattern. At [set * rows + row].
  std::vector<float> row_pattern;

  // Where even_rows.
  float tan_step = 0;  ///< From row to row, of tan(elevation).
  [[nodiscard]] float first_tan(int column) const { return first_tans[row_set[column]]; }  ///< Of row 0.
  std::vector<float> first_tans;                                                           // One a set.

  /// Lower and upper edge of an arc.
  struct Edges {
    float cos_low, sin_low, cos_high, sin_high;
  };
  std::vector<Edges> edges;  // One a set.
  [[nodiscard]] const Edges& edges_of(int column) const { return edges[row_set[column]]; }

  [[nodiscard]] const float* elevations(int column) const { return &elevation[first_of(column, rows)]; }
  [[nodiscard]] const float* cosines(int column) const { return &cos_t[first_of(column, rows)]; }
  [[nodiscard]] const float* sines(int column) const { return &sin_t[first_of(column, rows)]; }
  [[nodiscard]] const float* shares(int column) const { return &share[first_of(column, rows)]; }
  [[nodiscard]] const float* pattern_in(int column) const { return &row_pattern[first_of(column, rows)]; }
  [[nodiscard]] const float* intervals(int column) const { return &interval[first_of(column, rows + 1)]; }

  /// Sum of the intervals of a beam's columns: the solid angle that it hears of what is sent [sr].
  [[nodiscard]] double beam_angle(int beam) const;

 private:
  // Of a column's set in a table with so many values each.
  [[nodiscard]] std::size_t first_of(int column, int each) const {
    return row_set[column] * static_cast<std::size_t>(each);
  }
};

}  // namespace insonify
