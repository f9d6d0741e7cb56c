// sonar_equation.cpp -- the sonar equation, and closed forms of the echo of a floor, a wall and the water.

#include "insonify/acoustics/sonar_equation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "acoustics/formula.h"
#include "base/square.h"
#include "insonify/acoustics/absorption.h"
#include "insonify/error.h"

namespace insonify {
namespace {

void check_bin(std::string_view function, double start, double end) {
  check_argument(function, "bin_start", "m", greater_than(0), start);
  check_argument(function, "bin_end", "m", greater_than(0), end);
  if (end <= start) {
    throw Error(fmt::format("{}.bin_end = {:.10g} m must be greater than bin_start = {:.10g} m", function, end, start));
  }
}

void check_beam(std::string_view function, double azimuth_width, double elevation_width) {
  check_argument(function, "azimuth_width", "rad", above_to(0, 2 * kPi), azimuth_width);
  check_argument(function, "elevation_width", "rad", above_to(0, kPi), elevation_width);
}

double sector_solid_angle(double azimuth_width, double elevation_width) {
  return azimuth_width * 2 * std::sin(elevation_width / 2);
}

// Eight-point Gauss-Legendre quadrature: Abramowitz and Stegun, Handbook of Mathematical Functions (1964), table 25.4.
template <typename Function>
double gauss_legendre(const Function& f, double from, double to) {
  constexpr std::array kNodes = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr std::array kWeights = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  const double middle = (from + to) / 2;
  const double half = (to - from) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    sum += kWeights[i] * (f(middle - half * kNodes[i]) + f(middle + half * kNodes[i]));
  }
  return sum * half;
}

// Integral of r^-power 10^(-alpha r/5) over a bin: two-way spreading and absorption, together with the growth of the
// insonified area or volume with range. With absorption it is integrated over panels so short that eight-point
// quadrature is exact to rounding.
double spread_integral(int power, double absorption_db_per_m, double from, double to) {
  if (absorption_db_per_m == 0) {
    return (std::pow(from, 1 - power) - std::pow(to, 1 - power)) / (power - 1);
  }
  const double decay = 4 * kNeperPerDecibel * absorption_db_per_m;  // Two-way decay of intensity [1/m].
  const auto integrand = [&](double r) { return std::pow(r, -power) * std::exp(-decay * r); };
  const double last = std::min(to, from + 40 / decay);  // Beyond, the integrand is below exp(-40) of its start.
  constexpr double kPanelRatio = 0.2;                   // Greatest logarithm of end / start of a panel.
  const double growth = std::log(last / from);
  const int panels = static_cast<int>(std::ceil(std::max(growth / kPanelRatio, decay * (last - from))));
  double sum = 0;
  double start = from;
  for (int i = 1; i <= panels; ++i) {
    const double end = from * std::exp(growth * i / panels);
    sum += gauss_legendre(integrand, start, end);
    start = end;
  }
  return sum;
}

// The integral of cos^4 from -width/2 to width/2.
double cosine_fourth_integral(double width) {
  return 3 * width / 8 + std::sin(width) / 2 + std::sin(2 * width) / 16;
}

}  // namespace

// ---------------------------------------------------------------------------------------------------- Sonar equation

double transmission_loss_db(double range, double absorption_db_per_m) {
  check_argument("transmission_loss_db", "range", "m", greater_than(0), range);
  check_argument("transmission_loss_db", "absorption_db_per_m", "dB/m", at_least(0), absorption_db_per_m);
  return 20 * std::log10(range) + absorption_db_per_m * range;
}

double echo_level_db(double source_level_db, double one_way_loss_db, double target_db) {
  return source_level_db - 2 * one_way_loss_db + target_db;
}

double thermal_noise_level_db(double frequency) {
  check_argument("thermal_noise_level_db", "frequency", "Hz", greater_than(0), frequency);
  return -15 + 20 * std::log10(frequency / kHertzPerKilohertz);
}

double wind_noise_level_db(double frequency, double wind_speed) {
  check_argument("wind_noise_level_db", "frequency", "Hz", greater_than(0), frequency);
  check_argument("wind_noise_level_db", "wind_speed", "m/s", at_least(0), wind_speed);
  const double f = frequency / kHertzPerKilohertz;
  return 50 + 7.5 * std::sqrt(wind_speed) + 20 * std::log10(f) - 40 * std::log10(f + 0.4);
}

