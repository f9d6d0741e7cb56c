// pulse.cpp -- range point-spread functions: rectangle, triangle, and compressed chirp (computed as an array pattern
// whose aperture is the frequency band).

#include "insonify/pulse.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "sonar/lobes.h"
#include "sonar/window.h"

namespace insonify {

void PulseSettings::validate(std::string_view object) const {
  check_fields(object, *this);
  constexpr double kLeastCompression = 10;
  if (kind == PulseKind::kLfm && bandwidth * duration < kLeastCompression) {
    throw Error(object, "bandwidth",
                fmt::format(" = {:.10g} Hz times {}.duration = {:.10g} s must be at least {}", bandwidth, object,
                            duration, kLeastCompression));
  }
}

double doppler_shift(double speed, double frequency, double sound_speed) {
  return 2 * speed * frequency / sound_speed;
}

Pulse::Pulse(const PulseSettings& settings, double sound_speed, double bin_length) {
  settings.validate();
  switch (settings.kind) {
    case PulseKind::kNone:
      reach_ = bin_length / 2;
      break;
    case PulseKind::kCw:
      shape_ = settings.matched_filter ? Shape::kTriangle : Shape::kRectangle;
      reach_ = sound_speed * settings.duration / (settings.matched_filter ? 2 : 4);
      break;
    case PulseKind::kLfm:
      shape_ = Shape::kChirp;
      reach_ = sound_speed * settings.duration / 2;
      cell_ = sound_speed / (2 * settings.bandwidth);
      // Weights of mean 1, so that the peak is 1.
      band_ = {{0, 1}};
      if (settings.hann) {
        band_.push_back({1, 1});
      }
      bias_per_hertz_ = settings.duration * cell_;
      break;
  }
}

double Pulse::amplitude(double dr) const {
  constexpr double kOnEdge = 1e-9;
  const double part = std::abs(dr) / reach_;
  if (shape_ == Shape::kRectangle && std::abs(part - 1) < kOnEdge) {
    return std::sqrt(0.5);
  }
  if (part >= 1) {
    return 0;
  }
  switch (shape_) {
    case Shape::kTriangle:
      return 1 - part;
    case Shape::kChirp:
      return line_pattern(band_, dr / cell_);
    case Shape::kRectangle:
      break;
  }
  return 1;
}

double Pulse::width() const {
  switch (shape_) {
    case Shape::kTriangle:
      return 2 * (1 - std::sqrt(0.5)) * reach_;
    case Shape::kChirp:
      return cell_ * half_power_width([this](double x) { return intensity(x * cell_); }, 0.1);
    case Shape::kRectangle:
      break;
  }
  return 2 * reach_;
}

double Pulse::side_lobe_db() const {
  if (shape_ != Shape::kChirp) {
    return -std::numeric_limits<double>::infinity();
  }
  const double x = highest_side_lobe_at([this](double at) { return intensity(at * cell_); }, 0.01, 5);
  return 10 * std::log10(intensity(x * cell_));
}

double Pulse::equivalent_length() const {
  switch (shape_) {
    case Shape::kTriangle:
      return 2 * reach_ / 3;
    case Shape::kChirp:
      return cell_ * line_power(band_);
    case Shape::kRectangle:
      break;
  }
  return 2 * reach_;
}

}  // namespace insonify
