// reflection.cpp -- reflection by half-spaces, plates and absorbing bottoms.

#include "insonify/acoustics/reflection.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <string_view>

#include "acoustics/formula.h"
#include "base/square.h"

namespace insonify {
double reflection_coefficient(double water_impedance, double impedance) {
  assert(water_impedance > 0 && impedance > 0);
  return (impedance - water_impedance) / (impedance + water_impedance);
}

double plate_reflection(double water_impedance, double density, double sound_speed, double thickness,
                        double frequency) {
  constexpr std::string_view kName = "plate_reflection";
  check_argument(kName, "water_impedance", "kg/(m^2 s)", greater_than(0), water_impedance);
  check_argument(kName, "density", "kg/m^3", greater_than(0), density);
  check_argument(kName, "sound_speed", "m/s", greater_than(0), sound_speed);
  check_argument(kName, "thickness", "m", at_least(0), thickness);
  check_argument(kName, "frequency", "Hz", greater_than(0), frequency);
  const double mismatch = density * sound_speed / water_impedance;
  const double phase = 2 * std::numbers::pi * frequency / sound_speed * thickness;
  const double q = square((mismatch - 1 / mismatch) * std::sin(phase));
  return std::sqrt(q / (4 + q));
}

std::complex<double> bottom_reflection(double density_ratio, double sound_speed_ratio, double loss, double grazing) {
  constexpr std::string_view kName = "bottom_reflection";
  check_argument(kName, "density_ratio", "", greater_than(0), density_ratio);
  check_argument(kName, "sound_speed_ratio", "", greater_than(0), sound_speed_ratio);
  check_argument(kName, "loss", "", at_least(0), loss);
  check_argument(kName, "grazing", "rad", from_to(0, std::numbers::pi / 2), grazing);
  if (grazing == 0) {
    return -1;  // The limit; the formula is 0/0 where the bottom is lossless and as fast as the water.
  }
  const std::complex<double> wavenumber = std::complex<double>{1, loss} / sound_speed_ratio;
  const std::complex<double> sine = std::sqrt(wavenumber * wavenumber - square(std::cos(grazing)));  // P
  const double weighted_sine = density_ratio * std::sin(grazing);
  return (weighted_sine - sine) / (weighted_sine + sine);  // (y - 1)/(y + 1), also where P is 0.
}

}  // namespace insonify
