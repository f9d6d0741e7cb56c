// ping_memory.cpp -- lays out the memory of a ping.

#include "echo/gpu/ping_memory.h"

#include <algorithm>

#include "gpu/staged.h"

namespace insonify {
void PingMemory::reserve(gpu::Device& device, const PingView& view) {
  const FlatPlan& plan = *view.plan;
  const std::size_t samples = static_cast<std::size_t>(plan.lattice.columns) * plan.lattice.rows;
  const std::size_t cells = static_cast<std::size_t>(plan.beam_count) * plan.bin_count;
  gpu::BufferLayout work;
  const bool turns = plan.model == EchoModel::kCalibrated;
  samples_ = {.surface = work.take(samples * 4),
              .triangle = work.take(samples * 4),
              .range = work.take(samples * 4),
              .normal = work.take(samples * 12),
              .reflectivity = work.take(samples * 4),
              .facing = work.take(samples * 4),
              .power = work.take(samples * 4),
              .joined = work.take(samples * 4),
              .turn_up = work.take(turns ? samples * 12 : 0)};
  reflecting_ = work.take(samples * sizeof(shader::Reflecting));
  work_.reserve(device, work.end(), gpu::Memory::kDevice);
  for (shader::address* part :
       {&samples_.surface, &samples_.triangle, &samples_.range, &samples_.normal, &samples_.reflectivity,
        &samples_.facing, &samples_.power, &samples_.joined, &samples_.turn_up, &reflecting_}) {
    *part += work_.address();
  }

  cells_of_orders_ = cells * static_cast<std::size_t>(view.layers.orders);
  const std::size_t met_offset = 2 * cells_of_orders_ * sizeof(std::int64_t);
  counters_offset_ = met_offset + static_cast<std::size_t>(plan.beam_count) * sizeof(std::int64_t);
  first_surface_offset_ = counters_offset_ + sizeof(shader::Counters);
  sums_bytes_ = first_surface_offset_ + cells * sizeof(std::uint32_t);
  sums_.reserve(device, sums_bytes_, gpu::Memory::kDevice);
  host_sums_.reserve(device, sums_bytes_, gpu::Memory::kToHost);
  const bool labelled = view.layers.labelled || view.layers.ground_truth != GroundTruth::kNone;
  cells_ = {.energy = sums_.address(),
            .weight = sums_.address() + cells_of_orders_ * sizeof(std::int64_t),
            .first_surface = sums_.address() + first_surface_offset_,
            .surfaces = cells_.surfaces,
            .counter = sums_.address() + counters_offset_,
            .met_before = sums_.address() + met_offset,
            .most_surfaces = 0,
            .labelled = !labelled                                        ? 0U
                        : view.layers.ground_truth == GroundTruth::kFull ? 2U
                                                                         : 1U};
  reserve_surfaces(device, labelled ? static_cast<std::uint32_t>(cells) : 1);
}

void PingMemory::reserve_surfaces(gpu::Device& device, std::uint32_t surfaces) {
  surfaces_.reserve(device, surfaces * sizeof(shader::SurfaceSum), gpu::Memory::kDevice);
  if (surfaces_.address() != cells_.surfaces) {
    used_surfaces_ = surfaces;
  }
  cells_.surfaces = surfaces_.address();
  cells_.most_surfaces = static_cast<std::uint32_t>(surfaces_.bytes() / sizeof(shader::SurfaceSum));
  host_surfaces_.reserve(device, surfaces_.bytes(), gpu::Memory::kToHost);
}

void PingMemory::clear(gpu::Commands& commands) const {
  commands.fill(sums_, 0, sums_bytes_, 0);
  if (used_surfaces_ > 0) {
    commands.fill(surfaces_, 0, used_surfaces_ * sizeof(shader::SurfaceSum), 0);
  }
}

bool PingMemory::enough_room(gpu::Device& device) {
  const std::uint32_t taken = counters().surfaces;
  used_surfaces_ = std::min(taken, cells_.most_surfaces);
  if (cells_.labelled == 0 || taken <= cells_.most_surfaces) {
    return true;
  }
  reserve_surfaces(device, taken + taken / 4);
  return false;
}

void PingMemory::copy_sums(gpu::Commands& commands) {
  commands.copy(sums_, 0, host_sums_, 0, sums_bytes_);
  copied_surfaces_ = std::min(used_surfaces_ + used_surfaces_ / 4, cells_.most_surfaces);
  copy_surfaces(commands, 0, copied_surfaces_);
}

void PingMemory::copy_rest(gpu::Commands& commands) const {
  copy_surfaces(commands, copied_surfaces_, used_surfaces_);
}

void PingMemory::copy_surfaces(gpu::Commands& commands, std::uint32_t first, std::uint32_t last) const {
  if (cells_.labelled != 0 && last > first) {
    const std::size_t offset = first * sizeof(shader::SurfaceSum);
    commands.copy(surfaces_, offset, host_surfaces_, offset, last * sizeof(shader::SurfaceSum) - offset);
  }
}

const shader::Counters& PingMemory::counters() const {
  return *reinterpret_cast<const shader::Counters*>(host_sums_.data() + counters_offset_);
}

const std::uint32_t* PingMemory::first_surface() const {
  return reinterpret_cast<const std::uint32_t*>(host_sums_.data() + first_surface_offset_);
}

}  // namespace insonify
