// deposit.h -- adds echoes to the cells of an EchoGrid; all engines use it.

#pragma once

#include "echo/grid/echo.h"
#include "echo/grid/echo_grid.h"
#include "echo/grid/surface_run.h"
#include "echo/model/flat_plan.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// Adds the primary echoes of one evaluated column. The echo of two neighbours on one unbroken surface is spread over
/// all bins between their ranges. Where the surface ends between two samples, the segment of each continues along its
/// own tangent plane half-way to the other; that of the first and the last sample continues to the edge of the
/// aperture.
/// @param sums  Scratch memory, prepared for the grid's bins.
void deposit_column(const FlatPlan& plan, int column, const HitColumn& hits, const FootprintSegments& segments,
                    SurfaceSums& sums, EchoGrid& grid);

/// Adds one secondary echo, spread about half of its path length, to the beam it arrives in. Echoes outside the fan or
/// the range window are dropped.
void deposit(const FlatPlan& plan, const Echo& echo, EchoGrid& grid);

}  // namespace insonify
