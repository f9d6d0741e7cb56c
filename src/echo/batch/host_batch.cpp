// host_batch.cpp -- grids of a batch on the host: which views fit, echoes of sources, receivers.

#include "echo/batch/host_batch.h"

#include <algorithm>

#include "echo/model/deposit.h"

namespace insonify {
namespace {

// Views of a batch for each thread: enough for threads to finish together, few enough for their grids to stay in the
// processor's caches.
constexpr std::size_t kViewsPerWorker = 4;

// Most memory for the grids of a batch of more than one view a thread [bytes].
constexpr std::size_t kMostBytes = std::size_t{256} << 20;

std::size_t bytes_of(const PingView& view) {
  constexpr std::size_t kLabelLayers = 5;
  const std::size_t cells = static_cast<std::size_t>(view.plan->beam_count) * view.plan->bin_count;
  return cells * (2 * static_cast<std::size_t>(view.layers.orders) + kLabelLayers) * sizeof(float);
}

bool has_shape(const EchoGrid& grid, const PingView& view) {
  return grid.beam_count() == view.plan->beam_count && grid.bin_count() == view.plan->bin_count &&
         grid.order_count() == view.layers.orders && grid.ground_truth() == view.layers.ground_truth &&
         grid.labelled() == (view.layers.labelled || view.layers.ground_truth != GroundTruth::kNone);
}

}  // namespace

bool HostBatch::by_view(std::size_t views) const {
  return views > 1 && views >= static_cast<std::size_t>(workers_.count());
}

// The scene can be in one place at a time.
std::size_t HostBatch::capacity(std::span<const PingView> views) const {
  const auto threads = static_cast<std::size_t>(workers_.count());
  const std::size_t most = threads == 1 ? 1 : kViewsPerWorker * threads;
  std::size_t count = 0, bytes = 0;
  for (const PingView& view : views.first(std::min(most, views.size()))) {
    bytes += bytes_of(view);
    if (!Placement::same(view.placement, views.front().placement) || (count >= threads && bytes > kMostBytes)) {
      break;
    }
    ++count;
  }
  return std::max<std::size_t>(count, 1);
}

// Finds a grid of the right shape for each view, or makes one.
void HostBatch::take_grids() {
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const auto spare = std::find_if(grids_.begin() + static_cast<std::ptrdiff_t>(i), grids_.end(),
                                    [&](const auto& grid) { return has_shape(*grid, views_[i]); });
    if (spare == grids_.end()) {
      const PingView& view = views_[i];
      grids_.push_back(std::make_unique<EchoGrid>(view.plan->beam_count, view.plan->bin_count, view.layers.orders,
                                                  view.layers.ground_truth, view.layers.labelled));
      std::swap(grids_[i], grids_.back());
    } else {
      std::swap(grids_[i], *spare);
    }
  }
}

void HostBatch::start(std::span<const PingView> views, EchoLists lists) {
  views_ = views;
  lists_ = lists;
  take_grids();
  counts_.assign(views.size(), {});
  for (std::size_t i = 0; i < views.size(); ++i) {
    grids_[i]->discrete_echoes().clear();
  }
  insonify(views);
}

void HostBatch::add_spread(std::size_t view, Workers& workers) {
  EchoGrid& grid = *grids_[view];
  if (std::ranges::all_of(lists_of(view), [](const EchoList* list) { return list->spread.empty(); })) {
    return;
  }
  deposit_together(*views_[view].plan, workers, grid, [&](const auto& add_one) {
    for (const EchoList* list : lists_of(view)) {
      std::ranges::for_each(list->spread, add_one);
    }
  });
  grid.keep_spare_surfaces();
}

void HostBatch::receive(EchoReceiver& receiver) {
  for_each_view([&](std::size_t view, Workers& workers, int worker) {
    finish(view, workers);
    const std::optional<FormedBeams> beams = formed(view);
    if (!beams) {
      add_spread(view, workers);
    }
    EchoGrid& grid = *grids_[view];
    for (const EchoList* list : lists_of(view)) {
      grid.discrete_echoes().insert(grid.discrete_echoes().end(), list->discrete.begin(), list->discrete.end());
    }
    receiver.receive(view, grid, beams ? &*beams : nullptr, workers, worker);
  });
}

const EchoGrid& HostBatch::map(std::size_t view) {
  finish(view, workers_);
  return *grids_[view];
}

}  // namespace insonify
