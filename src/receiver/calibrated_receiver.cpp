// calibrated_receiver.cpp -- the receiver chain of a ping: sum, speckle, pulse, array pattern, noise, leak.

#include "receiver/calibrated_receiver.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/vector_math.h"

namespace insonify {
namespace {

// Bins of a task that forms beams; kLeastBins also where gains are looked up: near bins, each with its own, take the
// longest.
constexpr int kLeastBins = 16, kMostBins = 64;

// energy += volume x unblocked
INSONIFY_VECTOR_CLONES
void add_volume(int count, const float* __restrict__ volume, float unblocked, float* __restrict__ energy) {
  for (int i = 0; i < count; ++i) {
    energy[i] += volume[i] * unblocked;
  }
}

// Sets the bins of `row` outside `bins` to 0.
template <typename Value>
void clear_outside(BinRange bins, std::span<Value> row) {
  const BinRange kept = bins.empty() ? BinRange{} : bins;
  std::fill(row.begin(), row.begin() + kept.first, Value{});
  std::fill(row.begin() + kept.last, row.end(), Value{});
}

// The bins of a row that are in an interval.
template <typename Row>
auto within(BinRange bins, Row&& row) {
  return std::span(row).subspan(bins.first, bins.last - bins.first);
}

}  // namespace

BinRange CalibratedReceiver::filled_bins(const EchoGrid& grid, int cell) const {
  return volume_.empty() ? grid.filled(cell) : BinRange{0, bins_};
}

BinRange CalibratedReceiver::received_bins(const EchoGrid& grid, int cell) const {
  const BinRange filled = filled_bins(grid, cell);
  return range_ ? range_->reached_from(filled, bins_) : filled;
}

// Sums a cell's echo energies over path orders into `energy`, [bin], and adds volume reverberation. A bin's water is
// insonified only in the part of the cell's solid angle in which no surface was hit nearer: grid.weight() is the solid
// angle whose first hit lies in each bin, grid.met_before() that whose first hit is nearer than bin 0.
void CalibratedReceiver::sum_energy(const EchoGrid& grid, int cell, std::span<float> energy) const {
  const BinRange bins = grid.filled(cell);
  clear_outside(bins, energy);
  if (!bins.empty()) {
    const auto within = [&](int order) { return grid.energy(order, cell).subspan(bins.first, bins.last - bins.first); };
    std::ranges::copy(within(1), energy.begin() + bins.first);
    for (int order = 2; order <= grid.order_count(); ++order) {
      std::ranges::transform(within(order), energy.subspan(bins.first), energy.begin() + bins.first, std::plus());
    }
  }
  if (!volume_.empty()) {
    const BinRange hits = bins.empty() ? BinRange{} : bins;  // Nothing is hit outside.
    const std::span<const float> hit = grid.weight(1, cell);
    float unblocked = std::max(0.0F, cell_angle_[cell] - grid.met_before(cell));
    add_volume(hits.first, volume_.data(), unblocked, energy.data());
    for (int i = hits.first; i < hits.last; ++i) {
      energy[i] += volume_[i] * std::max(0.0F, unblocked - 0.5F * hit[i]);  // Hits are half-way through, on average.
      unblocked -= hit[i];
    }
    add_volume(bins_ - hits.last, volume_.data() + hits.last, std::max(0.0F, unblocked), energy.data() + hits.last);
  }
}

// Computes one cell's row of bins up to and including the convolution with the pulse, into the layers of of_cells_.
// Bins that neither echoes nor the pulse reach are zero.
void CalibratedReceiver::receive_cell(const EchoGrid& grid, int cell, Row& row) {
  row.energy.resize(static_cast<std::size_t>(bins_));
  sum_energy(grid, cell, row.energy);
  if (!of_cells_.extended.empty()) {
    receive_mean(grid, cell, row);
  } else if (coarse_) {
    coarse_->receive(row.energy);
  }
  of_cells_.field.empty() ? receive_energy(grid, cell, row) : receive_field(grid, cell, row);
}

// The energies themselves, spread by the pulse.
void CalibratedReceiver::receive_energy(const EchoGrid& grid, int cell, Row& row) {
  const auto bins = static_cast<std::size_t>(bins_);
  const std::span<float> beam(&of_cells_.energy[bins * cell], bins);
  std::ranges::copy(row.energy, beam.begin());
  if (range_) {
    range_->receive_energy(within(received_bins(grid, cell), row.energy), within(received_bins(grid, cell), beam));
  }
}

// Speckle of the energies' mean intensities, then the pulse.
void CalibratedReceiver::receive_field(const EchoGrid& grid, int cell, Row& row) {
  const auto bins = static_cast<std::size_t>(bins_);
  const BinRange filled = filled_bins(grid, cell), received = received_bins(grid, cell);
  const std::span<std::complex<float>> beam(&of_cells_.field[bins * cell], bins);
  clear_outside(received, beam);
  if (filled.empty()) {
    return;
  }
  lattice_->locate(views_, cell, filled, grid, row.scatterers);
  if (clutter_->any()) {
    clutter_->texture(row.scatterers, cell, row.energy);
  }
  row.field.resize(range_ ? bins : 0);
  const std::span<std::complex<float>> drawn = range_ ? std::span(row.field) : beam;
  clear_outside(filled, drawn);
  speckle_->draw(row.scatterers, row.energy, drawn);
  if (sparse_->any()) {
    sparse_->draw(row.scatterers, grid, cell, row.energy, *speckle_, drawn);
  }
  speckle_->share(row.scatterers, drawn);
  if (range_) {
    range_->receive_field(within(received, row.field), within(received, beam));
  }
}

// Replaces a row's energy by that of one look, and computes the mean intensity after the pulse.
void CalibratedReceiver::receive_mean(const EchoGrid& grid, int cell, Row& row) {
  const auto bins = static_cast<std::size_t>(bins_);
  const BinRange received = received_bins(grid, cell);
  row.extended.resize(bins);
  coarse_->receive(row.energy, row.extended);
  const auto receive_row = [&](std::span<const float> energy, std::vector<float>& cells) {
    const std::span<float> beam(&cells[bins * cell], bins);
    clear_outside(received, beam);
    const std::size_t count = received.empty() ? 0 : received.last - received.first;
    range_->receive_energy(energy.subspan(received.first, count), beam.subspan(received.first, count));
  };
  receive_row(row.energy, of_cells_.energy);
  receive_row(row.extended, of_cells_.extended);
}

// Forms the beams from the cells. Tasks divide the ping by blocks of bins.
void CalibratedReceiver::form_beams(const EchoGrid& grid, Workers& workers) {
  BinRange received;
  for (int cell = 0; cell < cells_; ++cell) {
    received = received | received_bins(grid, cell);
  }
  const int per_task = bearing_->keeps_all() ? workers.part_length(bins_, kLeastBins, kMostBins) : kLeastBins;
  workers.for_each((bins_ + per_task - 1) / per_task, [&](int task, int) {
    const BinRange bins{task * per_task, std::min((task + 1) * per_task, bins_)};
    if (!of_cells_.field.empty()) {
      bearing_->receive_field(of_cells_.field, of_beams_.field, bins_, bins, received);
    }
    if (!of_cells_.energy.empty()) {
      bearing_->receive_energy(of_cells_.energy, of_beams_.energy, bins_, bins, received);
    }
    if (!of_cells_.extended.empty()) {
      bearing_->receive_energy(of_cells_.extended, of_beams_.extended, bins_, bins, received);
    }
    if (phase_) {
      phase_->form(of_cells_.field, of_cells_.energy, bins);
    }
  });
}

DiscreteEchoes CalibratedReceiver::discrete() const {
  return {bearing_.get(), range_ ? &*range_ : nullptr, beams_, bins_, coarse_ ? coarse_->discrete() : 1.0F};
}

void CalibratedReceiver::add_discrete_echoes(const EchoGrid& grid) {
  Signals& beams = beam_signals();
  if (!beams.field.empty()) {
    discrete().add(grid.discrete_echoes(), beams.field);
  }
  if (!beams.energy.empty()) {
    discrete().add(grid.discrete_echoes(), beams.energy);
  }
  if (phase_) {
    phase_->add(discrete(), grid.discrete_echoes());
  }
}

// Adds to each beam the share of all beams' echoes that its channel lets in.
void CalibratedReceiver::couple_channels(Workers& workers) {
  Signals& beams = beam_signals();
  if (!beams.field.empty()) {
    channels_->couple_field(beams.field, workers);
  }
  if (!beams.energy.empty()) {
    channels_->couple_energy(beams.energy, workers);
  }
  if (!beams.extended.empty()) {
    channels_->couple_energy(beams.extended, workers);
  }
}

// Adds the transmit leak to echoes, and clears echoes and noise at ranges below dead_range.
void CalibratedReceiver::receive_leak() {
  Signals& beams = beam_signals();
  if (!beams.field.empty()) {
    leak_->receive_field(beams.field);
  }
  if (!beams.energy.empty()) {
    leak_->receive_energy(beams.energy);
  }
  if (!beams.extended.empty()) {
    leak_->clear_dead(beams.extended);
  }
  if (noise_) {
    noise_->silence(leak_->dead_bins());
  }
}

// Draws the ping's noise, and sets each beam's level of it.
void CalibratedReceiver::draw_noise(const Ping& ping, const Pose& world_from_sonar,
                                    std::span<const std::optional<Vec3>> thrusters, Workers& workers) {
  noise_->draw(ping.number, workers);
  if (phase_) {
    phase_->draw_noise(ping.number, workers);
  }
  if (surface_noise_) {
    set_noise_levels(world_from_sonar, noise_deviation_);
  }
  if (thrusters_) {
    thrusters_->add_to(*noise_, thrusters, ping.number, ping.time, noise_deviation_, workers);
  }
}

// Fills moved_ with the cells and discrete echoes of `grid` as the moving sonar receives them. EchoGrid::met_before()
// of each cell is not shifted.
void CalibratedReceiver::move(const EchoGrid& grid, const PingMotion& motion, Workers& workers) {
  if (moved_.beam_count() == 0) {
    moved_ = grid;
  }
  shift_->prepare(motion, workers);
  workers.for_each(cells_, [&](int cell, int) { moved_.take_cells(grid, cell, shift_->sources(cell)); });
  moved_.discrete_echoes().clear();
  for (const DiscreteEcho& echo : grid.discrete_echoes()) {
    const DiscreteEcho received = shift_->moved(echo);
    if (received.bin >= 0) {
      moved_.discrete_echoes().push_back(received);
    }
  }
}

void CalibratedReceiver::write_truth(const EchoGrid& grid, Workers& workers, Ping& ping) {
  if (grid.ground_truth() == GroundTruth::kFull) {
    const DiscreteEchoes echoes = discrete();
    truth_.write(grid, {range_ ? &*range_ : nullptr, bearing_.get(), coarse_ ? &*coarse_ : nullptr, &echoes, gain_},
                 workers, ping);
  }
  if (leak_) {
    leak_->clear_truth(ping);
  }
  if (channels_) {
    channels_->receive_truth(ping);
  }
}

void CalibratedReceiver::receive(const EchoGrid& still, const FormedBeams* formed,
                                 std::span<const DisplacedInstance> displaced, const Pose& world_from_sonar,
                                 const PingMotion& motion, std::span<const std::optional<Vec3>> thrusters,
                                 Workers& workers, Ping& ping) {
  // Motion: echoes in the cells in which the moving sonar receives them.
  if (shift_) {
    move(still, motion, workers);
  }
  const EchoGrid& grid = shift_ ? moved_ : still;
  size_tables(ping, beams_, bins_, grid.ground_truth());
  ping.field.resize(has_field_ ? ping.intensity.size() : 0);
  ping.counts.resize(digitizer_ ? ping.intensity.size() : 0);
  ping.phase.resize(phase_ ? ping.intensity.size() : 0);
  rows_.resize(std::max(rows_.size(), static_cast<std::size_t>(workers.count())));

  if (formed != nullptr) {
    std::ranges::copy(formed->field, beam_signals().field.begin());
  } else {
    // Sum, speckle and pulse, cell by cell.
    views_.set(world_from_sonar, displaced);
    workers.for_each(cells_, [&](int cell, int worker) { receive_cell(grid, cell, rows_[worker]); });

    // Array pattern: beams from cells.
    if (bearing_) {
      form_beams(grid, workers);
    }
  }

  // Echoes that are not in cells, then the receiver's channels.
  add_discrete_echoes(grid);
  if (channels_) {
    couple_channels(workers);
  }

  // Noise and the transmit leak.
  if (noise_ && !has_noise(formed)) {
    draw_noise(ping, world_from_sonar, thrusters, workers);
  }
  if (leak_) {
    leak_->turn_head(ping.head_angle);
    receive_leak();
  }

  // Detection, gain and counts; ground truth.
  detect(grid, formed, workers, ping);
  write_truth(grid, workers, ping);
}

}  // namespace insonify
