// gpu_batch.cpp -- the steps of a batch: probes, kernels, grids.

#include "echo/gpu/gpu_batch.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "echo/gpu/read_grid.h"
#include "echo/gpu/shader_values.h"
#include "insonify/error.h"

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
    : HostBatch(workers), world_(world), kernels_(kernels), commands_(world.device) {}

// As many as fit into a part of the device's memory.
std::size_t GpuBatch::capacity(std::span<const PingView> views) const {
  constexpr std::size_t kBytesPerSample = 64, kBytesPerCell = 180, kMostViews = 64;
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
    sampling_.push_back(pings_[i]->probes.choose(*views[i].plan, world_.scene.origin(), world_.boxes));
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
    ping.memory.reserve(world_.device, views[i]);
  }
}

// Fills in where the kernels find what belongs to each ping.
void GpuBatch::fill_jobs(std::span<const PingView> views) {
  std::byte* to = jobs_.refill(world_.device, views.size() * sizeof(shader::PingAt));
  for (std::size_t i = 0; i < views.size(); ++i, to += sizeof(shader::PingAt)) {
    const Ping& ping = *pings_[i];
    const Pose& pose = views[i].world_from_sonar;
    const Eigen::Matrix3d axes = pose.orientation.toRotationMatrix();
    const shader::PingAt job = {.plan = plans_.at(views[i].plan).address(),
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

void GpuBatch::record(std::span<const PingView> views) {
  const GroupCounts groups(views);
  const auto count = static_cast<std::uint32_t>(views.size());
  const shader::PingJob all = {jobs_.address(), 0, gpu::Commands::most_groups};
  const auto finish_step = [&](std::string_view name) {
    commands_.wait_for_writes();
    commands_.stamp();
    steps_.push_back(name);
  };
  steps_.clear();
  commands_.begin();
  commands_.stamp();
  for (auto& [of, plan] : plans_) {
    plan.copy(commands_);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    pings_[i]->placement.buffer.copy(commands_);
    pings_[i]->memory.clear(commands_);
  }
  jobs_.copy(commands_);
  finish_step("clear");
  commands_.run(kernels_.trace_primaries, all, groups.tiles, count);
  finish_step("trace_primaries");
  const bool calibrated = views.front().plan->model == EchoModel::kCalibrated;
  if (calibrated) {
    commands_.run(kernels_.turn_up, all, groups.samples, count);
    finish_step("turn_up");
  }
  commands_.run(kernels_.evaluate, all, groups.samples, count);
  finish_step("evaluate");
  commands_.run(kernels_.select, all, groups.blocks, count);
  finish_step("select");
  commands_.run(kernels_.deposit, all, groups.intervals, count);
  commands_.run(kernels_.count_groups, all, 1, count);
  finish_step("deposit");
  for (std::uint32_t i = 0; i < count; ++i) {
    const PingMemory& memory = pings_[i]->memory;
    commands_.run_indirect(calibrated ? kernels_.mirror : kernels_.reflect,
                           shader::PingJob{jobs_.address(), i, gpu::Commands::most_groups}, memory.counted(),
                           offsetof(shader::Counters, groups));
  }
  finish_step(calibrated ? "mirror" : "reflect");
  commands_.run(kernels_.gather, all, groups.cells, count);
  finish_step("gather");
  for (std::uint32_t i = 0; i < count; ++i) {
    pings_[i]->memory.copy_layers(world_.device, commands_);
  }
  finish_step("copy");
  commands_.submit();
  commands_.wait();
  step_seconds_ = commands_.stamped();
}

std::vector<StepTime> GpuBatch::step_times() const {
  std::vector<StepTime> times;
  for (std::size_t i = 0; i < step_seconds_.size(); ++i) {
    times.push_back({steps_[i], step_seconds_[i]});
  }
  return times;
}

bool GpuBatch::enough_room() {
  bool enough = true;
  for (std::size_t i = 0; i < sampling_.size(); ++i) {
    enough = pings_[i]->memory.enough_room(world_.device) && enough;
  }
  return enough;
}

void GpuBatch::read(std::span<const PingView> views) {
  const std::span<const std::unique_ptr<Ping>> pings = std::span(pings_).first(views.size());
  if (std::ranges::any_of(pings, [](const auto& ping) { return ping->memory.has_rest(); })) {
    commands_.begin();
    for (const auto& ping : pings) {
      ping->memory.copy_rest(world_.device, commands_);
    }
    commands_.submit();
    commands_.wait();
  }
  constexpr int kBeams = 8;  // In a task.
  for_each_view([&](std::size_t view, Workers& workers, int) {
    const PingMemory& memory = pings_[view]->memory;
    const FlatPlan& plan = *views[view].plan;
    workers.for_each((plan.beam_count + kBeams - 1) / kBeams, [&](int task, int) {
      read_beams(memory, task * kBeams, std::min((task + 1) * kBeams, plan.beam_count), *grids_[view]);
    });
    read_further_surfaces(memory, *grids_[view]);
    counts_[view] = {.primary = static_cast<std::uint64_t>(plan.lattice.columns) * plan.lattice.rows,
                     .secondary = probes_[view].rays.size() + memory.counters().reflected,
                     .return_legs = memory.counters().returns};
  });
}

// Refuses what the kernels do not compute yet.
void GpuBatch::refuse(const FlatPlan& plan) const {
  if (world_.reliefs.any()) {
    throw Error("engine gpu computes no relief of materials yet; engine cpu does");
  }
  if (plan.sees_through()) {
    throw Error("engine gpu computes no materials that let sound through yet (open_share, thickness); engine cpu does");
  }
}

void GpuBatch::insonify(std::span<const PingView> views) {
  for (const PingView& view : views) {
    refuse(*view.plan);
  }
  while (pings_.size() < views.size()) {
    pings_.push_back(std::make_unique<Ping>());
  }
  choose_sampling(views);
  prepare(views);
  do {
    fill_jobs(views);
    record(views);
  } while (!enough_room());
  read(views);
}

}  // namespace insonify
