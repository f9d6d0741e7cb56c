// lattice.h -- in which directions a ping is sampled, and how much of the sector each sample stands for.

#pragma once

#include <cstdint>
#include <vector>

#include "insonify/sonar_config.h"

namespace insonify {

/// Columns at exact azimuths by rows uniform in tan(elevation), where the edges of triangles are straight.
///
/// Columns run from port to starboard, `columns_per_beam` in each beam. Rows run from the lower edge of the elevation
/// aperture to the upper. The rows of neighbouring columns are staggered by fractions of a row, the same fraction in
/// columns that are mirror images of each other, so that a mirrored scene gives a mirrored ping.
struct Lattice {
  /// @param first_phase  Of the outermost columns; other phases sample the same fan elsewhere.
  explicit Lattice(const SonarConfig& sonar, int first_phase = 0);

  int columns = 0, rows = 0, columns_per_beam = 0;

  // One a column.
  std::vector<float> azimuth;  ///< [rad]
  std::vector<float> cos_azimuth, sin_azimuth;
  std::vector<float> column_width;   ///< Azimuth it stands for [rad].
  std::vector<std::uint16_t> phase;  ///< Which of the staggered sets of rows it has.

  // One a row and phase, at [phase * rows + row].
  std::vector<float> elevation;  ///< [rad]
  std::vector<float> cos_elevation, sin_elevation;

  /// Solid angle per radian of azimuth between row - 1 and row, at [phase * (rows + 1) + row]. The first is from the
  /// lower edge of the aperture to row 0, the last from the last row to the upper edge: together they fill the
  /// aperture.
  std::vector<float> interval;

  /// Solid angle that a sample stands for, per radian of azimuth: half of the intervals on both sides, and all of the
  /// first and the last. At [phase * rows + row].
  std::vector<float> share;

  float tan_step = 0;  ///< From row to row, of tan(elevation).
  [[nodiscard]] float first_tan(int column) const { return first_tans[phase[column]]; }  ///< Of row 0.
  std::vector<float> first_tans;                                                         // One a phase.

  // Directions of the aperture's lower and upper edge.
  float cos_low = 1, sin_low = 0, cos_high = 1, sin_high = 0;

  [[nodiscard]] const float* elevations(int column) const { return &elevation[first_of(column, rows)]; }
  [[nodiscard]] const float* cos_elevations(int column) const { return &cos_elevation[first_of(column, rows)]; }
  [[nodiscard]] const float* sin_elevations(int column) const { return &sin_elevation[first_of(column, rows)]; }
  [[nodiscard]] const float* shares(int column) const { return &share[first_of(column, rows)]; }
  [[nodiscard]] const float* intervals(int column) const { return &interval[first_of(column, rows + 1)]; }

 private:
  // Of a column's phase in a table with so many values each.
  [[nodiscard]] std::size_t first_of(int column, int each) const {
    return phase[column] * static_cast<std::size_t>(each);
  }
};

}  // namespace insonify
