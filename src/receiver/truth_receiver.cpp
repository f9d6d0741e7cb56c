// truth_receiver.cpp -- instances ranked, orders compared, shadows measured, the direct echo heard.

#include "receiver/truth_receiver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace insonify {
namespace {

// Of the bin at `at` of the tables, whose echoes have `energy` in all.
void tell_strongest(std::span<const InstanceEcho> strongest, float energy, float middle_elevation, std::size_t at,
                    Ping& ping) {
  std::uint16_t* instance = &ping.strongest_instance[kStrongestCount * at];
  float* share = &ping.strongest_share[kStrongestCount * at];
  std::fill_n(instance, kStrongestCount, kNoLabel);
  std::fill_n(share, kStrongestCount, 0.0F);
  ping.instance[at] = ping.material[at] = kNoLabel;
  ping.elevation[at] = ping.elevation_spread[at] = std::numeric_limits<float>::quiet_NaN();
  if (strongest.empty()) {
    return;
  }
  for (std::size_t k = 0; k < strongest.size(); ++k) {
    instance[k] = strongest[k].instance;
    share[k] = std::min(strongest[k].energy / energy, 1.0F);
  }
  const InstanceEcho& first = strongest[0];
  ping.instance[at] = first.instance;
  ping.material[at] = first.material;
  const double mean = first.elevation_moment / double{first.energy};
  const double variance = first.elevation_square / double{first.energy} - mean * mean;
  ping.elevation[at] = middle_elevation + static_cast<float>(mean);
  ping.elevation_spread[at] = static_cast<float>(std::sqrt(std::max(variance, 0.0)));
}

}  // namespace

TruthReceiver::TruthReceiver(const SonarConfig& sonar, const BearingCells& cells, std::span<const float> cell_angles)
    : beams_(sonar.beam_count),
      bins_(sonar.bin_count),
      cells_(cells.sonar.beam_count),
      first_cell_(cells.first),
      cells_per_beam_(cells.per_beam),
      middle_elevation_(static_cast<float>(sonar.elevation_center)),
      whole_(beams_) {
  for (int beam = 0; beam < beams_; ++beam) {
    for_each_cell(beam, [&](int cell) { whole_[beam] += cell_angles[cell]; });
  }
}

void TruthReceiver::tell(const EchoGrid& grid, const Hearing& hearing, Workers& workers, Ping& ping) {
  hear_direct(grid, hearing, workers, ping);
  workers.for_each((beams_ + kTileBeams - 1) / kTileBeams, [&](int task, int) {
    const int first_beam = task * kTileBeams, last_beam = std::min(first_beam + kTileBeams, beams_);
    std::array<float, kTileBeams> hidden;
    for (int beam = first_beam; beam < last_beam; ++beam) {
      hidden[beam - first_beam] = hidden_before(grid, beam);
    }
    for_each_tile(first_beam, last_beam, bins_, [&](const TilePlace& place) { tell_tile(grid, place, hidden, ping); });
  });
  for (const LoneEcho& echo : grid.lone_echoes()) {
    tell_lone_echo(grid, echo, ping);
  }
}

void TruthReceiver::hear_direct(const EchoGrid& grid, const Hearing& hearing, Workers& workers, Ping& ping) {
  direct_.resize(static_cast<std::size_t>(cells_) * bins_);
  direct_beams_.resize(hearing.bearing != nullptr ? static_cast<std::size_t>(beams_) * bins_ : 0);
  workers.for_each(cells_, [&](int cell, int) {
    const std::span<float> beam(&direct_[static_cast<std::size_t>(cell) * bins_], static_cast<std::size_t>(bins_));
    std::ranges::copy(grid.energy(1, cell), beam.begin());
    if (hearing.range != nullptr) {
      const BinRange heard = hearing.range->heard_from(grid.filled(cell), bins_);
      const auto within = [&](auto of_row) { return of_row.subspan(heard.first, heard.last - heard.first); };
      hearing.range->hear_energy(within(grid.energy(1, cell)), within(beam));
    }
  });
  BinRange heard;
  for (int cell = 0; cell < cells_; ++cell) {
    const BinRange filled = grid.filled(cell);
    heard = heard | (hearing.range != nullptr ? hearing.range->heard_from(filled, bins_) : filled);
  }
  std::vector<float>& energy = hearing.bearing != nullptr ? direct_beams_ : direct_;
  const int tasks = (bins_ + kTileBins - 1) / kTileBins;
  if (hearing.bearing != nullptr) {
    workers.for_each(tasks, [&](int task, int) {
      const int first = task * kTileBins, last = std::min(first + kTileBins, bins_);
      hearing.bearing->hear_energy(direct_, direct_beams_, bins_, {first, last}, heard);
    });
  }
  hearing.lone->add_direct(grid.lone_echoes(), energy);
  workers.for_each(tasks, [&](int task, int) {
    for (int bin = task * kTileBins; bin < std::min((task + 1) * kTileBins, bins_); ++bin) {
      for (int beam = 0; beam < beams_; ++beam) {
        ping.direct_intensity[ping.index(bin, beam)] =
            energy[static_cast<std::size_t>(beam) * bins_ + bin] * hearing.gain[bin];
      }
    }
  });
}

