// gpu_batch.cpp -- a batch from the choice of what is reflected to the grids; its parts are started in start_part.cpp.

#include "echo/gpu/gpu_batch.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "echo/gpu/read_grid.h"

namespace insonify {
namespace {

// Views that are computed in one submission: enough to fill a card.
constexpr std::size_t kViewsOfPart = 16;

// What is on the device for the sonars of a batch, by what it is made from. At its end those are dropped that others
// may need, where there are too many: then most belong to sonars that are gone.
template <typename Key, typename Value>
class Kept {
 public:
  explicit Kept(std::map<Key, Value>& values) : values_(values), others_(std::exchange(values, {})) {}
  ~Kept() {
    constexpr std::size_t kMost = 64;
    if (values_.size() + others_.size() <= kMost) {
      values_.merge(others_);
    }
  }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  // Keeps the value of a key, and sets it at the first call.
  template <typename Set>
  void keep(Key key, const Set& set) {
    if (!values_.contains(key)) {
      values_.insert(others_.extract(key));
      set(values_[key]);
    }
  }

 private:
  std::map<Key, Value>& values_;
  std::map<Key, Value> others_;
};

}  // namespace

GpuBatch::GpuBatch(GpuWorld& world, const PingKernels& kernels, Workers& workers)
    : HostBatch(workers), world_(world), kernels_(kernels) {}

// As many as fit into a part of the device's memory.
std::size_t GpuBatch::capacity(std::span<const PingView> views) const {
  constexpr std::size_t kBytesPerSample = 84, kBytesPerCell = 250, kMostViews = 64;
  const std::size_t most = world_.device.info().memory / 4;
  std::size_t count = 0, bytes = 0;
  for (const PingView& view : views.first(std::min(kMostViews, views.size()))) {
    bytes += kBytesPerSample * view.plan->lattice.columns * view.plan->lattice.rows +
             kBytesPerCell * view.plan->beam_count * view.plan->bin_count;
    if (count > 0 && bytes > most) {
      break;
    }
    ++count;
  }
  return count;
}

// The probes of all views are traced together.
void GpuBatch::choose_sampling(std::span<const PingView> views) {
  probes_.clear();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::span<const Ray> rays = pings_[i]->probes.aim(*views[i].plan, views[i].world_from_sonar);
    probes_.push_back({views[i].placement, rays, pings_[i]->probes.hits()});
  }
  world_.trace(probes_);
  sampling_.clear();
  for (std::size_t i = 0; i < views.size(); ++i) {
    sampling_.push_back(
        pings_[i]->probes.choose(*views[i].plan, world_.scene.origin(), world_.boxes_at(views[i].placement)));
  }
}

// Each plan is on the device once, however many views have it.
void GpuBatch::set_plans(std::span<const PingView> views) {
  Kept others(plans_);
  for (const PingView& view : views) {
    others.keep(view.plan, [&](GpuPlan& plan) { plan.set(world_.device, *view.plan); });
  }
}

void GpuBatch::set_receivers(std::span<const PingView> views) {
  Kept others(receivers_);
  for (const PingView& view : views) {
    if (view.reception != nullptr) {
      const std::shared_ptr<const FlatReceiver>& flat = view.reception->receiver;
      others.keep(flat.get(), [&](GpuReceiver& receiver) { receiver.set(world_.device, flat); });
    }
  }
}

void GpuBatch::prepare(std::span<const PingView> views) {
  set_plans(views);
  set_receivers(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    Ping& ping = *pings_[i];
    world_.scene.place(views[i].placement, ping.placement);
    ping.memory.reserve(world_.device, views[i], world_.scene.has_relief());
    ping.reception.clear();
    if (views[i].reception != nullptr) {
      ping.reception.set(world_.device, views[i], lists_of(i),
                         receivers_.at(views[i].reception->receiver.get()).address());
    }
  }
}

