// batch_runner.h -- computes batches of pings: the echoes of all sources, then the samples of the fans, then receivers.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "echo/batch/source_set.h"
#include "echo/engine.h"

namespace insonify {

/// Traces the rays of all sources of all pings of a batch together, round by round. Threads belong to whoever runs
/// batches: engine and receivers use the same ones.
class BatchRunner {
 public:
  /// Both arguments must outlive this.
  BatchRunner(Engine& engine, Workers& workers) : engine_(engine), workers_(workers), batch_(engine.make_batch()) {}

  /// Number of views, from the first on, that one batch can hold.
  [[nodiscard]] std::size_t capacity(std::span<const PingView> views) const { return batch_->capacity(views); }

  /// Computes one batch.
  /// @param views     At most capacity(views).
  /// @param sources   [view] Its sources; none for the paper model.
  /// @param receiver  Receives each view.
  void run(std::span<const PingView> views, std::span<SourceSet* const> sources, EchoReceiver& receiver);

  /// Rays that the samples of one view of the last batch took.
  [[nodiscard]] RayCounts ray_counts(std::size_t view) const { return batch_->ray_counts(view); }

  [[nodiscard]] std::vector<StepTime> step_times() const { return batch_->step_times(); }

 private:
  void ask();
  bool trace();
  void trace_behind();
  void answer();
  void list_echoes();
  template <typename Run>
  void for_each_view(const Run& run);

  Engine& engine_;
  Workers& workers_;
  std::unique_ptr<EchoBatch> batch_;
  std::span<const PingView> views_;
  std::span<SourceSet* const> sources_;  // [view]
  std::vector<RayRun> runs_;
  std::vector<AskingSource*> continuing_;  // [run]
  std::vector<const EchoList*> lists_;
  std::vector<std::span<const EchoList* const>> lists_of_views_;
};

}  // namespace insonify
