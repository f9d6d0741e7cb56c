// secondary_echo.h -- what comes back by way of a second surface.

#pragma once

#include "base/vector_math.h"
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

/// The secondary echo of the `paper` model: both surfaces' |cos| x reflectivity, and the absorption of pressure along
/// the whole path, shaped by S; heard in the beam it was launched in, as its reciprocal path is (DESIGN, "the return
/// leg").
/// @param strength     |cos| of incidence x reflectivity of the second surface.
/// @param path_length  Out, across and back [m].
inline Echo secondary_echo(const PingPlan& plan, const OnwardOrigin& origin, float strength, float path_length,
                           SurfaceLabel surface) {
  // The first hit's strength holds the loss of twice its range already; the rest of the path costs the rest.
  const float loss = fast_exp(-plan.neper_per_metre * (path_length - 2 * origin.range));
  return {.azimuth = plan.lattice.azimuth[origin.column],
          .elevation = plan.lattice.elevations(origin.column)[origin.row],
          .path_length = path_length,
          .power = plan.shape(origin.strength * strength * loss),
          .weight = sample_weight(plan.lattice, origin.column, origin.row) * origin.selected,
          .order = 2,
          .surface = surface};
}

}  // namespace insonify
