// deposit.h -- sorts echoes into the cells of an EchoGrid: the same code for every engine.

#pragma once

#include <Eigen/Core>
#include <span>

#include "echo/echo.h"
#include "echo/ping_plan.h"
#include "insonify/echo_grid.h"

namespace insonify {

/// What the rays of one lattice column met, row by row from the lower edge up. A sample without a hit has kNoSurface.
/// All pointers hold `rows` values and belong to the caller.
struct HitColumn {
  int rows = 0;
  float* range = nullptr;       ///< True distance [m].
  float* normal_along = nullptr;  ///< Unit normal dotted with the column's horizontal direction (cos az, sin az, 0).
  float* normal_up = nullptr;     ///< Unit normal dotted with the sonar's z axis.
  float* power = nullptr;       ///< Per unit of weight; set by shade_column().
  SurfaceLabel* surface = nullptr;
};

/// Cosine of the angle between ray and normal, without sign.
inline float incidence(const Lattice& lattice, int column, const HitColumn& hits, int row) {
  return std::abs(hits.normal_along[row] * lattice.cos_elevations(column)[row] +
                  hits.normal_up[row] * lattice.sin_elevations(column)[row]);
}

/// Deposits the primary echoes of one column. Neighbours on the same unbroken surface share their echo over all bins
/// between their ranges, as their footprint does; elsewhere each half of a sample's own stretch goes to the bin it is in.
/// The stretches below the first and above the last sample end where the surface meets the edge of the aperture.
void deposit_column(const PingPlan& plan, int column, const HitColumn& hits, EchoGrid& grid);

/// Deposits one echo in the bin of half its path, in the beam it arrives in. Outside the fan or the range it is dropped.
void deposit(const PingPlan& plan, const Echo& echo, EchoGrid& grid);

}  // namespace insonify