std::optional<FormedBeams> GpuBatch::formed(std::size_t view) const {
  const ReceptionMemory& reception = pings_[view]->reception;
  return reception.used() ? std::optional(reception.formed()) : std::nullopt;
}

std::vector<StepTime> GpuBatch::step_times() const {
  std::vector<StepTime> times;
  for (const auto& part : parts_) {
    for (std::size_t i = 0; i < part->step_seconds.size(); ++i) {
      if (i == times.size()) {
        times.push_back({part->steps[i], 0});
      }
      times[i].seconds += part->step_seconds[i];
    }
  }
  return times;
}

bool GpuBatch::enough_room(const Part& part) {
  bool enough = true;
  for (std::size_t i = part.first; i < part.first + part.count; ++i) {
    enough = pings_[i]->memory.enough_room(world_.device) && enough;
  }
  return enough;
}

// Copies the further surfaces that there was no room for on the host.
void GpuBatch::copy_rest(Part& part) {
  const std::span<const std::unique_ptr<Ping>> pings = std::span(pings_).subspan(part.first, part.count);
  const auto has_rest = [](const auto& ping) { return !ping->reception.used() && ping->memory.has_rest(); };
  if (std::ranges::none_of(pings, has_rest)) {
    return;
  }
  part.commands.begin();
  for (const auto& ping : pings) {
    if (has_rest(ping)) {
      ping->memory.copy_rest(world_.device, part.commands);
    }
  }
  part.commands.submit();
  part.commands.wait();
}

void GpuBatch::finish_part(Part& part) {
  part.commands.wait();
  while (!enough_room(part)) {
    start_part(part);
    part.commands.wait();
  }
  part.step_seconds = part.commands.stamped();
  copy_rest(part);
}

void GpuBatch::finish(std::size_t view, Workers& workers) {
  {
    const std::lock_guard alone(finishing_);
    Part& part = *parts_[view / kViewsOfPart];
    if (part.failure) {
      std::rethrow_exception(part.failure);
    }
    try {
      if (!part.finished) {
        finish_part(part);
      }
      part.finished = true;
    } catch (...) {
      part.failure = std::current_exception();
      throw;
    }
  }
  read(view, workers);
}

void GpuBatch::read(std::size_t view, Workers& workers) {
  constexpr int kBeams = 8;  // In a task.
  const PingMemory& memory = pings_[view]->memory;
  const FlatPlan& plan = *views_[view].plan;
  if (!pings_[view]->reception.used()) {
    workers.for_each((plan.beam_count + kBeams - 1) / kBeams, [&](int task, int) {
      read_beams(memory, task * kBeams, std::min((task + 1) * kBeams, plan.beam_count), *grids_[view]);
    });
    read_further_surfaces(memory, *grids_[view]);
  }
  const shader::Counters& counters = memory.counters();
  counts_[view] = {.primary = std::accumulate(std::begin(counters.behind), std::end(counters.behind),
                                              static_cast<std::uint64_t>(plan.lattice.columns) * plan.lattice.rows),
                   .secondary = probes_[view].rays.size() + counters.reflected,
                   .return_legs = counters.returns};
}

void GpuBatch::insonify(std::span<const PingView> views) {
  while (pings_.size() < views.size()) {
    pings_.push_back(std::make_unique<Ping>());
  }
  for (const auto& part : parts_) {
    part->commands.wait();  // Where receiving has been given up.
    part->step_seconds.clear();
  }
  sees_through_ = std::ranges::any_of(views, [](const PingView& view) { return view.plan->sees_through(); });
  choose_sampling(views);
  prepare(views);
  for (std::size_t first = 0, i = 0; first < views.size(); first += kViewsOfPart, ++i) {
    if (i == parts_.size()) {
      parts_.push_back(std::make_unique<Part>(world_.device));
    }
    Part& part = *parts_[i];
    part.first = first;
    part.count = std::min(kViewsOfPart, views.size() - first);
    part.finished = false;
    part.failure = nullptr;
    start_part(part);
  }
}

}  // namespace insonify
