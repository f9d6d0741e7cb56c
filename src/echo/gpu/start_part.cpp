// start_part.cpp -- records the steps of a part of a batch, and submits them.

#include <algorithm>
#include <cstring>

#include "echo/gpu/gpu_batch.h"
#include "echo/gpu/shader_values.h"
#include "echo/model/see_through.h"

namespace insonify {
namespace {

static_assert(shader::kSampleNone == static_cast<std::uint32_t>(SecondarySampling::kNone) &&
              shader::kSampleSome == static_cast<std::uint32_t>(SecondarySampling::kSome) &&
              shader::kSampleAll == static_cast<std::uint32_t>(SecondarySampling::kAll));

static_assert(shader::kMostPassed == kMostPassed);

// Groups of each step for the view that needs most.
struct GroupCounts {
  std::uint32_t tiles = 0, samples = 0, intervals = 0, blocks = 0;

  explicit GroupCounts(std::span<const PingView> views) {
    for (const PingView& view : views) {
      const auto columns = static_cast<std::uint32_t>(view.plan->lattice.columns),
                 rows = static_cast<std::uint32_t>(view.plan->lattice.rows);
      tiles = std::max(tiles, groups_for(columns, shader::kTile) * groups_for(rows, shader::kTile));
      samples = std::max(samples, groups_for(columns * rows));
      intervals = std::max(intervals, groups_for(columns * (rows + 1)));
      blocks = std::max(blocks, groups_for(columns * groups_for(rows, kSelectionRows)));
    }
  }
};

}  // namespace

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
                                .reflecting = ping.memory.reflecting(),
                                .reception = ping.reception.at()};
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
          .layer = passed,
          .smoothed = 0};
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
  for (auto& [of, receiver] : receivers_) {
    receiver.copy(part.commands);
  }
  for (const auto& ping : std::span(pings_).subspan(part.first, part.count)) {
    ping->placement.buffer.copy(part.commands);
    ping->memory.clear(part.commands);
    ping->reception.copy_inputs(part.commands);
  }
  part.jobs.copy(part.commands);
  part.layers.copy(part.commands);
}

void GpuBatch::finish_step(Part& part, std::string_view name) {
  part.commands.wait_for_writes();
  part.commands.stamp();
  part.steps.push_back(name);
}

// From the first rays to the sums of all cells.
void GpuBatch::record_echoes(Part& part) {
  const GroupCounts groups(views_.subspan(part.first, part.count));
  const auto count = static_cast<std::uint32_t>(part.count);
  gpu::Commands& commands = part.commands;
  const shader::PingJob all = job_of_layer(part, 0);
  commands.run(kernels_.trace_primaries, all, groups.tiles, count);
  finish_step(part, "trace_primaries");
  const bool calibrated = views_.front().plan->model == EchoModel::kCalibrated;
  if (calibrated) {
    commands.run(kernels_.turn_up, all, groups.samples, count);
    finish_step(part, "turn_up");
  }
  commands.run(kernels_.evaluate, all, groups.samples, count);
  finish_step(part, "evaluate");
  commands.run(kernels_.select, all, groups.blocks, count);
  finish_step(part, "select");
  commands.run(kernels_.deposit, all, groups.intervals, count);
  commands.run(kernels_.count_groups, all, 1, count);
  finish_step(part, "deposit");
  for (std::uint32_t i = 0; i < count; ++i) {
    const PingMemory& memory = pings_[part.first + i]->memory;
    shader::PingJob own = all;
    own.first = i;
    commands.run_indirect(calibrated ? kernels_.mirror : kernels_.reflect, own, memory.counted(),
                          offsetof(shader::Counters, groups));
  }
  finish_step(part, calibrated ? "mirror" : "reflect");
}

void GpuBatch::record(Part& part) {
  part.steps.clear();
  part.commands.begin();
  part.commands.stamp();
  copy_inputs(part);
  finish_step(part, "clear");
  record_echoes(part);
  if (sees_through_) {
    record_layers(part);
    finish_step(part, "behind");
  }
  record_reception(part);
  part.commands.submit();
}

void GpuBatch::start_part(Part& part) {
  fill_jobs(part);
  if (sees_through_) {
    fill_layers(part);
  }
  record(part);
}

}  // namespace insonify
