// thruster_noise.cpp -- levels, gains and modulation of the noise of thrusters.

#include "receiver/noise/thruster_noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "insonify/acoustics/sonar_equation.h"
#include "receiver/noise/noise_level.h"

namespace insonify {
namespace {

constexpr double kPi = std::numbers::pi;

double sinc(double x) {
  return std::abs(x) < 1e-9 ? 1 : std::sin(kPi * x) / (kPi * x);
}

// Mean intensity of a thruster's noise at a distance, re the sonar's source at 1 m, for a receive pattern of 1.
double mean_intensity(const ThrusterNoise::Settings& settings, const Thruster& thruster, double range) {
  const double loss = 20 * std::log10(range) + settings.water.absorption_db_per_m_at(settings.sonar.frequency) * range;
  return noise_intensity(settings.sonar, settings.pulse, thruster.spectrum_db(settings.sonar.frequency) - loss,
                         4 * kPi);
}

// Edge phase of the unsteered array for a distance, see focus_zones(); 0 in focus.
double edge_phase(const ThrusterNoise::Settings& settings, double range) {
  if (settings.array == nullptr || !settings.sonar.focus_range) {
    return 0;
  }
  const double across = settings.length * settings.wavelength;
  return 0.25 * kPi * settings.length * across * (1 / std::max(range, across) - 1 / *settings.sonar.focus_range);
}

}  // namespace

ThrusterNoise::ThrusterNoise(const Settings& settings)
    : beams_(settings.sonar.beam_count),
      bins_(settings.sonar.bin_count),
      shape_(settings.receiver.beam_shape),
      slices_(settings.sonar.bearings()),
      sines_(slices_.sines()),
      taps_(noise_taps(settings.pulse, settings.sonar.bin_length())),
      length_(settings.length),
      element_(settings.sonar.element_width),
      elevations_(settings.sonar, settings.receiver),
      first_time_(2 * settings.sonar.bin_range(0) / settings.shown_speed),
      time_per_bin_(2 * settings.sonar.bin_length() / settings.shown_speed),
      true_speed_(settings.water.true_sound_speed()),
      seed_(settings.seed) {
  if (settings.array != nullptr) {
    array_.emplace(*settings.array);
  }
  for (const Thruster& thruster : settings.thrusters) {
    const double range = (thruster.position - settings.sonar.position).norm();
    sources_.push_back({.thruster = thruster,
                        .range = range,
                        .mean = mean_intensity(settings, thruster, range),
                        .depth = thruster.modulation * sinc(thruster.blade_rate * settings.duration),
                        .edge_phase = edge_phase(settings, range),
                        .gains = std::vector<std::complex<float>>(static_cast<std::size_t>(beams_)),
                        .values = std::vector<float>(2 * static_cast<std::size_t>(bins_)),
                        .envelope = std::vector<float>(static_cast<std::size_t>(bins_))});
  }
}

double ThrusterNoise::bearing_of(const Vec3& direction) const {
  return shape_ == BeamShape::kWedge ? std::atan2(direction.y(), direction.x())
                                     : std::asin(std::clamp(direction.y(), -1.0, 1.0));
}

// Computes the gain of each beam towards a source. Arrays receive nothing from behind.
void ThrusterNoise::aim(Source& source, const Vec3& place) const {
  const Vec3 direction = place.normalized();
  const double elevation = std::atan2(direction.z(), std::hypot(direction.x(), direction.y()));
  const double bearing = bearing_of(direction), sine = std::sin(bearing);
  const bool is_behind = !(direction.x() > 0) && (array_ || shape_ == BeamShape::kCone);
  const double across = is_behind ? 0 : std::sqrt(elevations_.intensity(elevation));
  for (int beam = 0; beam < beams_; ++beam) {
    std::complex<double> gain = slices_.has(beam, bearing) ? 1 : 0;
    if (array_) {
      const double x = length_ * (sine - sines_[beam]), phase = source.edge_phase * (1 - sines_[beam] * sines_[beam]);
      gain = phase == 0 ? array_->amplitude(x) : array_->defocused(phase).amplitude(x);
      gain *= element_.is_flat() ? 1 : std::sqrt(element_.intensity(sine));
    }
    source.gains[beam] = std::complex<float>(across * gain);
  }
  source.place = place;
}

// Draws the noise of a source for a gain of 1, and computes its mean intensity in each bin.
void ThrusterNoise::draw(Source& source, int index, std::uint64_t ping, double time, std::vector<float>& white) const {
  draw_filtered_row(taps_, RandomPurpose::kThrusterInPhase, RandomPurpose::kThrusterQuadrature, index, ping, seed_,
                    white, source.values);
  const double begins = time + first_time_ - source.range / true_speed_;
  for (int bin = 0; bin < bins_; ++bin) {
    const double turns = source.thruster.blade_rate * (begins + bin * time_per_bin_);
    const double phase = 2 * kPi * (turns - std::floor(turns)) + source.thruster.blade_phase;
    const double intensity = source.mean * (1 + source.depth * std::cos(phase));
    const auto deviation = static_cast<float>(std::sqrt(0.5 * intensity));
    source.envelope[bin] = static_cast<float>(intensity);
    source.values[bin] *= deviation;
    source.values[bins_ + bin] *= deviation;
  }
}

void ThrusterNoise::add_to(NoiseField& noise, std::span<const std::optional<Vec3>> places, std::uint64_t ping,
                           double time, std::span<const float> deviations, Workers& workers) {
  assert(places.size() == sources_.size());
  white_.resize(std::max(white_.size(), static_cast<std::size_t>(workers.count())));
  workers.for_each(static_cast<int>(sources_.size()), [&](int index, int worker) {
    Source& source = sources_[index];
    if (!places[index]) {
      std::ranges::fill(source.gains, 0);
      source.place.reset();
      return;
    }
    if (source.place != places[index]) {
      aim(source, *places[index]);
    }
    draw(source, index, ping, time, white_[worker]);
  });
  workers.for_each(beams_, [&](int beam, int) {
    float* const real = noise.values(beam);
    float* const imaginary = real + bins_;
    for (const Source& source : sources_) {
      const std::complex<float> gain = source.gains[beam] / deviations[beam];
      if (gain == std::complex<float>(0)) {
        continue;
      }
      for (int bin = 0; bin < bins_; ++bin) {
        const float in_phase = source.values[bin], quadrature = source.values[bins_ + bin];
        real[bin] += gain.real() * in_phase - gain.imag() * quadrature;
        imaginary[bin] += gain.real() * quadrature + gain.imag() * in_phase;
      }
    }
  });
}

float ThrusterNoise::intensity(int beam, int bin) const {
  float sum = 0;
  for (const Source& source : sources_) {
    sum += std::norm(source.gains[beam]) * source.envelope[bin];
  }
  return sum;
}

}  // namespace insonify
