// reception_memory.cpp -- lays out what a ping's receiver works on.

#include "echo/gpu/reception_memory.h"

#include <cstddef>
#include <cstring>

#include "echo/gpu/shader_values.h"

namespace insonify {
namespace {

static_assert(sizeof(shader::BearingLattice) == sizeof(LatticeAxes) &&
              offsetof(shader::BearingLattice, key) == offsetof(LatticeAxes, key) &&
              offsetof(shader::BearingLattice, across_turns) == offsetof(LatticeAxes, across_turns) &&
              offsetof(shader::BearingLattice, ahead_level) == offsetof(LatticeAxes, projection) &&
              offsetof(shader::BearingLattice, ahead_whole) == offsetof(LatticeAxes, ahead_from) &&
              offsetof(shader::BearingLattice, up_whole) == offsetof(LatticeAxes, up_from));
static_assert(sizeof(shader::SpreadEcho) == sizeof(Echo) &&
              offsetof(shader::SpreadEcho, order) == offsetof(Echo, order) &&
              offsetof(shader::SpreadEcho, surface) == offsetof(Echo, surface));

std::size_t spread_echoes(std::span<const EchoList* const> lists) {
  std::size_t count = 0;
  for (const EchoList* list : lists) {
    count += list->spread.size();
  }
  return count;
}

template <typename Values>
std::byte* copied(const Values& values, std::byte* to) {
  const std::size_t bytes = values.size() * sizeof(*values.data());
  std::memcpy(to, values.data(), bytes);
  return to + bytes;
}

}  // namespace

// Axes come first, which hold doubles.
void ReceptionMemory::fill_inputs(gpu::Device& device, const PingView& view, std::span<const EchoList* const> lists) {
  const Reception& of = *view.reception;
  const std::size_t echoes = spread_echoes(lists);
  const std::size_t axes = of.axes.size() * sizeof(LatticeAxes), instances = of.instances.size() * 4,
                    deviation = of.noise_deviation.size() * 4;
  std::byte* to = inputs_.refill(device, axes + instances + deviation + echoes * sizeof(Echo));
  to = copied(of.axes, to);
  to = copied(of.instances, to);
  to = copied(of.noise_deviation, to);
  for (const EchoList* list : lists) {
    to = copied(list->spread, to);
  }
  at_.axes = inputs_.address();
  at_.instances = at_.axes + axes;
  at_.deviation = at_.instances + instances;
  at_.echoes = at_.deviation + deviation;
  at_.echo_count = static_cast<std::uint32_t>(echoes);
  at_.frames = static_cast<std::uint32_t>(1 + of.instances.size());
  at_.number[0] = static_cast<std::uint32_t>(view.number);
  at_.number[1] = static_cast<std::uint32_t>(view.number >> 32);
}

void ReceptionMemory::reserve_work(gpu::Device& device, const FlatReceiver& receiver) {
  const std::size_t layer = static_cast<std::size_t>(receiver.cells) * receiver.bins * 4, fields = 2 * layer;
  const std::size_t shared = receiver.speckle.shared > 0 ? fields : 0;
  const std::size_t noise = static_cast<std::size_t>(receiver.noise_rows) * 2 * 4;  // Bytes a bin.
  const std::size_t white = receiver.bins + receiver.noise_taps.size() + shader::kNoiseBlock;
  gpu::BufferLayout work;
  at_.energy = work.take(layer);
  at_.elevation = work.take(layer);
  at_.smoothed = work.take(layer);
  at_.segment = work.take(layer);
  at_.field = work.take(fields);
  at_.before = work.take(shared);
  at_.after = work.take(shared);
  at_.pulsed = work.take(fields);
  at_.white = work.take(noise * white);
  at_.noise = work.take(noise * receiver.bins);
  work_.reserve(device, work.end(), gpu::Memory::kDevice);
  for (shader::address* part : {&at_.energy, &at_.elevation, &at_.smoothed, &at_.segment, &at_.field, &at_.before,
                                &at_.after, &at_.pulsed, &at_.white, &at_.noise}) {
    *part += work_.address();
  }
  at_.before = shared > 0 ? at_.before : 0;
  at_.after = shared > 0 ? at_.after : 0;
}

void ReceptionMemory::reserve_beams(gpu::Device& device, const FlatReceiver& receiver) {
  beam_bins_ = static_cast<std::size_t>(receiver.beams) * receiver.bins;
  beam_bytes_ = beam_bins_ * 16;
  beams_.reserve(device, beam_bytes_, gpu::Memory::kDevice);
  host_.reserve(device, beam_bytes_, gpu::Memory::kToHost);
  at_.beams = beams_.address();
  at_.surface = at_.beams + beam_bins_ * 8;
  at_.label_elevation = at_.surface + beam_bins_ * 4;
}

void ReceptionMemory::set(gpu::Device& device, const PingView& view, std::span<const EchoList* const> lists,
                          std::uint64_t tables) {
  at_.tables = tables;
  fill_inputs(device, view, lists);
  reserve_work(device, *view.reception->receiver);
  reserve_beams(device, *view.reception->receiver);
}

void ReceptionMemory::copy_beams(gpu::Commands& commands) const {
  commands.copy(beams_, 0, host_, 0, beam_bytes_);
}

FormedBeams ReceptionMemory::formed() const {
  const auto* const field = host_.data<const std::complex<float>>();
  const auto* const surface = reinterpret_cast<const SurfaceLabel*>(field + beam_bins_);
  const auto* const elevation = reinterpret_cast<const float*>(surface + beam_bins_);
  return {{field, beam_bins_}, {surface, beam_bins_}, {elevation, beam_bins_}};
}

}  // namespace insonify
