// secondary_echo.h -- what comes back by way of a second surface.

#pragma once

#include "echo/grid/echo.h"
#include "echo/model/hit_column.h"
#include "echo/model/ping_plan.h"

namespace insonify {

/// The secondary echo of the `paper` model, all but its power: heard in the beam it was launched in, as its reciprocal
/// path is (DESIGN, "the return leg"). Its weight is by what is sent that way; what is heard of it is its power's.
/// @param column, row  Of the lattice: the sample whose hit was followed.
/// @param selected     How many hits the reflected ray stands for.
/// @param path_length  Out, across and back [m].
/// @param surface      The second.
inline Echo secondary_echo(const PingPlan& plan, int column, int row, float selected, float path_length,
                           SurfaceLabel surface) {
  const Lattice& lattice = plan.lattice;
  return {.azimuth = lattice.azimuth[column],
          .elevation = lattice.elevations(column)[row],
          .path_length = path_length,
          .weight = lattice.shares(column)[row] * lattice.column_measure[column] * selected,
          .order = 2,
          .surface = surface};
}

/// Powers of many secondary echoes: S of both surfaces' |cos| x reflectivity and of the absorption of pressure along
/// the whole path.
/// @param strength  The product of both surfaces' strengths; the first holds the loss of twice its range already.
/// @param rest      The rest of the path, that has still to be paid for [m].
void secondary_powers(const PingPlan& plan, int count, const float* strength, const float* rest, float* power);

}  // namespace insonify
