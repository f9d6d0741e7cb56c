// calibrated_receiver_setup.cpp -- computes the tables and parts of a CalibratedReceiver that are the same for all
// pings.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "insonify/acoustics/absorption.h"
#include "receiver/array/line_array.h"
#include "receiver/calibrated_receiver.h"
#include "receiver/noise/noise_level.h"
#include "receiver/pulse/carrier_spread.h"

namespace insonify {
namespace {

// Volume reverberation of one bin per unit solid angle, s_v (1/r1 - 1/r2) with absorption at the bin's middle: the
// integral of s_v r^2 / r^4 from r1 to r2 (Urick 1983, ch. 8). Ranges start at a millimetre: 1/r has a pole at 0.
// @param backscatter   s_v [1/m], linear.
// @param middle, half  Middle and half length of the bin, true range [m].
double volume_reverberation(double backscatter, double middle, double half, double absorption_db_per_m) {
  constexpr double kNearest = 1e-3;
  const double near = std::max(middle - half, kNearest);
  return backscatter * (1 / near - 1 / (middle + half)) * std::pow(10.0, -0.2 * absorption_db_per_m * middle);
}

// Intensity gain of each bin: near-field ramp (of amplitude, hence squared) and time-varied gain.
std::vector<float> gain_of(const SonarConfig& sonar, const ReceiverConfig& receiver, double absorption_db_per_m) {
  std::vector<float> gain;
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    const double range = sonar.bin_range(bin), ramp = near_field(sonar, bin);
    gain.push_back(static_cast<float>(ramp * ramp * std::pow(10.0, receiver.gain_db(range, absorption_db_per_m) / 10)));
  }
  return gain;
}

// Volume reverberation of each bin per unit solid angle [1/sr]; empty where the water has no volume backscatter.
std::vector<float> volume_of(const SonarConfig& sonar, const Water& water, double range_scale) {
  std::vector<float> volume;
  for (int bin = 0; water.volume_backscatter_db && bin < sonar.bin_count; ++bin) {
    const double middle = range_scale * sonar.bin_range(bin), half = 0.5 * range_scale * sonar.bin_length();
    const double backscatter = std::pow(10.0, *water.volume_backscatter_db / 10);
    const double absorption = water.absorption_db_per_m_at(sonar.frequency);
    volume.push_back(static_cast<float>(volume_reverberation(backscatter, middle, half, absorption)));
  }
  return volume;
}

}  // namespace

// What several of the parts are set up from.
struct CalibratedReceiver::SetUp {
  explicit SetUp(const Settings& settings)
      : of(settings),
        true_speed(settings.water.true_sound_speed()),
        shown_speed(settings.sonar.assumed_sound_speed.value_or(true_speed)),
        range_scale(true_speed / shown_speed),
        wavelength(true_speed / settings.sonar.frequency),
        absorption_db_per_m(settings.water.absorption_db_per_m_at(settings.sonar.frequency)),
        transmitted(settings.sonar.transmitted(settings.receiver)),
        has_pulse(transmitted.kind != PulseKind::kNone),
        pulse(transmitted, shown_speed, settings.sonar.bin_length()),
        beam_sines(settings.sonar.bearings().sines()) {}

  const Settings& of;
  double true_speed, shown_speed;  // [m/s]
  double range_scale;              // True ranges per range shown.
  double wavelength, absorption_db_per_m;
  PulseSettings transmitted;
  bool has_pulse;
  Pulse pulse;
  std::vector<double> beam_sines;
  std::optional<ArrayPattern> perfect;  // Array without faults, one way: receives isotropic noise.
  std::optional<ArrayPattern> hearing;  // Array with its faults, one way: receives sound from one direction.
  double length = 0;                    // Length of the array [wavelengths].
};

