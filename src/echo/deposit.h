// deposit.h -- sorts echoes into the cells of an EchoGrid: the same code for every engine.

#pragma once

#include <Eigen/Core>
#include <span>

#include "echo/echo.h"
#include "echo/ping_plan.h"
#include "insonify/echo_grid.h"

namespace insonify {

/// What the rays of one lattice column met, row by row from the lower edge up. A sample without a hit has kNoSurface.
/// All pointers hold `rows` values and belong to the caller. An engine fills in range, surface and the unit normal in
/// the column's own axes; measure_column() works out the rest.
struct HitColumn {
  int rows = 0;
  float* range = nullptr;  ///< True distance [m].
  SurfaceLabel* surface = nullptr;
  float* normal_along = nullptr;   ///< Unit normal along (cos az, sin az, 0),
  float* normal_across = nullptr;  ///< along (-sin az, cos az, 0),
  float* normal_up = nullptr;      ///< and along the sonar's z axis.
  float* facing = nullptr;         ///< Of ray and normal: the cosine of incidence, of either sign.
  float* reach = nullptr;          ///< By how much the range changes from the middle of the column to its edge [m].
  float* power = nullptr;          ///< Per unit of weight; set by shade_column().
};

/// Works out facing and reach of every sample.
void measure_column(const PingPlan& plan, int column, HitColumn& hits);

/// Deposits the primary echoes of one measured and shaded column. Neighbours on the same unbroken surface share their
/// echo over all bins between their ranges, as their footprint does. Elsewhere a sample's stretch goes on along its own
/// tangent plane: half-way to the neighbour it does not connect to, or to the edge of the aperture below the first and
/// above the last sample.
void deposit_column(const PingPlan& plan, int column, const HitColumn& hits, EchoGrid& grid);

/// Deposits one echo in the bin of half its path, in the beam it arrives in. Outside the fan or the range it is
/// dropped.
void deposit(const PingPlan& plan, const Echo& echo, EchoGrid& grid);

}  // namespace insonify
