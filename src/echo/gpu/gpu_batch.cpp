// gpu_batch.cpp -- the steps of a batch: probes, kernels, grids.

#include "echo/gpu/gpu_batch.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "echo/gpu/read_grid.h"
#include "echo/gpu/shader_values.h"
#include "echo/model/see_through.h"

namespace insonify {
namespace {

constexpr std::uint32_t kTracePrimaries[] = {
#include "shaders/trace_primaries.inc"
};
constexpr std::uint32_t kTurnUp[] = {
#include "shaders/turn_up.inc"
};
constexpr std::uint32_t kEvaluate[] = {
#include "shaders/evaluate.inc"
};
constexpr std::uint32_t kSelect[] = {
#include "shaders/select.inc"
};
constexpr std::uint32_t kDeposit[] = {
#include "shaders/deposit.inc"
};
constexpr std::uint32_t kCountGroups[] = {
#include "shaders/count_groups.inc"
};
constexpr std::uint32_t kMirror[] = {
#include "shaders/mirror.inc"
};
constexpr std::uint32_t kReflect[] = {
#include "shaders/reflect.inc"
};
constexpr std::uint32_t kGather[] = {
#include "shaders/gather.inc"
};

static_assert(shader::kSampleNone == static_cast<std::uint32_t>(SecondarySampling::kNone) &&
              shader::kSampleSome == static_cast<std::uint32_t>(SecondarySampling::kSome) &&
              shader::kSampleAll == static_cast<std::uint32_t>(SecondarySampling::kAll));

static_assert(shader::kMostPassed == kMostPassed);

// Views that are computed in one submission: enough to fill a card.
constexpr std::size_t kViewsOfPart = 16;

// Groups of each step for the view that needs most.
struct GroupCounts {
  std::uint32_t tiles = 0, samples = 0, intervals = 0, blocks = 0, cells = 0;

