// record_reception.cpp -- records the steps of a part of a batch from the sums of cells to what the host reads: grids,
// or the beams of pings that the device receives.

#include <algorithm>

#include "echo/gpu/gpu_batch.h"
#include "echo/gpu/shader_values.h"

namespace insonify {
namespace {

// Groups of each step for the view that needs most.
struct BeamGroups {
  std::uint32_t rows = 0, bins = 0, white = 0, noise = 0, blocks = 0, labels = 0;

  explicit BeamGroups(std::span<const PingView> views) {
    for (const PingView& view : views) {
      if (view.reception != nullptr) {
        add(*view.reception->receiver);
      }
    }
  }

  void add(const FlatReceiver& of) {
    const auto count = [](int number) { return static_cast<std::uint32_t>(number); };
    const std::uint32_t row_parts = 2 * count(of.noise_rows), row_bins = count(of.bins);
    const std::uint32_t noise_blocks =
        groups_for(row_bins + static_cast<std::uint32_t>(of.noise_taps.size()), shader::kNoiseBlock);
    rows = std::max(rows, count(of.cells));
    bins = std::max(bins, groups_for(count(of.cells) * row_bins));
    white = std::max(white, groups_for(row_parts * noise_blocks * (shader::kNoiseBlock / 4)));
    noise = std::max(noise, groups_for(row_parts * row_bins));
    blocks = std::max(blocks, groups_for(count(of.beams), shader::kGainBeams) * groups_for(row_bins));
    labels = std::max(labels, groups_for(count(of.beams) * row_bins));
  }
};

}  // namespace

// From the cells to the beams, in the pings that the device receives.
void GpuBatch::record_beams(Part& part) {
  const BeamGroups groups(views_.subspan(part.first, part.count));
  const auto run = [&](std::string_view name, const gpu::Kernel& kernel, std::uint32_t count,
                       std::uint32_t smoothed = 0) {
    shader::PingJob job = job_of_layer(part, 0);
    job.smoothed = smoothed;
    if (count > 0) {
      part.commands.run(kernel, job, count, static_cast<std::uint32_t>(part.count));
      finish_step(part, name);
    }
  };
  run("sum_cells", kernels_.sum_cells, groups.rows);
  run("smooth", kernels_.smooth, groups.bins, 0);
  run("smooth", kernels_.smooth, groups.bins, 1);
  run("draw_speckle", kernels_.draw_speckle, groups.bins);
  run("shape_pulse", kernels_.shape_pulse, groups.bins);
  run("draw_noise", kernels_.draw_noise, groups.white);
  run("filter_noise", kernels_.filter_noise, groups.noise);
  run("form_beams", kernels_.form_beams, groups.blocks);
  run("label_beams", kernels_.label_beams, groups.labels);
}

void GpuBatch::record_reception(Part& part) {
  const shader::PingJob all = job_of_layer(part, 0);
  const auto count = static_cast<std::uint32_t>(part.count);
  const std::span<const std::unique_ptr<Ping>> pings = std::span(pings_).subspan(part.first, part.count);
  std::uint32_t cells = 0, echoes = 0;
  for (std::size_t i = part.first; i < part.first + part.count; ++i) {
    const FlatPlan& plan = *views_[i].plan;
    cells = std::max(cells, groups_for(static_cast<std::uint32_t>(plan.beam_count * plan.bin_count)));
    echoes = std::max(echoes, groups_for(pings_[i]->reception.at().echo_count));
  }
  if (echoes > 0) {
    part.commands.run(kernels_.add_echoes, all, echoes, count);
    finish_step(part, "add_echoes");
  }
  part.commands.run(kernels_.gather, all, cells, count);
  finish_step(part, "gather");
  record_beams(part);
  for (const auto& ping : pings) {
    if (ping->reception.used()) {
      ping->memory.copy_counters(part.commands);
      ping->reception.copy_beams(part.commands);
    } else {
      ping->memory.copy_layers(world_.device, part.commands);
    }
  }
  finish_step(part, "copy");
}

}  // namespace insonify
