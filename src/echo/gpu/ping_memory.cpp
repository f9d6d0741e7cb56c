// ping_memory.cpp -- lays out the memory of a ping.

#include "echo/gpu/ping_memory.h"

#include <algorithm>

#include "gpu/staged.h"

namespace insonify {
namespace {

// A share of cells, but few, have more than one surface.
constexpr std::size_t kCellsPerFurther = 16;

bool is_labelled(const PingView& view) {
  return view.layers.labelled || view.layers.ground_truth != GroundTruth::kNone;
}

}  // namespace

void PingMemory::reserve_work(gpu::Device& device, const FlatPlan& plan, bool relief) {
  const std::size_t samples = static_cast<std::size_t>(plan.lattice.columns) * plan.lattice.rows;
  const bool turns = plan.model == EchoModel::kCalibrated, passes = plan.sees_through();
  gpu::BufferLayout work;
  samples_ = {.surface = work.take(samples * 4),
              .triangle = work.take(samples * 4),
              .range = work.take(samples * 4),
              .normal = work.take(samples * 12),
              .gradient = work.take(relief ? samples * 12 : 0),
              .reflectivity = work.take(samples * 4),
              .facing = work.take(samples * 4),
              .power = work.take(samples * 4),
              .joined = work.take(samples * 4),
              .turn_up = work.take(turns ? samples * 12 : 0),
              .reached = work.take(passes ? samples * 4 : 0),
              .passed = work.take(passes ? samples * 4 : 0)};
  reflecting_ = work.take(samples * sizeof(shader::Reflecting));
  work_.reserve(device, work.end(), gpu::Memory::kDevice);
  for (shader::address* part :
       {&samples_.surface, &samples_.triangle, &samples_.range, &samples_.normal, &samples_.reflectivity,
        &samples_.gradient, &samples_.facing, &samples_.power, &samples_.joined, &samples_.turn_up, &samples_.reached,
        &samples_.passed, &reflecting_}) {
    *part += work_.address();
  }
  samples_.gradient = relief ? samples_.gradient : 0;
  samples_.reached = passes ? samples_.reached : 0;
  samples_.passed = passes ? samples_.passed : 0;
}

void PingMemory::reserve_sums(gpu::Device& device, std::size_t beams) {
  const std::size_t all_orders = cell_count_ * layers_.orders * sizeof(std::int64_t);
  gpu::BufferLayout sums;
  cells_.energy = sums.take(all_orders);
  cells_.weight = sums.take(all_orders);
  cells_.met_before = sums.take(beams * sizeof(std::int64_t));
  cells_.first_surface = sums.take(cells_.labelled != 0 ? cell_count_ * sizeof(std::uint32_t) : 0);
  sums_bytes_ = sums.end();
  sums_.reserve(device, sums_bytes_, gpu::Memory::kDevice);
  for (shader::address* part : {&cells_.energy, &cells_.weight, &cells_.met_before, &cells_.first_surface}) {
    *part += sums_.address();
  }
}

void PingMemory::reserve_layers(gpu::Device& device, std::size_t beams) {
  const std::size_t layer = cell_count_ * 4, labels = cells_.labelled != 0 ? layer : 0;
  gpu::BufferLayout parts;
  cells_.counter = parts.take(sizeof(shader::Counters));
  layers_.used = parts.take(beams * 8);
  zeroed_bytes_ = parts.end();
  layers_.met_before = parts.take(beams * 4);
  layers_.energy = parts.take(layer * layers_.orders);
  layers_.weight = parts.take(layer * layers_.orders);
  layers_.surface = parts.take(labels);
  layers_.surface_energy = parts.take(labels);
  layers_.moment = parts.take(labels);
  layers_.square = parts.take(cells_.labelled > 1 ? layer : 0);
  layer_bytes_ = parts.end();
  to_host_.reserve(device, layer_bytes_, gpu::Memory::kDevice);
  host_.reserve(device, layer_bytes_, gpu::Memory::kToHost);
  for (shader::address* part : {&cells_.counter, &layers_.used, &layers_.met_before, &layers_.energy, &layers_.weight,
                                &layers_.surface, &layers_.surface_energy, &layers_.moment, &layers_.square}) {
    *part += to_host_.address();
  }
}

void PingMemory::reserve(gpu::Device& device, const PingView& view, bool relief) {
  const FlatPlan& plan = *view.plan;
  const auto beams = static_cast<std::size_t>(plan.beam_count);
  cell_count_ = beams * plan.bin_count;
  layers_.orders = static_cast<std::uint32_t>(view.layers.orders);
  cells_.labelled = !is_labelled(view) ? 0U : view.layers.ground_truth == GroundTruth::kFull ? 2U : 1U;
  reserve_work(device, plan, relief);
  reserve_sums(device, beams);
  reserve_layers(device, beams);
  reserve_surfaces(device, cells_.labelled != 0 ? static_cast<std::uint32_t>(cell_count_) : 1);
}

void PingMemory::reserve_surfaces(gpu::Device& device, std::uint32_t surfaces) {
  const std::size_t before = surfaces_.bytes();
  surfaces_.reserve(device, surfaces * sizeof(shader::SurfaceSum), gpu::Memory::kDevice);
  cells_.surfaces = surfaces_.address();
  cells_.most_surfaces = static_cast<std::uint32_t>(surfaces_.bytes() / sizeof(shader::SurfaceSum));
  if (surfaces_.bytes() != before) {
    used_surfaces_ = cells_.most_surfaces;  // New memory, larger than was asked for, holds anything.
  }
  further_.reserve(device, cells_.most_surfaces * sizeof(shader::FurtherSum), gpu::Memory::kDevice);
  layers_.further = further_.address();
}

void PingMemory::clear(gpu::Commands& commands) const {
  commands.fill(sums_, 0, sums_bytes_, 0);
  commands.fill(to_host_, 0, zeroed_bytes_, 0);
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

void PingMemory::copy_counters(gpu::Commands& commands) const {
  commands.copy(to_host_, 0, host_, 0, sizeof(shader::Counters));
}

void PingMemory::copy_layers(gpu::Device& device, gpu::Commands& commands) {
  commands.copy(to_host_, 0, host_, 0, layer_bytes_);
  if (cells_.labelled != 0) {
    const auto some = static_cast<std::uint32_t>(cell_count_ / kCellsPerFurther);
    copy_further(device, commands,
                 std::clamp(copied_further_, std::min(some, cells_.most_surfaces), cells_.most_surfaces));
  }
}

void PingMemory::copy_rest(gpu::Device& device, gpu::Commands& commands) {
  copy_further(device, commands, std::min(counters().further + counters().further / 4, cells_.most_surfaces));
}

void PingMemory::copy_further(gpu::Device& device, gpu::Commands& commands, std::uint32_t count) {
  copied_further_ = count;
  if (count == 0) {
    return;
  }
  host_further_.reserve(device, count * sizeof(shader::FurtherSum), gpu::Memory::kToHost);
  commands.copy(further_, 0, host_further_, 0, count * sizeof(shader::FurtherSum));
}

}  // namespace insonify
