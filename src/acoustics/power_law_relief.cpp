// power_law_relief.cpp -- rms slope and Kirchhoff backscatter of a surface with a power-law roughness spectrum.

#include "acoustics/power_law_relief.h"

#include <cmath>

#include "acoustics/formula.h"

namespace insonify {
namespace {

double structure_of(double strength, double alpha) {
  return 2 * kPi * strength * std::tgamma(2 - alpha) * std::pow(2, -2 * alpha) /
         (alpha * (1 - alpha) * std::tgamma(1 + alpha));
}

double rms_slope_of(double strength, double alpha, double k) {
  const double square =
      std::pow(2 * kPi * strength, 1 / alpha) / (2 * (1 - alpha)) * std::pow(k * k / alpha, (1 - alpha) / alpha);
  return std::sqrt(square);
}

double kirchhoff_a_of(double alpha) {
  const double half = 1 / (2 * alpha);
  const double ratio =
      8 * alpha * alpha * std::tgamma(half + 0.5) / (std::tgamma(0.5) * std::tgamma(1 / alpha) * std::tgamma(half));
  return std::pow(ratio, 2 * alpha);
}

}  // namespace

PowerLawRelief::PowerLawRelief(double strength, double exponent, double wavenumber)
    : alpha(exponent / 2 - 1),
      structure(structure_of(strength, alpha)),
      rms_slope(rms_slope_of(strength, alpha, wavenumber)),
      kirchhoff_a(kirchhoff_a_of(alpha)),
      kirchhoff_q(structure * std::pow(2, 1 - 2 * alpha) * std::pow(wavenumber, 2 * (1 - alpha))) {}

// The exponent of a in b is read as 1/2 + 1/(2 alpha): with that, the closed form equals the Kirchhoff integral at
// vertical incidence, conserves the reflected energy, and reproduces the report's own table. It has also been read as
// 1/2 - 1/(2 alpha), which gives values below the table by a^(1/alpha), 3.6 dB at gamma = 3.25.
double PowerLawRelief::kirchhoff_backscatter(double grazing) const {
  const double b = std::pow(kirchhoff_a, 0.5 + 1 / (2 * alpha)) * std::tgamma(1 / alpha) / (2 * alpha);
  const double aq2 = kirchhoff_a * kirchhoff_q * kirchhoff_q;
  const double spread = std::pow(std::cos(grazing), 4 * alpha) + aq2 * std::pow(std::sin(grazing), 4);
  return b * kirchhoff_q / (8 * kPi * std::pow(spread, (1 + alpha) / (2 * alpha)));
}

}  // namespace insonify
