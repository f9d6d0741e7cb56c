// secondary_echo.h -- secondary echoes: bearing and range in the EchoGrid, and powers in the paper model.

#pragma once

#include "echo/grid/echo.h"
#include "echo/model/flat_plan.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// A secondary echo without its power, at the bearing of the launched ray, from which the reciprocal path arrives.
/// @param column, row  Sample of the lattice whose hit reflected the ray.
/// @param selected     Number of hits that the reflected ray stands for.
/// @param path_length  Length out, across and back [m].
/// @param surface      The second surface.
inline Echo secondary_echo(const FlatPlan& plan, int column, int row, float selected, float path_length,
                           SurfaceLabel surface) {
  const Lattice& lattice = plan.lattice;
  return {.azimuth = lattice.azimuth[column],
          .elevation = lattice.elevations(column)[row],
          .path_length = path_length,
          .weight = lattice.shares(column)[row] * lattice.column_measure[column] * selected,
          .order = 2,
          .surface = surface};
}

/// The two echoes of a path that is not the same both ways.
struct ReciprocalEchoes {
  Echo launched;  ///< Arrives from where the ray was launched.
  Echo arriving;  ///< Arrives from the end of the path.
};

/// @param column, row  Sample of the lattice that the path was launched to.
/// @param echo     secondary_echo() of the path, with its lengths.
/// @param power    Without patterns.
/// @param arrival  From the end of the path.
inline ReciprocalEchoes reciprocal_echoes(const FlatPlan& plan, int column, int row, const Echo& echo, float power,
                                          const FlatPlan::Arrival& arrival) {
  ReciprocalEchoes echoes{echo, echo};
  echoes.launched.power = plan.reciprocal_power(column, row, power, arrival);
  echoes.arriving.power = plan.arriving_power(column, power, arrival);
  echoes.arriving.azimuth = arrival.bearing;
  echoes.arriving.elevation = arrival.elevation;
  return echoes;
}

/// S of the strengths of many secondary echoes; each strength loses the absorption of the rest of
/// its path first, see paper_strength().
/// @param strength  Product of the strengths of both surfaces; the first includes the loss of twice its range.
/// @param rest      Length of the path less twice the range of the first surface [m].
void secondary_powers(const FlatPlan& plan, int count, const float* strength, const float* rest, float* power);

}  // namespace insonify