CalibratedReceiver::CalibratedReceiver(const Settings& settings)
    : beams_(settings.sonar.beam_count),
      bins_(settings.sonar.bin_count),
      cells_(settings.cells.grid.count()),
      cells_per_beam_(settings.cells.per_beam),
      first_cells_(settings.cells.firsts),
      cell_angle_(settings.cell_angles.begin(), settings.cell_angles.end()),
      truth_(settings.sonar, settings.cells, settings.cell_angles),
      saturation_(settings.receiver.saturation_db
                      ? static_cast<float>(std::pow(10.0, *settings.receiver.saturation_db / 10))
                      : std::numeric_limits<float>::infinity()),
      has_field_(settings.receiver.field),
      seed_(settings.seed) {
  assert(cell_angle_.size() == static_cast<std::size_t>(cells_));
  const SonarConfig& sonar = settings.sonar;
  const ReceiverConfig& receiver = settings.receiver;
  SetUp parts(settings);
  gain_ = gain_of(sonar, receiver, parts.absorption_db_per_m);
  volume_ = volume_of(sonar, settings.water, parts.range_scale);
  if (parts.has_pulse) {
    range_.emplace(parts.pulse, sonar.bin_length());
    coarse_.emplace(parts.pulse, sonar.bin_length(), *range_, receiver.decimation);
    keeps_looks_ = coarse_->has_looks() && (receiver.speckle || receiver.noise);
  }
  if (receiver.azimuth_pattern != BeamPattern::kTopHat) {
    set_up_array(parts);
  }
  noise_deviation_.resize(static_cast<std::size_t>(beams_));
  if (receiver.noise) {
    set_up_noise(parts);
  }
  if (sonar.is_multibeam() && bearing_) {
    set_up_phase(parts);
  }
  if (ReceiverChannels::differ_in(sonar)) {
    channels_.emplace(sonar);
  }
  if (TransmitLeak::is_in(sonar)) {
    leak_.emplace(sonar, receiver, parts.shown_speed, noise_intensity(sonar, receiver, parts.pulse), seed_);
  }
  if (settings.moves) {
    const double bias = parts.pulse.doppler_bias(doppler_shift(1, sonar.frequency, parts.true_speed));
    shift_.emplace(settings.cells, sonar, parts.range_scale, parts.true_speed, bias, bearing_ != nullptr);
  }
  if (receiver.speckle) {
    set_up_speckle(parts);
  }
  if (receiver.counts) {
    digitizer_.emplace(sonar, receiver.full_scale_db.value_or(0), receiver.full_scale_share);
  }
  of_cells_ = Signals(static_cast<std::size_t>(cells_) * bins_, receiver.speckle, keeps_looks_);
  if (bearing_) {
    of_beams_ = Signals(static_cast<std::size_t>(beams_) * bins_, receiver.speckle, keeps_looks_);
  }
  if (is_flat()) {
    flat_ = settings.like != nullptr ? settings.like->flat_ : std::make_shared<const FlatReceiver>(flattened());
  }
}

void CalibratedReceiver::set_up_array(SetUp& parts) {
  const SonarConfig& sonar = parts.of.sonar;
  const ReceiverConfig& receiver = parts.of.receiver;
  const BearingCells& cells = parts.of.cells;
  const ArrayPattern array(azimuth_array(receiver, sonar), seed_);
  parts.perfect.emplace(receiving_array(receiver, sonar));
  ArraySettings one_way = azimuth_array(receiver, sonar);
  one_way.two_way = false;
  parts.hearing.emplace(one_way, seed_);
  parts.length = array.length(parts.wavelength, beam_width(sonar)) / parts.wavelength;
  bearing_ =
      parts.of.like != nullptr
          ? parts.of.like->bearing_
          : std::make_shared<const BearingResponse>(
                array, parts.length, cells.grid.sines(), parts.beam_sines, BearingResponse::kFloorDb,
                BearingResponse::Extras{.cell_edges = cells.edge_sines,
                                        .element = FanPattern(sonar.element_width),
                                        .zones = focus_zones(sonar, parts.length, parts.wavelength, parts.range_scale),
                                        .elements = one_way.elements});
}

