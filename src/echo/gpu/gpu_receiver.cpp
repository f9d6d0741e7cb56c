// gpu_receiver.cpp -- packs a receiver's numbers and tables into one buffer.

#include "echo/gpu/gpu_receiver.h"

#include <cstring>
#include <utility>

#include "base/philox.h"
#include "echo/gpu/packer.h"

namespace insonify {
namespace {

static_assert(shader::kGainBeams == GainTable::kBlockBeams && shader::kNoiseBlock == FlatReceiver::kNoiseBlock);
static_assert(shader::kNoiseInPhase == static_cast<std::uint32_t>(RandomPurpose::kNoiseInPhase) &&
              shader::kNoiseInPhase + 1 == static_cast<std::uint32_t>(RandomPurpose::kNoiseQuadrature));

shader::ReceiverTables numbers_of(const FlatReceiver& of) {
  const SpeckleShape& speckle = of.speckle;
  return {.cells = static_cast<std::uint32_t>(of.cells),
          .bins = static_cast<std::uint32_t>(of.bins),
          .beams = static_cast<std::uint32_t>(of.beams),
          .cells_per_beam = static_cast<std::uint32_t>(of.cells_per_beam),
          .first_range = of.ranges.first,
          .bin_length = of.ranges.length,
          .window_share = of.lattice.window_share,
          .layers_per_step = of.lattice.layers_per_step,
          .jump = of.lattice.jump,
          .jump_angle = of.lattice.jump_angle,
          .smoothed_bins = of.lattice.smoothed_bins,
          .first_turns = speckle.first_turns,
          .turns_per_bin = speckle.turns_per_bin,
          .turns_per_window = speckle.turns_per_window,
          .bins_per_window = speckle.bins_per_window,
          .shared_intensity = speckle.shared,
          .spread_share = speckle.spread_share,
          .turns_per_chance = speckle.spread_share > 0 ? speckle.spread_turns / speckle.spread_share : 0.0F,
          .spread_half = 0.5F * speckle.spread_turns,
          .has_pulse = of.has_pulse ? 1U : 0U,
          .look_share = of.look_share,
          .look_pairs = of.look_pairs,
          .first_tap = of.first_tap,
          .tap_count = static_cast<std::uint32_t>(of.taps.size()),
          .zone_count = static_cast<std::uint32_t>(of.zones.size()),
          .noise_rows = static_cast<std::uint32_t>(of.noise_rows),
          .noise_tap_count = static_cast<std::uint32_t>(of.noise_taps.size()),
          .seed = {of.seed[0], of.seed[1]}};
}

shader::Gains gains_of(const GainTable& table, Packer& packer) {
  return table.empty() ? shader::Gains{} : shader::Gains{packer.add(table.gains), packer.add(table.bands)};
}

void pack_tables(const FlatReceiver& of, Packer& packer, shader::ReceiverTables& tables) {
  tables.first_cells = packer.add(of.first_cells);
  tables.volume = of.volume.empty() ? 0 : packer.add(of.volume);
  tables.cell_angle = packer.add(of.cell_angle);
  tables.taps = packer.add(of.taps);
  tables.noise_taps = packer.add(of.noise_taps);
  std::vector<shader::GainsOfZone> zones;
  for (const GainZone& zone : of.zones) {
    zones.push_back({.end = static_cast<std::uint32_t>(zone.end),
                     .in_phase = gains_of(zone.in_phase, packer),
                     .quadrature = gains_of(zone.quadrature, packer)});
  }
  tables.noise_gains = gains_of(of.noise_gains, packer);
  packer.align();
  tables.zones = packer.add(zones);
}

}  // namespace

void GpuReceiver::set(gpu::Device& device, std::shared_ptr<const FlatReceiver> receiver) {
  if (receiver == receiver_) {
    return;
  }
  shader::ReceiverTables tables = numbers_of(*receiver);
  std::vector<std::byte> bytes(sizeof(tables));
  Packer sizes(0, bytes);
  pack_tables(*receiver, sizes, tables);
  std::byte* const to = buffer_.refill(device, bytes.size());
  const std::size_t size = bytes.size();
  bytes.resize(sizeof(tables));
  Packer packer(buffer_.address(), bytes);
  pack_tables(*receiver, packer, tables);
  std::memcpy(bytes.data(), &tables, sizeof(tables));
  std::memcpy(to, bytes.data(), size);
  receiver_ = std::move(receiver);
}

}  // namespace insonify