  explicit GroupCounts(std::span<const PingView> views) {
    for (const PingView& view : views) {
      const auto columns = static_cast<std::uint32_t>(view.plan->lattice.columns),
                 rows = static_cast<std::uint32_t>(view.plan->lattice.rows);
      tiles = std::max(tiles, groups_for(columns, shader::kTile) * groups_for(rows, shader::kTile));
      samples = std::max(samples, groups_for(columns * rows));
      intervals = std::max(intervals, groups_for(columns * (rows + 1)));
      blocks = std::max(blocks, groups_for(columns * groups_for(rows, kSelectionRows)));
      cells = std::max(cells, groups_for(static_cast<std::uint32_t>(view.plan->beam_count * view.plan->bin_count)));
    }
  }
};

}  // namespace

PingKernels::PingKernels(gpu::Device& device)
    : trace_primaries(device, "trace_primaries", kTracePrimaries),
      turn_up(device, "turn_up", kTurnUp),
      evaluate(device, "evaluate", kEvaluate),
      select(device, "select", kSelect),
      deposit(device, "deposit", kDeposit),
      count_groups(device, "count_groups", kCountGroups),
      reflect(device, "reflect", kReflect),
      mirror(device, "mirror", kMirror),
      gather(device, "gather", kGather) {}

GpuBatch::GpuBatch(GpuWorld& world, const PingKernels& kernels, Workers& workers)
    : HostBatch(workers), world_(world), kernels_(kernels) {}

// As many as fit into a part of the device's memory.
std::size_t GpuBatch::capacity(std::span<const PingView> views) const {
  constexpr std::size_t kBytesPerSample = 84, kBytesPerCell = 180, kMostViews = 64;
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
  constexpr std::size_t kMostPlans = 64;  // Where there are more, most belong to sonars that are gone.
  std::map<const FlatPlan*, GpuPlan> others = std::exchange(plans_, {});
  for (const PingView& view : views) {
    if (!plans_.contains(view.plan)) {
      plans_.insert(others.extract(view.plan));
      plans_[view.plan].set(world_.device, *view.plan);
    }
  }
  if (plans_.size() + others.size() <= kMostPlans) {
    plans_.merge(others);
  }
}

void GpuBatch::prepare(std::span<const PingView> views) {
  set_plans(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    Ping& ping = *pings_[i];
    world_.scene.place(views[i].placement, ping.placement);
    ping.memory.reserve(world_.device, views[i], world_.scene.has_relief());
  }
}

// Fills in where the kernels find what belongs to each ping.
void GpuBatch::fill_jobs(Part& part) {
  std::byte* to = part.jobs.refill(world_.device, part.count * sizeof(shader::PingAt));
  for (std::size_t i = part.first; i < part.first + part.count; ++i, to += sizeof(shader::PingAt)) {
    const Ping& ping = *pings_[i];
    const Pose& pose = views_[i].world_from_sonar;
    const Eigen::Matrix3d axes = pose.orientation.toRotationMatrix();
    const shader::PingAt job = {.plan = plans_.at(views_[i].plan).address(),
                                .scene = ping.placement.address(),
                                .reflectivity = world_.reflectivity_on_device.address(),
                                .sonar = plain(pose.position - world_.scene.origin()),
                                .forward = plain(axes.col(0)),
                                .port = plain(axes.col(1)),
                                .up = plain(axes.col(2)),
                                .sampling = static_cast<std::uint32_t>(sampling_[i]),
                                .samples = ping.memory.samples(),
                                .cells = ping.memory.cells(),
                                .layers = ping.memory.layers(),
                                .reflecting = ping.memory.reflecting()};
    std::memcpy(to, &job, sizeof(job));
  }
}

// No groups at first, since no ray is known to go on behind what it hits.
void GpuBatch::fill_layers(Part& part) {
  const GroupCounts groups(views_.subspan(part.first, part.count));
  shader::LayerGroups layer = {.wanted = {}};
  std::uint32_t* const sizes[] = {layer.tiles, layer.samples, layer.intervals};
  const std::uint32_t counts[] = {groups.tiles, groups.samples, groups.intervals};
  for (int i = 0; i < 3; ++i) {
    sizes[i][1] = static_cast<std::uint32_t>(part.count);
    sizes[i][2] = groups_for(counts[i], gpu::Commands::most_groups);
    layer.wanted[i] = std::min(counts[i], gpu::Commands::most_groups);
  }
  std::byte* const to = part.layers.refill(world_.device, kMostPassed * sizeof(layer));
  for (std::size_t i = 0; i < kMostPassed; ++i) {
    std::memcpy(to + i * sizeof(layer), &layer, sizeof(layer));
  }
}

shader::PingJob GpuBatch::job_of_layer(const Part& part, std::uint32_t passed) const {
  const std::uint64_t next =
      sees_through_ && passed < kMostPassed ? part.layers.address() + passed * sizeof(shader::LayerGroups) : 0;
  return {.pings = part.jobs.address(),
          .first = 0,
          .most_groups = gpu::Commands::most_groups,
          .next_layer = next,
          .layer = passed};
}

// What lies behind surfaces that let sound through, one surface after another: the steps of the primary echoes, which
// do nothing where no ray goes on.
void GpuBatch::record_layers(Part& part) {
  for (std::uint32_t passed = 1; passed <= kMostPassed; ++passed) {
    const shader::PingJob job = job_of_layer(part, passed);
    const auto run = [&](const gpu::Kernel& kernel, std::size_t groups) {
      part.commands.run_indirect(kernel, job, part.layers.buffer(),
                                 (passed - 1) * sizeof(shader::LayerGroups) + groups);
      part.commands.wait_for_writes();
    };
    run(kernels_.trace_primaries, offsetof(shader::LayerGroups, tiles));
    run(kernels_.turn_up, offsetof(shader::LayerGroups, samples));
    run(kernels_.evaluate, offsetof(shader::LayerGroups, samples));
    run(kernels_.deposit, offsetof(shader::LayerGroups, intervals));
  }
}

// Records copies of what the host has filled in, and that all sums are zero.
void GpuBatch::copy_inputs(Part& part) {
  for (auto& [of, plan] : plans_) {
    plan.copy(part.commands);
  }
  for (const auto& ping : std::span(pings_).subspan(part.first, part.count)) {
    ping->placement.buffer.copy(part.commands);
    ping->memory.clear(part.commands);
  }
  part.jobs.copy(part.commands);
  part.layers.copy(part.commands);
}

void GpuBatch::record(Part& part) {
  const GroupCounts groups(views_.subspan(part.first, part.count));
  const auto count = static_cast<std::uint32_t>(part.count);
  const std::span<const std::unique_ptr<Ping>> pings = std::span(pings_).subspan(part.first, part.count);
  gpu::Commands& commands = part.commands;
  const shader::PingJob all = job_of_layer(part, 0);
  const auto finish_step = [&](std::string_view name) {
    commands.wait_for_writes();
    commands.stamp();
    part.steps.push_back(name);
  };
  part.steps.clear();
  commands.begin();
  commands.stamp();
  copy_inputs(part);
  finish_step("clear");
  commands.run(kernels_.trace_primaries, all, groups.tiles, count);
  finish_step("trace_primaries");
  const bool calibrated = views_.front().plan->model == EchoModel::kCalibrated;
  if (calibrated) {
    commands.run(kernels_.turn_up, all, groups.samples, count);
    finish_step("turn_up");
  }
  commands.run(kernels_.evaluate, all, groups.samples, count);
  finish_step("evaluate");
  commands.run(kernels_.select, all, groups.blocks, count);
  finish_step("select");
  commands.run(kernels_.deposit, all, groups.intervals, count);
  commands.run(kernels_.count_groups, all, 1, count);
  finish_step("deposit");
  for (std::uint32_t i = 0; i < count; ++i) {
    const PingMemory& memory = pings[i]->memory;
    shader::PingJob own = all;
    own.first = i;
    commands.run_indirect(calibrated ? kernels_.mirror : kernels_.reflect, own, memory.counted(),
                          offsetof(shader::Counters, groups));
  }
  finish_step(calibrated ? "mirror" : "reflect");
  if (sees_through_) {
    record_layers(part);
    finish_step("behind");
  }
  commands.run(kernels_.gather, all, groups.cells, count);
  finish_step("gather");
  for (std::uint32_t i = 0; i < count; ++i) {
    pings[i]->memory.copy_layers(world_.device, commands);
  }
  finish_step("copy");
  commands.submit();
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
  if (std::ranges::none_of(pings, [](const auto& ping) { return ping->memory.has_rest(); })) {
    return;
  }
  part.commands.begin();
  for (const auto& ping : pings) {
    if (ping->memory.has_rest()) {
      ping->memory.copy_rest(world_.device, part.commands);
    }
  }
  part.commands.submit();
  part.commands.wait();
}

void GpuBatch::start_part(Part& part) {
  fill_jobs(part);
  if (sees_through_) {
    fill_layers(part);
  }
  record(part);
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
  workers.for_each((plan.beam_count + kBeams - 1) / kBeams, [&](int task, int) {
    read_beams(memory, task * kBeams, std::min((task + 1) * kBeams, plan.beam_count), *grids_[view]);
  });
  read_further_surfaces(memory, *grids_[view]);
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