NoiseField::Settings CalibratedReceiver::noise_settings(const SetUp& parts) const {
  // Beams of a lens have a transducer and an amplifier each, whose noises are independent.
  const bool has_common_array = parts.perfect && parts.of.sonar.steering != Steering::kLens;
  return {.beams = beams_,
          .bins = bins_,
          .pulse = parts.pulse,
          .bin_length = parts.of.sonar.bin_length(),
          .array = has_common_array ? &*parts.perfect : nullptr,
          .length = parts.length,
          .beam_sines = parts.beam_sines,
          .seed = seed_};
}

void CalibratedReceiver::set_up_phase(const SetUp& parts) {
  const SonarConfig& sonar = parts.of.sonar;
  const bool shared = parts.of.like != nullptr && parts.of.like->phase_;
  const NoiseField::Settings noise = noise_settings(parts);
  phase_.emplace(shared ? parts.of.like->phase_->split()
                        : std::make_shared<const SplitArray>(*parts.perfect, parts.length, parts.of.cells.grid.sines(),
                                                             parts.beam_sines, FanPattern(sonar.element_width)),
                 beams_, bins_, parts.of.receiver.speckle, noise_ ? &noise : nullptr);
}

void CalibratedReceiver::set_up_noise(const SetUp& parts) {
  const SonarConfig& sonar = parts.of.sonar;
  const ReceiverConfig& receiver = parts.of.receiver;
  ReceiverConfig isotropic = receiver;
  if (receiver.surface_noise && (receiver.wind_noise || receiver.rain_noise.value_or(0) > 0)) {
    isotropic.wind_noise.reset();
    isotropic.rain_noise.reset();
    surface_noise_.emplace(sonar, receiver, parts.of.water.depth, parts.absorption_db_per_m,
                           receive_bearing_width(sonar, receiver));
    surface_noise_level_ =
        noise_intensity(sonar, parts.pulse, weather_spectrum_db(receiver, sonar.frequency), 4 * std::numbers::pi);
    surface_shares_.resize(static_cast<std::size_t>(beams_));
  }
  isotropic_noise_ = static_cast<float>(noise_intensity(sonar, isotropic, parts.pulse));
  noise_deviation_.assign(static_cast<std::size_t>(beams_), std::sqrt(0.5F * isotropic_noise_));
  noise_.emplace(noise_settings(parts));
  if (!parts.of.thrusters.empty()) {
    thrusters_.emplace(ThrusterNoise::Settings{.thrusters = parts.of.thrusters,
                                               .sonar = sonar,
                                               .receiver = receiver,
                                               .water = parts.of.water,
                                               .pulse = parts.pulse,
                                               .duration = parts.has_pulse ? parts.transmitted.duration : 0,
                                               .shown_speed = parts.shown_speed,
                                               .array = parts.hearing ? &*parts.hearing : nullptr,
                                               .length = parts.length,
                                               .wavelength = parts.wavelength,
                                               .seed = seed_});
  }
}

void CalibratedReceiver::set_up_speckle(const SetUp& parts) {
  const SonarConfig& sonar = parts.of.sonar;
  const BearingGrid& grid = parts.of.cells.grid;
  const double window = std::min(sonar.bin_length(), parts.pulse.equivalent_length());  // One look.
  lattice_.emplace(grid, sonar, parts.range_scale, parts.wavelength, parts.range_scale * window, seed_);
  CarrierSpread spread = carrier_spread(parts.pulse, sonar.bin_length(), window);
  spread.length *= parts.range_scale;
  speckle_.emplace(*lattice_, range_ ? &*range_ : nullptr, spread);
  sparse_.emplace(parts.of.materials, grid, *lattice_);
  clutter_.emplace(parts.of.materials, grid, *lattice_, seed_);
}

}  // namespace insonify
