// surface_scattering.cpp -- scattering by the sea surface after APL-UW TR 9407, and after Chapman and Harris.

#include "insonify/acoustics/surface_scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "acoustics/formula.h"
#include "insonify/acoustics/backscatter.h"
#include "insonify/geometry.h"

namespace insonify {
namespace {

// Inside this file frequencies are in kHz, as in TR 9407; the names f and u stand for frequency and wind speed, q for
// the grazing angle [rad].

constexpr double kHighest = 100;  // Highest frequency of the report's fit [kHz].
constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600;

void check(std::string_view function, double grazing, double frequency, double wind_speed) {
  check_argument(function, "grazing", "rad", above_to(0, kPi / 2), grazing);
  check_argument(function, "frequency", "Hz", at_least(10e3), frequency);
  check_argument(function, "wind_speed", "m/s", from_to(0, 30), wind_speed);
}

double clamped_kilohertz(double frequency) {
  return std::min(frequency / kHertzPerKilohertz, kHighest);
}

double bubble_loss_db(double q, double f, double u) {
  const double of_wind = u >= 6 ? std::pow(u, 1.57) : std::pow(6, 1.57) * std::exp(1.2 * (u - 6));
  return 1.26e-3 / std::sin(q) * of_wind * std::pow(f, 0.85);
}

// Backscatter of the bubbles, insonified from below and by the surface above them.
double bubble_backscatter(double q, double f, double u) {
  constexpr double kRadiationDamping = 0.0136;
  const double damping = 0.0255 * std::cbrt(f);
  const double of_storm = u >= 11 ? std::pow(u / 11, 3.5) : 1;
  const double depth = std::pow(10, -5.2577 + 0.4701 * std::min(u, 11.0)) * std::pow(f / 25, 0.85) * of_storm;
  const double b = depth / std::sin(q);  // Optical depth along the path.
  const double paths = (8 * b * std::exp(-2 * b) - std::expm1(-4 * b)) / (2 * b);
  return depth / (4 * kPi) * kRadiationDamping / damping * paths;
}

// Mean square slope of the waves, both axes together.
double square_slope(double u) {
  return u >= 1 ? 4.6e-3 * std::log(2.1 * u * u) : 0.0034;
}

double ripple_backscatter(double q, double u) {
  return q <= radians_from_degrees(85) ? 1.3e-5 * u * u * std::pow(std::tan(q), 4) : 0;
}

// Grazing angle at which the lobe of facets, sec^4 exp(-tan^2/s2), has fallen by 15 dB. With t the squared tangent of
// incidence, t = s2 (1.5 ln 10 + 2 ln(1 + t)); this is solved by fixed-point iteration, which converges because s2 is
// small.
double facet_edge(double s2) {
  double t = 0;
  for (int round = 0; round < 30; ++round) {
    t = s2 * (1.5 * std::numbers::ln10 + 2 * std::log1p(t));
  }
  return kPi / 2 - std::atan(std::sqrt(t));
}

// The rough surface without bubbles: facets near vertical incidence, ripples at lower grazing angles, blended.
struct Interface {
  double facets, ripples;
};
Interface interface_backscatter(double q, double u) {
  const double s2 = square_slope(u);
  const double facets = facet_backscatter(1, std::sqrt(s2 / 2), kPi / 2 - q);
  const double share = 1 / (1 + std::exp(0.524 * degrees_from_radians(facet_edge(s2) - q)));
  return {share * facets, (1 - share) * ripple_backscatter(q, u)};
}

}  // namespace

double sea_surface_backscatter(double grazing, double frequency, double wind_speed) {
  check("sea_surface_backscatter", grazing, frequency, wind_speed);
  const double f = clamped_kilohertz(frequency);
  const Interface interface = interface_backscatter(grazing, wind_speed);
  return (interface.facets + interface.ripples) * std::pow(10, -bubble_loss_db(grazing, f, wind_speed) / 10) +
         bubble_backscatter(grazing, f, wind_speed);
}

double sea_surface_diffuse_backscatter(double grazing, double frequency, double wind_speed) {
  check("sea_surface_diffuse_backscatter", grazing, frequency, wind_speed);
  const double f = clamped_kilohertz(frequency);
  const double ripples = interface_backscatter(grazing, wind_speed).ripples;
  return ripples * std::pow(10, -bubble_loss_db(grazing, f, wind_speed) / 10) +
         bubble_backscatter(grazing, f, wind_speed);
}

double surface_bubble_loss_db(double grazing, double frequency, double wind_speed) {
  check("surface_bubble_loss_db", grazing, frequency, wind_speed);
  return bubble_loss_db(grazing, clamped_kilohertz(frequency), wind_speed);
}

double sea_surface_reflection(double grazing, double frequency, double wind_speed) {
  check("sea_surface_reflection", grazing, frequency, wind_speed);
  return std::pow(10, -bubble_loss_db(grazing, clamped_kilohertz(frequency), wind_speed) / 20);
}

double coherent_reflection(double rms_height, double wavelength, double grazing) {
  check_argument("coherent_reflection", "rms_height", "m", at_least(0), rms_height);
  check_argument("coherent_reflection", "wavelength", "m", greater_than(0), wavelength);
  check_argument("coherent_reflection", "grazing", "rad", from_to(0, kPi / 2), grazing);
  const double roughness = 2 * kPi / wavelength * rms_height * std::sin(grazing);
  return std::exp(-2 * roughness * roughness);
}

double chapman_harris_db(double grazing, double frequency, double wind_speed) {
  check_argument("chapman_harris_db", "grazing", "rad", above_to(0, kPi / 2), grazing);
  check_argument("chapman_harris_db", "frequency", "Hz", from_to(400, 6400), frequency);
  check_argument("chapman_harris_db", "wind_speed", "m/s", greater_than(0), wind_speed);
  const double knots = wind_speed / kMetresPerSecondPerKnot;
  const double b = 158 * std::pow(knots * std::cbrt(frequency), -0.58);
  return 3.3 * b * std::log10(degrees_from_radians(grazing) / 30) - 42.4 * std::log10(b) + 2.6;
}

}  // namespace insonify
