// host_batch.h -- a batch whose grids are in the host's memory.

#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "echo/batch/echo_batch.h"

namespace insonify {

/// What batches of engines that compute on the host have in common: the grids, kept from batch to batch, and all that
/// comes after the samples.
class HostBatch : public EchoBatch {
 public:
  /// @param workers  Must outlive the batch.
  explicit HostBatch(Workers& workers) : workers_(workers) {}

  [[nodiscard]] std::size_t capacity(std::span<const PingView> views) const override;
  using EchoBatch::start;
  void start(std::span<const PingView> views, EchoLists lists) final;
  void receive(EchoReceiver& receiver) final;
  [[nodiscard]] const EchoGrid& map(std::size_t view) final;
  [[nodiscard]] RayCounts ray_counts(std::size_t view) const final { return counts_[view]; }

 protected:
  /// Fills the views' grids, which hold the echoes of an earlier ping; on a device begins to.
  virtual void insonify(std::span<const PingView> views) = 0;

  /// Where a device computes: waits until it has finished a view, and fills its grid. Calls for different views may run
  /// at once.
  virtual void finish([[maybe_unused]] std::size_t view, [[maybe_unused]] Workers& workers) {}

  /// What a device has received of a view that it has finished; none on the host.
  [[nodiscard]] virtual std::optional<FormedBeams> formed([[maybe_unused]] std::size_t view) const { return {}; }

  /// Whether a batch of so many views is computed by a thread a view, rather than one view after another by all
  /// threads.
  [[nodiscard]] bool by_view(std::size_t views) const;

  /// Calls run(view, workers, worker) for every view, in order: by_view() on all threads at once.
  template <typename Run>
  void for_each_view(const Run& run);

  Workers& workers_;
  std::vector<std::unique_ptr<EchoGrid>> grids_;  ///< [view]; those after the last view are spare.
  std::vector<RayCounts> counts_;                 ///< [view]
  std::span<const PingView> views_;

  /// The echoes of a view's sources.
  [[nodiscard]] std::span<const EchoList* const> lists_of(std::size_t view) const {
    return lists_.empty() ? std::span<const EchoList* const>() : lists_[view];
  }

 private:
  void take_grids();
  void add_spread(std::size_t view, Workers& workers);

  EchoLists lists_;
};

template <typename Run>
void HostBatch::for_each_view(const Run& run) {
  const std::size_t count = views_.size();
  if (by_view(count)) {
    std::atomic<std::size_t> next = 0;
    workers_.for_each(static_cast<int>(count), [&](int, int worker) { run(next++, workers_.alone(), worker); });
    return;
  }
  for (std::size_t view = 0; view < count; ++view) {
    run(view, workers_, 0);
  }
}

}  // namespace insonify
