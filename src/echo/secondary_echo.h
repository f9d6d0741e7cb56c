// secondary_echo.h -- what comes back by way of a second surface.

#pragma once

#include "echo/echo.h"
#include "echo/hit_column.h"
#include "echo/ping_plan.h"

namespace insonify {

/// Where an onward ray left the first surface.
struct OnwardOrigin {
  int column = 0, row = 0;  ///< Of the lattice.
  float range = 0;          ///< True distance of the first hit [m].
  float strength = 0;       ///< Of the first hit, see HitColumn.
  float selected = 0;       ///< How many hits the onward ray stands for.
};

/// Solid angle that a sample of the lattice stands for: half of the intervals on both sides [sr].
inline float sample_weight(const Lattice& lattice, int column, int row) {
  const float* interval = lattice.intervals(column);
  const int rows = lattice.rows;
  const float below = row == 0 ? interval[0] : 0.5F * interval[row];
  const float above = row + 1 == rows ? interval[rows] : 0.5F * interval[row + 1];
  return (below + above) * lattice.column_width[column];
}

/// The secondary echo of the `paper` model, all but its power: heard in the beam it was launched in, as its reciprocal
/// path is (DESIGN, "the return leg").
/// @param path_length  Out, across and back [m].
inline Echo secondary_echo(const PingPlan& plan, const OnwardOrigin& origin, float path_length, SurfaceLabel surface) {
  return {.azimuth = plan.lattice.azimuth[origin.column],
          .elevation = plan.lattice.elevations(origin.column)[origin.row],
          .path_length = path_length,
          .weight = sample_weight(plan.lattice, origin.column, origin.row) * origin.selected,
          .order = 2,
          .surface = surface};
}

/// Powers of many secondary echoes: S of both surfaces' |cos| x reflectivity and of the absorption of pressure along
/// the whole path.
/// @param strength  The product of both surfaces' strengths; the first holds the loss of twice its range already.
/// @param rest      The rest of the path, that has still to be paid for [m].
void secondary_powers(const PingPlan& plan, int count, const float* strength, const float* rest, float* power);

}  // namespace insonify
