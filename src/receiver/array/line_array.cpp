// line_array.cpp -- maps beam patterns to array windows and chooses the number of elements by the beam width.

#include "receiver/array/line_array.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "insonify/error.h"

namespace insonify {
namespace {

ArrayWindow window_of(BeamPattern pattern) {
  switch (pattern) {
    case BeamPattern::kHann:
      return ArrayWindow::kHann;
    case BeamPattern::kHamming:
      return ArrayWindow::kHamming;
    case BeamPattern::kCosine:
      return ArrayWindow::kCosine;
    case BeamPattern::kTaylor:
      return ArrayWindow::kTaylor;
    case BeamPattern::kDolphChebyshev:
      return ArrayWindow::kDolphChebyshev;
    case BeamPattern::kTopHat:      // Callers exclude it: a top hat is not made by an array.
    case BeamPattern::kInstrument:  // Callers have chosen the instrument's own.
    case BeamPattern::kRectangular:
      break;
  }
  return ArrayWindow::kRectangular;
}

// The least number of elements that are at most half a wavelength apart. The array length for a given beam width
// depends slightly on the number of elements, hence the iteration.
int half_wave_elements(ArraySettings settings, double beam_width) {
  constexpr int kMost = 1024;
  settings.elements = 2;
  for (;;) {
    const double needed = std::ceil(2 * ArrayPattern(settings).length(1, beam_width));
    if (needed > kMost) {
      throw Error(fmt::format("dolph_chebyshev takes more than {} elements for a beam of {:.4g} deg", kMost,
                              degrees_from_radians(beam_width)));
    }
    if (needed <= settings.elements) {
      return settings.elements;
    }
    settings.elements = static_cast<int>(needed);
  }
}

constexpr double kRightAngle = 0.5 * std::numbers::pi;

}  // namespace

ArraySettings line_array(BeamPattern pattern, double side_lobe_db, double beam_width) {
  ArraySettings settings;
  settings.window = window_of(pattern);
  settings.side_lobe_db = side_lobe_db;
  if (pattern == BeamPattern::kDolphChebyshev) {
    settings.elements = half_wave_elements(settings, beam_width);
  }
  return settings;
}

std::optional<ArraySettings> elevation_array(BeamPattern pattern, double aperture, const ReceiverConfig& receiver,
                                             const SonarConfig& sonar) {
  if (pattern == BeamPattern::kTopHat) {
    return {};
  }
  ArraySettings array = line_array(pattern, receiver.side_lobe_db, aperture);
  array.element_error_db = sonar.elevation_element_error_db;
  array.element_error = sonar.elevation_element_error;
  return array;
}

ArraySettings azimuth_array(const ReceiverConfig& receiver, const SonarConfig& sonar) {
  ArraySettings array = line_array(receiver.azimuth_pattern, receiver.side_lobe_db, beam_width(sonar));
  array.elements = receiver.elements > 0 ? receiver.elements : array.elements;
  array.element_error_db = receiver.element_error_db;
  array.element_error = receiver.element_error;
  array.dead_elements = receiver.dead_elements;
  array.two_way = sonar.is_two_way();
  return array;
}

ArraySettings without_faults(ArraySettings array) {
  array.element_error_db = array.element_error = 0;
  array.dead_elements.clear();
  return array;
}

ArraySettings receiving_array(const ReceiverConfig& receiver, const SonarConfig& sonar) {
  ArraySettings array = without_faults(azimuth_array(receiver, sonar));
  array.two_way = false;
  return array;
}

double slice_width(const SonarConfig& sonar) {
  return (sonar.beam_widths.empty() ? sonar.azimuth_aperture : sonar.bearings().covered()) / sonar.beam_count;
}

double beam_width(const SonarConfig& sonar) {
  return sonar.azimuth_resolution.value_or(slice_width(sonar));
}

AcrossElevations::AcrossElevations(const SonarConfig& sonar, const ReceiverConfig& receiver)
    : middle_(sonar.elevation_center), half_(0.5 * sonar.elevation_aperture) {
  const double aperture = sonar.elevation_aperture;
  if (const auto array = elevation_array(sonar.elevation_pattern_beside(receiver), aperture, receiver, sonar)) {
    array_.emplace(*array, aperture);
  }
}

double AcrossElevations::low() const {
  return array_ ? -kRightAngle : middle_ - half_;
}

double AcrossElevations::high() const {
  return array_ ? kRightAngle : middle_ + half_;
}

double AcrossElevations::intensity(double elevation) const {
  const double off = elevation - middle_;
  if (!array_) {
    return std::abs(off) <= half_ ? 1 : 0;
  }
  return std::abs(off) < kRightAngle ? array_->intensity(std::sin(off)) : 0;
}

}  // namespace insonify
