// deposit.h -- adds echoes to the cells of an EchoGrid; all engines use it.

#pragma once

#include <algorithm>

#include "base/parallel.h"
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

/// deposit() of many echoes. Each task adds those of its own beams, in order, so that the sums do not depend on the
/// number of workers.
/// @param for_each_echo  Calls its argument with each echo, in order; called by several threads.
template <typename ForEachEcho>
void deposit_together(const FlatPlan& plan, Workers& workers, EchoGrid& grid, const ForEachEcho& for_each_echo) {
  constexpr int kTasksAWorker = 4;
  const int beams = plan.beam_count;
  const int tasks = workers.count() == 1 ? 1 : std::min(beams, kTasksAWorker * workers.count());
  workers.for_each(tasks, [&](int task, int) {
    const int last = beams * (task + 1) / tasks - 1;
    const float high = plan.port_edges[beams * task / tasks], low = plan.starboard_edges[last];
    for_each_echo([&](const Echo& echo) {
      if (echo.azimuth <= high && echo.azimuth > low) {
        deposit(plan, echo, grid);
      }
    });
  });
}

}  // namespace insonify
