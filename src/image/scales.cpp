// scales.cpp -- round steps for ticks, and texts for numbers, frequencies and bearings.

#include "image/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

constexpr double kTickTolerance = 1e-9;  // Relative tolerance, so that rounding does not exclude ticks at the ends.

}  // namespace

double nice_step(double length, int most_parts) {
  const double least = length / most_parts * (1 - kTickTolerance);
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * power >= least) {
      return factor * power;
    }
  }
  return 10 * power;
}

std::vector<double> multiples_within(double low, double high, double step) {
  std::vector<double> values;
  const double slack = kTickTolerance * (std::abs(low) + std::abs(high));
  for (double n = std::ceil((low - slack) / step); n * step <= high + slack; ++n) {
    values.push_back(n * step);
  }
  return values;
}

double ring_step(double window) {
  return nice_step(window, 6);
}

double radial_step(double aperture, Mounting mounting) {
  const double degrees = degrees_from_radians(aperture);
  const double widest_of_tens = mounting == Mounting::kVertical ? 90 : 75;
  const double widest_of_twenties = mounting == Mounting::kVertical ? 0 : 180;
  return radians_from_degrees(degrees <= 5                    ? 1
                              : degrees <= 12                 ? 2
                              : degrees <= 30                 ? 5
                              : degrees <= widest_of_tens     ? 10
                              : degrees <= widest_of_twenties ? 20
                                                              : 30);
}

std::string number_text(double value) {
  std::string text = fmt::format("{:.4g}", std::abs(value));
  return value < 0 && text != "0" ? "−" + text : text;
}

std::string frequency_text(double frequency) {
  return frequency >= 1e6   ? number_text(frequency / 1e6) + " MHz"
         : frequency >= 1e3 ? number_text(frequency / 1e3) + " kHz"
                            : number_text(frequency) + " Hz";
}

std::string bearing_text(double azimuth, Mounting mounting) {
  const double tenths = std::round(10 * degrees_from_radians(std::remainder(azimuth, 2 * std::numbers::pi)));
  if (mounting == Mounting::kVertical) {
    const double slope = std::min(std::abs(tenths), 1800 - std::abs(tenths));  // Angle from the horizontal.
    return tenths == 0                ? "front"
           : std::abs(tenths) == 1800 ? "back"
           : slope == 900             ? (tenths > 0 ? "up" : "down")
                                      : number_text(slope / 10) + (tenths > 0 ? "° up" : "° down");
  }
  const std::string angle = number_text(std::abs(tenths) / 10) + "°";
  const bool has_side = tenths != 0 && std::abs(tenths) != 1800;
  return has_side ? angle + (tenths > 0 ? " P" : " S") : angle;
}

}  // namespace insonify
