// pulse.cpp -- range point-spread functions: rectangle, triangle, and compressed chirp (computed as an array pattern
// whose aperture is the frequency band).

#include "insonify/pulse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "sonar/lobes.h"
#include "sonar/window.h"

namespace insonify {

void PulseSettings::validate(std::string_view object) const {
  check_fields(object, *this);
  if (kind == PulseKind::kInstrument) {
    throw Error(object, "kind", " = instrument must be none, cw or lfm");
  }
  if (kind == PulseKind::kLfm && bandwidth * duration < kLeastCompression) {
    throw Error(object, "bandwidth",
                fmt::format(" = {:.10g} Hz times {}.duration = {:.10g} s must be at least {}", bandwidth, object,
                            duration, kLeastCompression));
  }
}

namespace {

ArrayWindow window_of(PulseWindow window) {
  switch (window) {
    case PulseWindow::kHann:
      return ArrayWindow::kHann;
    case PulseWindow::kHamming:
      return ArrayWindow::kHamming;
    case PulseWindow::kCosine:
      return ArrayWindow::kCosine;
    case PulseWindow::kTaylor:
      return ArrayWindow::kTaylor;
    case PulseWindow::kRectangular:
      break;
  }
  return ArrayWindow::kRectangular;
}

// Scaled so that its integral, the peak of its transform, is 1.
std::vector<WindowCosine> of_mean_1(std::vector<WindowCosine> window) {
  const double mean = line_pattern(window, 0);
  for (WindowCosine& part : window) {
    part.share /= mean;
  }
  return window;
}

// cos a cos b = (cos(a + b) + cos(a - b)) / 2.
std::vector<WindowCosine> squared(const std::vector<WindowCosine>& window) {
  std::vector<WindowCosine> square;
  for (const WindowCosine& a : window) {
    for (const WindowCosine& b : window) {
      square.push_back({a.turns + b.turns, 0.5 * a.share * b.share});
      square.push_back({std::abs(a.turns - b.turns), 0.5 * a.share * b.share});
    }
  }
  return square;
}

}  // namespace

double doppler_shift(double speed, double frequency, double sound_speed) {
  return 2 * speed * frequency / sound_speed;
}

Pulse::Pulse(const PulseSettings& settings, double sound_speed, double bin_length) {
  settings.validate();
  switch (settings.kind) {
    case PulseKind::kInstrument:  // Refused above.
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
      band_ = of_mean_1(line_weight({.window = window_of(settings.window), .side_lobe_db = settings.side_lobe_db}));
      power_ = of_mean_1(squared(band_));
      bias_per_hertz_ = settings.duration * cell_;
      break;
  }
  if (settings.kind != PulseKind::kNone) {
    noise_bandwidth_ = (shape_ == Shape::kChirp ? line_power(band_) : 1) / settings.duration;
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

double Pulse::noise_correlation(double dr) const {
  if (shape_ == Shape::kChirp) {
    return std::abs(dr) < reach_ ? line_pattern(power_, dr / cell_) : 0;
  }
  const double tone = shape_ == Shape::kTriangle ? reach_ : 2 * reach_;  // Length of the tone or bin [m].
  return std::max(0.0, 1 - std::abs(dr) / tone);
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
