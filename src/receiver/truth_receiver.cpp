// truth_receiver.cpp -- ranks instances, compares path orders, measures shadow, and receives the direct echo.

#include "receiver/truth_receiver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/vector_math.h"

namespace insonify {
namespace {

// Sets `count` entries of the label tables, from `first` on, to the values that mean "no echo".
template <typename Count>
void write_empty(std::size_t first, Count count, Ping& ping) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  std::fill_n(&ping.strongest_instance[kStrongestCount * first], kStrongestCount * count(), kNoLabel);
  std::fill_n(&ping.strongest_share[kStrongestCount * first], kStrongestCount * count(), 0.0F);
  std::fill_n(&ping.instance[first], count(), kNoLabel);
  std::fill_n(&ping.material[first], count(), kNoLabel);
  std::fill_n(&ping.elevation[first], count(), kNone);
  std::fill_n(&ping.elevation_spread[first], count(), kNone);
}

// Writes the strongest instances of one bin: labels, shares, mean and spread of elevation.
// @param energy  The bin's total energy.
// @param at      Index of the bin in the tables of the ping.
void write_strongest(std::span<const InstanceEcho> strongest, float energy, float middle_elevation, std::size_t at,
                     Ping& ping) {
  if (strongest.empty()) {
    return;
  }
  for (std::size_t k = 0; k < strongest.size(); ++k) {
    ping.strongest_instance[kStrongestCount * at + k] = strongest[k].instance;
    ping.strongest_share[kStrongestCount * at + k] = std::min(strongest[k].energy / energy, 1.0F);
  }
  const InstanceEcho& first = strongest[0];
  ping.instance[at] = first.instance;
  ping.material[at] = first.material;
  const double mean = first.elevation_moment / double{first.energy};
  const double variance = first.elevation_square / double{first.energy} - mean * mean;
  ping.elevation[at] = middle_elevation + static_cast<float>(mean);
  ping.elevation_spread[at] = static_cast<float>(std::sqrt(std::max(variance, 0.0)));
}

// Adds the energies of one path order to the sums over all orders, and updates the strongest order of each bin.
INSONIFY_VECTOR_CLONES
void add_order(std::uint8_t order, int count, const float* __restrict__ energy, float* __restrict__ sum,
               float* __restrict__ most, std::uint8_t* __restrict__ strongest) {
  for (int i = 0; i < count; ++i) {
    sum[i] += energy[i];
    strongest[i] = energy[i] > most[i] ? order : strongest[i];
    most[i] = energy[i] > most[i] ? energy[i] : most[i];
  }
}

// sums += row.
INSONIFY_VECTOR_CLONES
void add_row(int count, const float* __restrict__ row, float* __restrict__ sums) {
  for (int i = 0; i < count; ++i) {
    sums[i] += row[i];
  }
}

}  // namespace

TruthReceiver::TruthReceiver(const SonarConfig& sonar, const BearingCells& cells, std::span<const float> cell_angles)
    : beams_(sonar.beam_count),
      bins_(sonar.bin_count),
      cells_(cells.grid.count()),
      own_(cells),
      middle_elevation_(static_cast<float>(sonar.elevation_center)),
      beam_angle_(beams_) {
  for (int beam = 0; beam < beams_; ++beam) {
    for_each_cell(beam, [&](int cell) { beam_angle_[beam] += cell_angles[cell]; });
  }
}

void TruthReceiver::write(const EchoGrid& grid, const Reception& reception, Workers& workers, Ping& ping) {
  receive_direct(grid, reception, workers, ping);
  instances_.resize(std::max(instances_.size(), static_cast<std::size_t>(workers.count())));
  workers.for_each((beams_ + kTileBeams - 1) / kTileBeams, [&](int task, int worker) {
    const int first_beam = task * kTileBeams, last_beam = std::min(first_beam + kTileBeams, beams_);
    std::array<float, kTileBeams> hidden;
    for (int beam = first_beam; beam < last_beam; ++beam) {
      hidden[beam - first_beam] = hidden_before(grid, beam);
    }
    for_each_tile(first_beam, last_beam, bins_,
                  [&](const TilePlace& place) { write_truth_tile(grid, place, hidden, instances_[worker], ping); });
  });
  for (const DiscreteEcho& echo : grid.discrete_echoes()) {
    write_discrete_echo(grid, echo, ping);
  }
}

// Computes ping.direct_intensity: path order 1 alone, through pulse, array pattern, discrete echoes and gain. Cells are
// convolved in parallel, then blocks of bins are formed into beams, then transposed into the ping.
void TruthReceiver::receive_direct(const EchoGrid& grid, const Reception& reception, Workers& workers, Ping& ping) {
  direct_.resize(static_cast<std::size_t>(cells_) * bins_);
  direct_beams_.resize(reception.bearing != nullptr ? static_cast<std::size_t>(beams_) * bins_ : 0);
  looks_.resize(std::max(looks_.size(), static_cast<std::size_t>(workers.count())));
  workers.for_each(cells_, [&](int cell, int worker) {
    const std::span<float> beam(&direct_[static_cast<std::size_t>(cell) * bins_], static_cast<std::size_t>(bins_));
    std::ranges::copy(grid.energy(1, cell), beam.begin());
    if (reception.range != nullptr) {
      std::vector<float>& look = looks_[worker];
      look.assign(beam.begin(), beam.end());
      reception.coarse->receive(look);
      const BinRange received = reception.range->reached_from(grid.filled(cell), bins_);
      const auto within = [&](auto of_row) { return of_row.subspan(received.first, received.last - received.first); };
      reception.range->receive_energy(within(std::span<const float>(look)), within(beam));
    }
  });
  BinRange received;
  for (int cell = 0; cell < cells_; ++cell) {
    const BinRange filled = grid.filled(cell);
    received = received | (reception.range != nullptr ? reception.range->reached_from(filled, bins_) : filled);
  }
  std::vector<float>& energy = reception.bearing != nullptr ? direct_beams_ : direct_;
  const int tasks = (bins_ + kTileBins - 1) / kTileBins;
  if (reception.bearing != nullptr) {
    workers.for_each(tasks, [&](int task, int) {
      const int first = task * kTileBins, last = std::min(first + kTileBins, bins_);
      reception.bearing->receive_energy(direct_, direct_beams_, bins_, {first, last}, received);
    });
  }
  reception.discrete->add_direct(grid.discrete_echoes(), energy);
  workers.for_each(tasks, [&](int task, int) {
    for (int bin = task * kTileBins; bin < std::min((task + 1) * kTileBins, bins_); ++bin) {
      for (int beam = 0; beam < beams_; ++beam) {
        ping.direct_intensity[ping.index(bin, beam)] =
            energy[static_cast<std::size_t>(beam) * bins_ + bin] * reception.gain[bin];
      }
    }
  });
}

