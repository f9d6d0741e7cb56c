// deposit.h -- sorts echoes into the cells of an EchoGrid: the same code for every engine.

#pragma once

#include "echo/grid/echo.h"
#include "echo/grid/echo_grid.h"
#include "echo/grid/surface_run.h"
#include "echo/model/hit_column.h"
#include "echo/model/ping_plan.h"

namespace insonify {

/// Deposits the primary echoes of one evaluated column. Neighbours on the same unbroken surface share their
/// echo over all bins between their ranges, as their footprint does. Elsewhere a sample's segment goes on along its own
/// tangent plane: half-way to the neighbour it does not connect to, or to the edge of the aperture below the first and
/// above the last sample.
/// @param sums  Scratch, prepared for the grid's bins.
void deposit_column(const PingPlan& plan, int column, const HitColumn& hits, const FootprintSegments& segments,
                    SurfaceSums& sums, EchoGrid& grid);

/// Deposits one echo about half its path, in the beam it arrives in. Outside the fan or the range it is dropped.
void deposit(const PingPlan& plan, const Echo& echo, EchoGrid& grid);

}  // namespace insonify
