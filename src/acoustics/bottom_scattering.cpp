// bottom_scattering.cpp -- the six-parameter model of bottom backscatter of APL-UW TR 9407, section IV.C.

#include "insonify/acoustics/bottom_scattering.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>

#include "acoustics/formula.h"
#include "acoustics/power_law_relief.h"
#include "base/square.h"
#include "insonify/geometry.h"

namespace insonify {
namespace {

// Inside this file lengths are in cm, as in the report's roughness spectrum: W(K) = w2 K^-gamma, K in 1/cm, W in cm^4.
// Angles are grazing angles.

constexpr double kCentimetresPerMetre = 100;

// A bottom at one acoustic wavelength, with the quantities that do not depend on the angle.
struct Bottom {
  const Sediment& sediment;
  double wavenumber;  // k [1/cm]
  PowerLawRelief relief = {sediment.spectral_strength, sediment.spectral_exponent, wavenumber};
  double normal_reflection = std::norm(sediment.reflection(kPi / 2));  // |R|^2 at normal incidence.

  // kappa, the bottom's wavenumber over the water's; and P = sqrt(kappa^2 - cos^2), eq 32.
  [[nodiscard]] std::complex<double> wavenumber_ratio() const {
    return std::complex<double>{1, sediment.loss} / sediment.sound_speed_ratio;
  }
  [[nodiscard]] std::complex<double> sine_below(double grazing) const {
    const std::complex<double> kappa = wavenumber_ratio();
    return std::sqrt(kappa * kappa - square(std::cos(grazing)));
  }
};

// ------------------------------------------------------------------------------------------------ Relief

// Eqs 43 to 45: the fraction of the bottom that is not shadowed by its own roughness.
double unshadowed(const Bottom& bottom, double grazing) {
  const double t = std::tan(grazing) / bottom.relief.rms_slope;
  if (t > 2) {
    return 1;
  }
  const double q = (std::exp(-t * t) * std::numbers::inv_sqrtpi - t * std::erfc(t)) / (4 * t);
  return -std::expm1(-2 * q) / (2 * q);
}

// Eqs 46 to 49: average of a cross section over the large-scale slopes of the bottom, by three-point Gauss-Hermite
// quadrature.
template <typename CrossSection>
double slope_mean(const Bottom& bottom, double grazing, const CrossSection& cross_section) {
  const double tilt = std::sqrt(1.5) * bottom.relief.rms_slope;
  const auto at = [&](double angle) { return cross_section(std::clamp(angle, 0.0, kPi / 2)); };
  return at(grazing - tilt) / 6 + at(grazing) * 2 / 3 + at(grazing + tilt) / 6;
}

// Eqs 50 to 52: perturbation theory for roughness much smaller than the wavelength. The term 0.01 under the root keeps
// the Bragg wavenumber above k/10 at vertical incidence.
double small_relief(const Bottom& bottom, double grazing) {
  const double k = bottom.wavenumber;
  const double rho = bottom.sediment.density_ratio;
  const double cosine = std::cos(grazing);
  const double sine = std::sin(grazing);
  const std::complex<double> kappa = bottom.wavenumber_ratio();
  const std::complex<double> contrast = (square(rho - 1) * square(cosine) + square(rho) - kappa * kappa) /
                                        std::pow(rho * sine + bottom.sine_below(grazing), 2);
  const double bragg = k * std::sqrt(4 * square(cosine) + 0.01);
  const double spectrum = bottom.sediment.spectral_strength * std::pow(bragg, -bottom.sediment.spectral_exponent);
  return 4 * std::pow(k * sine, 4) * std::norm(contrast) * spectrum;
}

// ------------------------------------------------------------------------------------------------ Rock and gravel

// Eqs 53 to 56: empirical fit to measurements on rock and gravel; angles in degrees.
double large_relief(const Bottom& bottom, double grazing) {
  constexpr double kSlowBottomCritical = 2.5613;
  const double s = bottom.relief.rms_slope;
  const double rho = bottom.sediment.density_ratio;
  const double nu = bottom.sediment.sound_speed_ratio;
  const double slope_deg = degrees_from_radians(s);
  const double grazing_deg = degrees_from_radians(grazing);
  const double critical_deg = nu >= 1.001 ? degrees_from_radians(std::acos(1 / nu)) : kSlowBottomCritical;
  const double below_critical = 1 + 0.81 * square(critical_deg / grazing_deg);
  const double side = 0.04682 * std::pow(s, 1.25) * std::pow(nu, 3.25) * square((1 - 2 / rho) / square(nu) + 1) /
                      (1 + 3.54 * slope_deg / critical_deg);
  const double off_vertical = square(grazing_deg - 90) / (2.6 * square(slope_deg));
  const double top = 0.0260 * bottom.normal_reflection / (s * s * std::pow(1 + off_vertical, 1.9));
  return side * std::pow(std::sin(kPi / below_critical), 0.7263 / std::cbrt(s)) + top / below_critical;
}

// ------------------------------------------------------------------------------------------------ Roughness and volume

// Eq 57: a smooth step from 1 for x << 0 to 0 for x >> 0.
double blend(double x) {
  return 1 / (1 + std::exp(std::clamp(x, -40.0, 40.0)));
}

// Eqs 58 to 64: total roughness scattering. Perturbation theory is blended into the Kirchhoff approximation at the
// angle where the Kirchhoff lobe has fallen by 15 dB; both are blended into the empirical fit where the rms slope
// reaches 7 degrees. (The report omits the Kirchhoff term below 40 degrees, eq 37, where it is negligible.)
double relief(const Bottom& bottom, double grazing) {
  const double alpha = bottom.relief.alpha;
  const double c = std::pow(1000, 1 / (1 + alpha)) *
                   std::pow(bottom.relief.kirchhoff_a * square(bottom.relief.kirchhoff_q), 1 / alpha);
  const double edge_cosine = std::pow(1 / c + 4, -0.25);
  const double steep = blend((std::cos(grazing) - edge_cosine) / 0.0125);
  const double gentle = blend((degrees_from_radians(std::atan(bottom.relief.rms_slope)) - 7) / 0.5);
  const double small = unshadowed(bottom, grazing) *
                       slope_mean(bottom, grazing, [&](double angle) { return small_relief(bottom, angle); });
  const double moderate =
      steep * bottom.normal_reflection * bottom.relief.kirchhoff_backscatter(grazing) + (1 - steep) * small;
  return gentle * moderate + (1 - gentle) * large_relief(bottom, grazing);
}

// Eqs 65 and 66: scattering from inside the sediment, with transmission through the interface both ways.
double volume_under(const Bottom& bottom, double grazing) {
  if (grazing == 0) {
    return 0;
  }
  const Sediment& sediment = bottom.sediment;
  const std::complex<double> sine_below = bottom.sine_below(grazing);
  const std::complex<double> reflection = sediment.reflection(grazing);
  return 5 * sediment.loss * sediment.volume_parameter * std::norm(1.0 - reflection * reflection) *
         square(std::sin(grazing)) /
         (sediment.sound_speed_ratio * std::numbers::ln10 * std::norm(sine_below) * sine_below.imag());
}

double volume(const Bottom& bottom, double grazing) {
  return unshadowed(bottom, grazing) *
         slope_mean(bottom, grazing, [&](double angle) { return volume_under(bottom, angle); });
}

}  // namespace

double bottom_backscatter(const Sediment& sediment, double grazing, double frequency, double sound_speed) {
  constexpr std::string_view kName = "bottom_backscatter";
  check_argument(kName, "sediment.loss", "", greater_than(0), sediment.loss);
  check_argument(kName, "sediment.spectral_strength", "cm^4", greater_than(0), sediment.spectral_strength);
  check_argument(kName, "sediment.spectral_exponent", "", from_to(2.4, 3.9), sediment.spectral_exponent);
  check_argument(kName, "grazing", "rad", from_to(radians_from_degrees(0.001), kPi / 2), grazing);
  check_argument(kName, "frequency", "Hz", from_to(10e3, 100e3), frequency);
  check_argument(kName, "sound_speed", "m/s", from_to(1400, 1600), sound_speed);
  const Bottom bottom{sediment, 2 * kPi * frequency / (sound_speed * kCentimetresPerMetre)};
  return relief(bottom, grazing) + volume(bottom, grazing);
}

}  // namespace insonify