// Computes one beam of a tile. A surface hides everything behind it in its own directions, so the solid angle whose
// first hit is nearer than a bin is in shadow there. grid.weight(1, ...) is the solid angle whose first hit lies in
// each bin.
// @param hidden  Solid angle hidden before the tile's first bin [sr]; advanced to its end.
TruthReceiver::BeamTile TruthReceiver::beam_tile(const EchoGrid& grid, int beam, const TilePlace& place,
                                                 float& hidden) const {
  BeamTile tile = {};
  bool filled = false;
  for_each_cell(beam, [&](int cell) { filled = filled || !(grid.filled(cell) & place.bins()).empty(); });
  if (!filled) {
    std::fill_n(tile.shadow, place.bin_count, std::min(hidden / beam_angle_[beam], 1.0F));
    return tile;
  }
  float most[kTileBins] = {}, hit[kTileBins] = {}, received[kTileBins] = {};
  const auto add = [&](std::span<const float> row, float* sums) {
    add_row(place.bin_count, &row[place.first_bin], sums);
  };
  for (int order = 1; order <= grid.order_count(); ++order) {
    float energy[kTileBins] = {};
    float* const sums = order == 1 ? received : energy;
    for_each_cell(beam, [&](int cell) { add(grid.energy(order, cell), sums); });
    add_order(static_cast<std::uint8_t>(order), place.bin_count, sums, tile.energy, most, tile.order);
  }
  for_each_cell(beam, [&](int cell) { add(grid.weight(1, cell), hit); });
  for (int i = 0; i < place.bin_count; ++i) {
    const bool direct = hit[i] > 0 || received[i] > 0;
    tile.shadow[i] = direct ? 0.0F : std::min(hidden / beam_angle_[beam], 1.0F);
    hidden += hit[i];
  }
  return tile;
}

// Elevations are counted from the middle of the aperture.
void TruthReceiver::add_surfaces(const EchoGrid& grid, int beam, int bin, Instances& instances) const {
  for_each_cell(beam, [&](int cell) {
    grid.for_each_surface(cell, bin, [&](SurfaceEcho echo) {
      if (echo.energy > 0) {
        echo.elevation_moment -= echo.energy * middle_elevation_;
        instances.add(echo);
      }
    });
  });
}

void TruthReceiver::write_truth_tile(const EchoGrid& grid, const TilePlace& place,
                                     std::array<float, kTileBeams>& hidden, Instances& instances, Ping& ping) const {
  BinTile<float> energy, shadow;
  std::uint8_t order[kTileBins][kTileBeams];
  for (int b = 0; b < place.beam_count; ++b) {
    const BeamTile beam = beam_tile(grid, place.first_beam + b, place, hidden[b]);
    for (int i = 0; i < place.bin_count; ++i) {
      energy[i][b] = beam.energy[i];
      order[i][b] = beam.order[i];
      shadow[i][b] = beam.shadow[i];
    }
  }
  const auto start_rows = [&](auto beams) {
    for (int i = 0; i < place.bin_count; ++i) {
      const std::size_t row = ping.index(place.first_bin + i, place.first_beam);
      std::copy_n(order[i], beams(), &ping.path_order[row]);
      std::copy_n(shadow[i], beams(), &ping.shadow[row]);
      write_empty(row, beams, ping);
    }
  };
  if (place.beam_count == kTileBeams) {  // The compiler then knows the lengths.
    start_rows(std::integral_constant<std::size_t, kTileBeams>());
  } else {
    start_rows([&] { return static_cast<std::size_t>(place.beam_count); });
  }
  for (int b = 0; b < place.beam_count; ++b) {  // Beam by beam: cells are beam-major.
    for (int i = 0; i < place.bin_count; ++i) {
      if (energy[i][b] > 0) {
        instances.clear();
        add_surfaces(grid, place.first_beam + b, place.first_bin + i, instances);
        write_strongest(instances.strongest(), energy[i][b], middle_elevation_,
                        ping.index(place.first_bin + i, place.first_beam + b), ping);
      }
    }
  }
}

// Corrects the path order and shadow of the bin of a discrete echo. A direct echo proves that its bin is in line of
// sight: its shadow becomes 0.
void TruthReceiver::write_discrete_echo(const EchoGrid& grid, const DiscreteEcho& echo, Ping& ping) const {
  const int beam = echo.order == 0 ? -1 : own_.beam_of(echo.beam);
  if (beam < 0) {
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
