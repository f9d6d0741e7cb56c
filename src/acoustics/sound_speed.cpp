// sound_speed.cpp -- published formulas for the sound speed of water, and sound paths in a constant gradient.

#include "insonify/acoustics/sound_speed.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "acoustics/formula.h"
#include "insonify/error.h"
#include "insonify/geometry.h"

namespace insonify {
namespace {

// Inside this file t is in degC, s in PSU, z in m and p in the unit of each equation: those of the papers, so that each
// constant can be checked.

constexpr double kBarPerMegapascal = 10;
constexpr double kKilogramsPerCm2PerMegapascal = 10.197162129779;  // 1 kgf = 9.80665 N.

// Polynomial by Horner's rule; the constant is the first coefficient.
template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
  double sum = 0;
  for (std::size_t i = N; i-- > 0;) {
    sum = sum * x + coefficients[i];
  }
  return sum;
}

void check_bent_path(double sound_speed, double gradient, double launch_angle, double distance) {
  constexpr double kRightAngle = std::numbers::pi / 2;
  check_argument("bent_path", "sound_speed", "m/s", greater_than(0), sound_speed);
  check_argument("bent_path", "gradient", "1/s", any_number(), gradient);
  check_argument("bent_path", "launch_angle", "rad",
                 {.least = -kRightAngle, .most = kRightAngle, .least_allowed = false, .most_allowed = false},
                 launch_angle);
  check_argument("bent_path", "distance", "m", at_least(0), distance);
  if (gradient == 0) {
    throw Error("bent_path.gradient = 0 1/s must not be 0: the path is straight");
  }
}

}  // namespace

double pressure_mpa(double depth, double latitude) {
  const double z = depth;
  const double at_45_degrees = polynomial(std::array{0.0, 1.00818e-2, 2.465e-8, -1.25e-13, 2.8e-19}, z);
  const double gravity = 9.7803 * (1 + 5.3e-3 * std::pow(std::sin(latitude), 2));
  const double of_latitude = (gravity - 2e-5 * z) / (9.80612 - 2e-5 * z);
  const double of_common_oceans = 1e-2 * z / (z + 100) + 6.2e-6 * z;
  return at_45_degrees * of_latitude - of_common_oceans;
}

double chen_millero_sound_speed(double temperature_c, double salinity, double depth, double latitude) {
  const double t = temperature_c;
  const double s = salinity;
  const double p = kBarPerMegapascal * pressure_mpa(depth, latitude);
  const double pure_water = polynomial(
      std::array{
          polynomial(std::array{1402.388, 5.03830, -5.81090e-2, 3.3432e-4, -1.47797e-6, 3.1419e-9}, t),
          polynomial(std::array{0.153563, 6.8999e-4, -8.1829e-6, 1.3632e-7, -6.1260e-10}, t),
          polynomial(std::array{3.1260e-5, -1.7111e-6, 2.5986e-8, -2.5353e-10, 1.0415e-12}, t),
          polynomial(std::array{-9.7729e-9, 3.8513e-10, -2.3654e-12}, t),
      },
      p);
  const double a = polynomial(
      std::array{
          polynomial(std::array{1.389, -1.262e-2, 7.166e-5, 2.008e-6, -3.21e-8}, t),
          polynomial(std::array{9.4742e-5, -1.2583e-5, -6.4928e-8, 1.0515e-8, -2.0142e-10}, t),
          polynomial(std::array{-3.9064e-7, 9.1061e-9, -1.6009e-10, 7.994e-12}, t),
          polynomial(std::array{1.100e-10, 6.651e-12, -3.391e-13}, t),
      },
      p);
  const double b = -1.922e-2 - 4.42e-5 * t + (7.3637e-5 + 1.7950e-7 * t) * p;
  const double d = 1.727e-3 - 7.9836e-6 * p;
  return pure_water + a * s + b * s * std::sqrt(s) + d * s * s;
}

double del_grosso_sound_speed(double temperature_c, double salinity, double depth, double latitude) {
  const double t = temperature_c;
  const double s = salinity;
  const double p = kKilogramsPerCm2PerMegapascal * pressure_mpa(depth, latitude);
  const double of_temperature = polynomial(std::array{0.0, 5.012285, -5.51184e-2, 2.21649e-4}, t);
  const double of_salinity = polynomial(std::array{0.0, 1.329530, 1.288598e-4}, s);
  const double of_pressure = polynomial(std::array{0.0, 0.1560592, 2.449993e-5, -8.833959e-9}, p);
  const double of_pairs = -1.275936e-2 * t * s + 6.353509e-3 * t * p + 2.656174e-8 * t * t * p * p -
                          1.593895e-6 * t * p * p + 5.222483e-10 * t * p * p * p - 4.383615e-7 * t * t * t * p -
                          1.616745e-9 * s * s * p * p + 9.688441e-5 * s * t * t + 4.857614e-6 * s * s * t * p -
                          3.406824e-4 * s * t * p;
  return 1402.392 + of_temperature + of_salinity + of_pressure + of_pairs;
}

double mackenzie_sound_speed(double temperature_c, double salinity, double depth) {
  const double t = temperature_c;
  const double z = depth;
  return polynomial(std::array{1448.96, 4.591, -5.304e-2, 2.374e-4}, t) + 1.340 * (salinity - 35) + 1.630e-2 * z +
         1.675e-7 * z * z - 1.025e-2 * t * (salinity - 35) - 7.139e-13 * t * z * z * z;
}

double medwin_sound_speed(double temperature_c, double salinity, double depth) {
  const double t = temperature_c;
  return polynomial(std::array{1449.2, 4.6, -0.055, 2.9e-4}, t) + (1.34 - 0.010 * t) * (salinity - 35) + 0.016 * depth;
}

double leroy_sound_speed(double temperature_c, double salinity, double depth, double latitude) {
  const double t = temperature_c;
  const double s = salinity;
  const double z = depth;
  const double latitude_deg = degrees_from_radians(latitude);
  return polynomial(std::array{1402.5, 5.0, -5.44e-2, 2.1e-4}, t) + 1.33 * s - 1.23e-2 * s * t + 8.7e-5 * s * t * t +
         polynomial(std::array{0.0, 1.56e-2, 2.55e-7, -7.3e-12}, z) + 1.2e-6 * z * (latitude_deg - 45) -
         9.5e-13 * t * z * z * z + 3e-7 * t * t * z + 1.43e-5 * s * z;
}

// By Snell's law cos(angle)/c is constant. With c linear in depth the path is an arc of a circle, along which
// sin(angle) falls linearly with horizontal distance. The chord of an arc is inclined at the mean of the angles at its
// ends; this gives the drop without subtracting two nearly equal cosines.
BentPath bent_path(double sound_speed, double gradient, double launch_angle, double distance) {
  check_bent_path(sound_speed, gradient, launch_angle, distance);
  const double radius = sound_speed / (gradient * std::cos(launch_angle));
  const double launch_sine = std::sin(launch_angle);
  const double sine = launch_sine - distance / radius;
  if (std::abs(sine) >= 1) {
    throw Error(fmt::format("bent_path.distance = {:.10g} m must be less than {:.10g} m, where the path stands upright",
                            distance, std::abs(radius) + radius * launch_sine));
  }
  const double angle = std::asin(sine);
  const double drop = distance * std::tan((launch_angle + angle) / 2);
  const double time = std::atanh((distance / radius) / (1 - launch_sine * sine)) / gradient;
  return {radius, drop, angle, time};
}

}  // namespace insonify
