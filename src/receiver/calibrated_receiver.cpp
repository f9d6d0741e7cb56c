// calibrated_receiver.cpp -- cells, pulse, array, noise, gain.

#include "receiver/calibrated_receiver.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <functional>

#include "echo/echo.h"
#include "insonify/absorption.h"
#include "insonify/sonar_equation.h"
#include "receiver/line_array.h"
#include "receiver/normal_numbers.h"

namespace insonify {
namespace {

constexpr int kBinsATask = 64;
constexpr float kComponent = 0.70710678F;  // Deviation of each part of a complex number whose mean square is 1.

double noise_intensity_of(const SonarConfig& sonar) {
  const double width = sonar.azimuth_aperture / sonar.beam_count;
  const double directivity = sector_directivity_index_db(width, sonar.elevation_aperture);
  const double level = noise_level_db(thermal_noise_level_db(sonar.frequency), sonar.bandwidth, directivity);
  return std::pow(10.0, (level - sonar.source_level_db) / 10);
}

// Echo of a bin of water, per unit of solid angle; not from nearer than a millimetre, where spreading has no meaning.
double volume_reverberation(double backscatter, double middle, double half, double absorption_db_per_m) {
  constexpr double kNearest = 1e-3;
  const double near = std::max(middle - half, kNearest);
  return backscatter * (1 / near - 1 / (middle + half)) * std::pow(10.0, -0.2 * absorption_db_per_m * middle);
}

// Tells poses apart: equal poses give equal numbers.
std::uint64_t number_of(const Pose& pose) {
  std::uint64_t number = 0;
  for (const double value : {pose.position.x(), pose.position.y(), pose.position.z(), pose.orientation.w(),
                             pose.orientation.x(), pose.orientation.y(), pose.orientation.z()}) {
    number = (number ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15U;
    number ^= number >> 29;
  }
  return number;
}

}  // namespace

CalibratedReceiver::CalibratedReceiver(const SonarConfig& sonar, const BearingCells& cells,
                                       std::span<const float> cell_angles, const Water& water,
                                       const ReceiverConfig& config, std::uint64_t seed)
    : beams_(sonar.beam_count),
      bins_(sonar.bin_count),
      cells_(cells.sonar.beam_count),
      first_cell_(cells.first),
      cells_per_beam_(cells.per_beam),
      cell_angle_(cell_angles.begin(), cell_angles.end()),
      noise_intensity_(noise_intensity_of(sonar)),
      noisy_(config.noise),
      speckled_(config.speckle),
      seed_(seed) {
  const double absorption = water.absorption_db_per_m_at(sonar.frequency);
  for (int bin = 0; bin < bins_; ++bin) {
    const double range = sonar.bin_range(bin), ramp = near_field(sonar, bin);
    const double gain_db =
        config.time_varied_gain ? *config.time_varied_gain * std::log10(range) + 2 * absorption * range : 0.0;
    gain_.push_back(static_cast<float>(ramp * ramp * std::pow(10.0, gain_db / 10)));
  }
  assert(cell_angle_.size() == static_cast<std::size_t>(cells_));
  const double sound_speed = sonar.assumed_sound_speed.value_or(water.true_sound_speed());
  for (int bin = 0; water.volume_backscatter_db && bin < bins_; ++bin) {
    const double true_per_shown = water.true_sound_speed() / sound_speed;
    const double middle = true_per_shown * sonar.bin_range(bin), half = 0.5 * true_per_shown * sonar.bin_length();
    const double backscatter = std::pow(10.0, *water.volume_backscatter_db / 10);
    volume_.push_back(static_cast<float>(volume_reverberation(backscatter, middle, half, absorption)));
  }
  if (config.pulse != PulseKind::kNone) {
    const Pulse pulse({.kind = config.pulse, .duration = config.pulse_duration, .bandwidth = config.pulse_bandwidth},
                      sound_speed, sonar.bin_length());
    range_.emplace(pulse, sonar.bin_length());
  }
  if (config.azimuth_pattern != BeamPattern::kTopHat) {
    const double wavelength = water.true_sound_speed() / sonar.frequency;
    const double width = beam_width(sonar);
    ArraySettings array = line_array(config.azimuth_pattern, config.side_lobe_db, width);
    array.two_way = sonar.type == SonarType::kMechanicallyScanned;
    const ArrayPattern pattern(array);
    bearing_.emplace(pattern, pattern.length(wavelength, width) / wavelength, BearingCells::sines(cells.sonar),
                     BearingCells::sines(sonar));
  }
  const std::size_t cell_count = static_cast<std::size_t>(cells_) * bins_;
  const std::size_t beam_count = bearing_ ? static_cast<std::size_t>(beams_) * bins_ : 0;
  cell_energy_.resize(speckled_ ? 0 : cell_count);
  beam_energy_.resize(speckled_ ? 0 : beam_count);
  cell_field_.resize(speckled_ ? cell_count : 0);
  beam_field_.resize(speckled_ ? beam_count : 0);
}

// Echo of all path orders, and of the water from directions that no surface has closed yet.
void CalibratedReceiver::sum_energy(const EchoGrid& grid, int cell, std::span<float> energy) const {
  std::ranges::fill(energy, 0.0F);
  for (int order = 1; order <= grid.order_count(); ++order) {
    const std::span<const float> layer = grid.energy(order, cell);
    std::ranges::transform(energy, layer, energy.begin(), std::plus());
  }
  if (!volume_.empty()) {
    const std::span<const float> met = grid.weight(1, cell);
    float open = cell_angle_[cell];
    for (std::size_t i = 0; i < energy.size(); ++i) {
      energy[i] += volume_[i] * std::max(0.0F, open - 0.5F * met[i]);  // Met half-way through the bin, on average.
      open -= met[i];
    }
  }
}

void CalibratedReceiver::draw_speckle(int cell, std::uint64_t look, const Row& row,
                                      std::span<std::complex<float>> field) const {
  for (int block = 0; block * kTileBins < bins_; ++block) {
    float in_phase[kTileBins], quadrature[kTileBins];
    draw_normals(RandomPurpose::kSpeckleInPhase, block, cell, look, seed_, in_phase);
    draw_normals(RandomPurpose::kSpeckleQuadrature, block, cell, look, seed_, quadrature);
    for (int i = 0; i < std::min(kTileBins, bins_ - block * kTileBins); ++i) {
      const int bin = block * kTileBins + i;
      const float amplitude = kComponent * std::sqrt(row.energy[bin]);
      field[bin] = {amplitude * in_phase[i], amplitude * quadrature[i]};
    }
  }
}

// One cell's echo and what the pulse makes of it.
void CalibratedReceiver::hear_cell(const EchoGrid& grid, int cell, std::uint64_t look, Row& row) {
  const auto bins = static_cast<std::size_t>(bins_);
  row.energy.resize(bins);
  if (speckled_) {
    const std::span<std::complex<float>> heard(&cell_field_[bins * cell], bins);
    sum_energy(grid, cell, row.energy);
    if (range_) {
      row.field.resize(bins);
      draw_speckle(cell, look, row, row.field);
      range_->hear_field(row.field, heard);
    } else {
      draw_speckle(cell, look, row, heard);
    }
    return;
  }
  const std::span<float> heard(&cell_energy_[bins * cell], bins);
  if (range_) {
    sum_energy(grid, cell, row.energy);
    range_->hear_energy(row.energy, heard);
  } else {
    sum_energy(grid, cell, heard);
  }
}

void CalibratedReceiver::hear(const EchoGrid& grid, const Pose& world_from_sonar, Workers& workers, Ping& ping) {
  size_tables(ping, beams_, bins_);
  const std::uint64_t look = speckled_ ? number_of(world_from_sonar) : 0;
  rows_.resize(std::max(rows_.size(), static_cast<std::size_t>(workers.count())));
  workers.for_each(cells_, [&](int cell, int worker) { hear_cell(grid, cell, look, rows_[worker]); });
  if (bearing_) {
    workers.for_each((bins_ + kBinsATask - 1) / kBinsATask, [&](int task, int) {
      const BearingResponse::Bins bins{task * kBinsATask, std::min((task + 1) * kBinsATask, bins_)};
      speckled_ ? bearing_->hear_field(cell_field_, beam_field_, bins_, bins)
                : bearing_->hear_energy(cell_energy_, beam_energy_, bins_, bins);
    });
  }
  const int tiles_along = (bins_ + kTileBins - 1) / kTileBins, tiles_across = (beams_ + kTileBeams - 1) / kTileBeams;
  workers.for_each(tiles_across * tiles_along, [&](int tile, int) {
    const int beam = tile / tiles_along * kTileBeams, bin = tile % tiles_along * kTileBins;
    hear_tile(grid, {beam, std::min(kTileBeams, beams_ - beam), bin, std::min(kTileBins, bins_ - bin)}, ping);
  });
}

void CalibratedReceiver::hear_tile(const EchoGrid& grid, const TilePlace& place, Ping& ping) const {
  HeardTile tile = {};
  float in_phase[kTileBins] = {}, quadrature[kTileBins] = {};
  const auto deviation = noisy_ ? static_cast<float>(std::sqrt(0.5 * noise_intensity_)) : 0.0F;
  const std::vector<float>& energy = bearing_ ? beam_energy_ : cell_energy_;
  const std::vector<std::complex<float>>& field = bearing_ ? beam_field_ : cell_field_;
  for (int b = 0; b < place.beam_count; ++b) {
    fetch_rows(place, b, ping);
    const int beam = place.first_beam + b;
    const std::size_t start = static_cast<std::size_t>(beam) * bins_ + place.first_bin;
    if (noisy_) {
      const int block = place.first_bin / kTileBins;
      draw_normals(RandomPurpose::kNoiseInPhase, block, beam, ping.number, seed_, in_phase);
      draw_normals(RandomPurpose::kNoiseQuadrature, block, beam, ping.number, seed_, quadrature);
    }
    for (int i = 0; i < place.bin_count; ++i) {
      // A field without speckle has the phase 0.
      const float real = (speckled_ ? field[start + i].real() : std::sqrt(energy[start + i])) + deviation * in_phase[i];
      const float imaginary = (speckled_ ? field[start + i].imag() : 0.0F) + deviation * quadrature[i];
      tile.intensity[b][i] = (real * real + imaginary * imaginary) * gain_[place.first_bin + i];
    }
    take_strongest_labels(grid, place, b, tile);
  }
  write_tile(tile, place, ping);
}

// Of the cells in a beam's own slice.
void CalibratedReceiver::take_strongest_labels(const EchoGrid& grid, const TilePlace& place, int beam_of_tile,
                                               HeardTile& tile) const {
  const int first = first_cell_ + (place.first_beam + beam_of_tile) * cells_per_beam_;
  take_labels(grid, first, place, beam_of_tile, tile);
  float strongest[kTileBins];
  std::copy_n(grid.label_rows(first).energy + place.first_bin, place.bin_count, strongest);
  for (int cell = first + 1; cell < first + cells_per_beam_; ++cell) {
    const EchoGrid::ConstLabelRows labels = grid.label_rows(cell);
    for (int i = 0; i < place.bin_count; ++i) {
      const int bin = place.first_bin + i;
      const bool silent = tile.surface[beam_of_tile][i] == kNoSurface;
      if (labels.surface[bin] != kNoSurface && (silent || labels.energy[bin] > strongest[i])) {
        strongest[i] = labels.energy[bin];
        tile.surface[beam_of_tile][i] = labels.surface[bin];
        tile.elevation[beam_of_tile][i] = grid.label(cell, bin).elevation;
      }
    }
  }
}

}  // namespace insonify