// Each surface hides what lies behind it in its own directions: the solid angle met so far is hidden from there on.
TruthReceiver::BeamStretch TruthReceiver::stretch_of(const EchoGrid& grid, int beam, const TilePlace& place,
                                                     float& hidden) const {
  BeamStretch stretch = {};
  const auto add = [&](std::span<const float> row, float* sums) {
    for (int i = 0; i < place.bin_count; ++i) {
      sums[i] += row[place.first_bin + i];
    }
  };
  float most[kTileBins] = {}, met[kTileBins] = {}, heard[kTileBins] = {};
  for (int order = 1; order <= grid.order_count(); ++order) {
    float energy[kTileBins] = {};
    for_each_cell(beam, [&](int cell) { add(grid.energy(order, cell), energy); });
    for (int i = 0; i < place.bin_count; ++i) {
      stretch.energy[i] += energy[i];
      stretch.order[i] = energy[i] > most[i] ? static_cast<std::uint8_t>(order) : stretch.order[i];
      most[i] = std::max(most[i], energy[i]);
      heard[i] = order == 1 ? energy[i] : heard[i];
    }
  }
  for_each_cell(beam, [&](int cell) { add(grid.weight(1, cell), met); });
  for (int i = 0; i < place.bin_count; ++i) {
    const bool direct = met[i] > 0 || heard[i] > 0;
    stretch.shadow[i] = direct ? 0.0F : std::min(hidden / whole_[beam], 1.0F);
    hidden += met[i];
  }
  return stretch;
}

// A cell without a label has no tally.
void TruthReceiver::add_surfaces(const EchoGrid& grid, int beam, int bin, Instances& instances) const {
  for_each_cell(beam, [&](int cell) {
    if (grid.filled(cell).has(bin) && grid.label_rows(cell).surface[bin] != kNoSurface) {
      for (const SurfaceEcho& echo : grid.tallies(cell)[bin]) {
        if (echo.surface != kNoSurface) {
          instances.add(echo);
        }
      }
    }
  });
}

void TruthReceiver::tell_tile(const EchoGrid& grid, const TilePlace& place, std::array<float, kTileBeams>& hidden,
                              Ping& ping) const {
  BinTile<float> energy, shadow;
  std::uint8_t order[kTileBins][kTileBeams];
  for (int b = 0; b < place.beam_count; ++b) {
    const BeamStretch beam = stretch_of(grid, place.first_beam + b, place, hidden[b]);
    for (int i = 0; i < place.bin_count; ++i) {
      energy[i][b] = beam.energy[i];
      order[i][b] = beam.order[i];
      shadow[i][b] = beam.shadow[i];
    }
  }
  Instances instances;
  for (int i = 0; i < place.bin_count; ++i) {
    const std::size_t row = ping.index(place.first_bin + i, place.first_beam);
    std::copy_n(order[i], place.beam_count, &ping.path_order[row]);
    std::copy_n(shadow[i], place.beam_count, &ping.shadow[row]);
    for (int b = 0; b < place.beam_count; ++b) {
      instances.clear();
      if (i + 1 < place.bin_count && energy[i + 1][b] > 0) {  // Tallies lie far away.
        for_each_cell(place.first_beam + b,
                      [&](int cell) { __builtin_prefetch(&grid.tallies(cell)[place.first_bin + i + 1]); });
      }
      if (energy[i][b] > 0) {
        add_surfaces(grid, place.first_beam + b, place.first_bin + i, instances);
      }
      tell_strongest(instances.strongest(), energy[i][b], middle_elevation_, row + b, ping);
    }
  }
}

// Where it is direct its bin is no shadow: what hides it would have kept it from being heard.
void TruthReceiver::tell_lone_echo(const EchoGrid& grid, const LoneEcho& echo, Ping& ping) const {
  const int own = echo.beam - first_cell_;
  const int beam = own / cells_per_beam_;
  if (echo.order == 0 || own < 0 || beam >= beams_) {
    return;
  }
  float most = 0;
  for (int order = 1; order <= grid.order_count(); ++order) {
    float energy = 0;
    for_each_cell(beam, [&](int cell) { energy += grid.energy(order, cell)[echo.bin]; });
    most = std::max(most, energy);
  }
  const std::size_t at = ping.index(echo.bin, beam);
  ping.shadow[at] = echo.order == 1 ? 0 : ping.shadow[at];
  ping.path_order[at] = echo.intensity > most ? static_cast<std::uint8_t>(echo.order) : ping.path_order[at];
}

float TruthReceiver::hidden_before(const EchoGrid& grid, int beam) const {
  float hidden = 0;
  for_each_cell(beam, [&](int cell) { hidden += grid.met_before(cell); });
  return hidden;
}

}  // namespace insonify