double ship_noise_level_db(double frequency, double shipping) {
  check_argument("ship_noise_level_db", "frequency", "Hz", greater_than(0), frequency);
  check_argument("ship_noise_level_db", "shipping", "", from_to(0, 1), shipping);
  const double f = frequency / kHertzPerKilohertz;
  return 40 + 20 * (shipping - 0.5) + 26 * std::log10(f) - 60 * std::log10(f + 0.03);
}

double rain_noise_level_db(double frequency, double rain) {
  check_argument("rain_noise_level_db", "frequency", "Hz", greater_than(0), frequency);
  check_argument("rain_noise_level_db", "rain", "mm/h", greater_than(0), rain);
  constexpr double kFlatTo = 10e3;  // [Hz]
  return 42.4 + 15.4 * std::log10(rain) - 20 * std::log10(std::max(1.0, frequency / kFlatTo));
}

double sector_directivity_index_db(double azimuth_width, double elevation_width) {
  check_beam("sector_directivity_index_db", azimuth_width, elevation_width);
  return 10 * std::log10(4 * kPi / sector_solid_angle(azimuth_width, elevation_width));
}

double noise_level_db(double spectral_level_db, double bandwidth, double directivity_index_db) {
  check_argument("noise_level_db", "bandwidth", "Hz", greater_than(0), bandwidth);
  return spectral_level_db + 10 * std::log10(bandwidth) - directivity_index_db;
}

// ---------------------------------------------------------------------------------------------------- Simple scenes

// At range r the grazing angle is sin(grazing) = h/r, and the floor between r and r + dr has exactly the area r dr
// width. Its echo is mu (h/r)^2 r dr width/r^4.
double lambert_floor_intensity(double mu, double altitude, double azimuth_width, double bin_start, double bin_end,
                               double absorption_db_per_m) {
  constexpr std::string_view kName = "lambert_floor_intensity";
  check_argument(kName, "mu", "", at_least(0), mu);
  check_argument(kName, "altitude", "m", greater_than(0), altitude);
  check_argument(kName, "azimuth_width", "rad", above_to(0, 2 * kPi), azimuth_width);
  check_argument(kName, "absorption_db_per_m", "dB/m", at_least(0), absorption_db_per_m);
  check_bin(kName, bin_start, bin_end);
  const double start = std::max(bin_start, altitude);
  if (bin_end <= start) {
    return 0;
  }
  return mu * square(altitude) * azimuth_width * spread_integral(5, absorption_db_per_m, start, bin_end);
}

// In the direction (azimuth, elevation) both the cosine of incidence and d/r are cos(azimuth) cos(elevation), and the
// solid angle dOmega = cos(elevation) d(elevation) d(azimuth) covers the area r^2 dOmega/cos(incidence) of the wall.
double lambert_wall_intensity(double mu, double distance, double azimuth, double azimuth_width,
                              double elevation_width) {
  constexpr std::string_view kName = "lambert_wall_intensity";
  check_argument(kName, "mu", "", at_least(0), mu);
  check_argument(kName, "distance", "m", greater_than(0), distance);
  check_argument(kName, "azimuth", "rad", from_to(-kPi / 2, kPi / 2), azimuth);
  check_beam(kName, azimuth_width, elevation_width);
  return mu * azimuth_width / square(distance) * std::pow(std::cos(azimuth), 3) *
         cosine_fourth_integral(elevation_width);
}

double volume_reverberation_intensity(double volume_backscatter, double azimuth_width, double elevation_width,
                                      double bin_start, double bin_end, double absorption_db_per_m) {
  constexpr std::string_view kName = "volume_reverberation_intensity";
  check_argument(kName, "volume_backscatter", "1/m", at_least(0), volume_backscatter);
  check_beam(kName, azimuth_width, elevation_width);
  check_argument(kName, "absorption_db_per_m", "dB/m", at_least(0), absorption_db_per_m);
  check_bin(kName, bin_start, bin_end);
  return volume_backscatter * sector_solid_angle(azimuth_width, elevation_width) *
         spread_integral(2, absorption_db_per_m, bin_start, bin_end);
}

}  // namespace insonify
