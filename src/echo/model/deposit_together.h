// deposit_together.h -- adds many secondary echoes to the cells of an EchoGrid, on all workers.

#pragma once

#include <algorithm>

#include "base/parallel.h"
#include "echo/model/deposit.h"

namespace insonify {

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
