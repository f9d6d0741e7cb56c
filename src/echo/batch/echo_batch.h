// echo_batch.h -- interface of a batch of pings on an engine: their echo grids, from the first echo to the receiver.

#pragma once

#include <cstddef>
#include <span>

#include "base/parallel.h"
#include "echo/batch/ping_view.h"
#include "echo/batch/reception.h"
#include "echo/grid/echo.h"
#include "echo/grid/echo_grid.h"
#include "insonify/engine.h"

namespace insonify {

/// Turns the echoes of each ping of a batch into the ping, on the host.
class EchoReceiver {
 public:
  virtual ~EchoReceiver() = default;

  /// Called once for each view; calls for different views may run at once, on different workers.
  /// @param formed   What the engine has made of PingView::reception; null: nothing, all echoes are in the grid. Else
  ///                 only discrete echoes are.
  /// @param workers  Threads for the steps of this view.
  /// @param worker   Number of the calling thread, which chooses its scratch memory.
  virtual void receive(std::size_t view, const EchoGrid& grid, const FormedBeams* formed, Workers& workers,
                       int worker) = 0;
};

/// [view][source]
using EchoLists = std::span<const std::span<const EchoList* const>>;

/// The echoes of a batch of pings. They stay where the engine computes them; only map() copies a grid to the host,
/// where it is not there already. An object is used by one thread at a time, and reused from batch to batch.
class EchoBatch {
 public:
  virtual ~EchoBatch() = default;

  /// Number of views, from the first on, that one batch can hold: at least 1.
  [[nodiscard]] virtual std::size_t capacity(std::span<const PingView> views) const = 0;

  /// Empties the batch and computes the echoes of the samples of each view's fan, or begins to. Results depend on the
  /// views alone, not on what else is in the batch, nor on threads.
  /// @param views  At most capacity(views). They and the lists must stay valid until the next start().
  /// @param lists  [view][source] Echoes that receive() adds, in this order; empty: none.
  virtual void start(std::span<const PingView> views, EchoLists lists) = 0;
  void start(std::span<const PingView> views) { start(views, {}); }

  /// Passes each view's echoes to the receiver: the first views while a device still computes the last.
  virtual void receive(EchoReceiver& receiver) = 0;

  /// The grid of one view without a Reception, without echoes of sources, to be read on the host until the next call.
  [[nodiscard]] virtual const EchoGrid& map(std::size_t view) = 0;

  /// Rays that were traced for one view, when it has been received.
  [[nodiscard]] virtual RayCounts ray_counts(std::size_t view) const = 0;

  /// Time of each step on a device, when all has been received; none on the host.
  [[nodiscard]] virtual std::vector<StepTime> step_times() const { return {}; }
};

}  // namespace insonify
