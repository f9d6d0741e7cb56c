// power_law_relief_test.cpp -- the closed form of Kirchhoff backscatter against the Kirchhoff integral, and its limits.

#include "acoustics/power_law_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "support/relative.h"

namespace insonify::power_law_relief_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStrength = 0.003;
constexpr double kWavenumber = 1.3;

// Straight down a height z delays the echo by 2 k z, so that points a distance r apart interfere by
// exp(-2 k^2 C^2 r^(2 alpha)) in the mean:
//
//     sigma = k^2/(2 pi) Int r exp(-2 k^2 C^2 r^(2 alpha)) dr
//           = k^2/(2 pi) Gamma(1/alpha)/(2 alpha) (2 k^2 C^2)^(-1/alpha)
TEST(KirchhoffTest, IsTheIntegralStraightDown) {
  for (const double gamma : {2.4, 3.0, 3.25, 3.9}) {
    const PowerLawRelief relief(kStrength, gamma, kWavenumber);
    const double alpha = gamma / 2 - 1;
    const double integral = kWavenumber * kWavenumber / (2 * kPi) * std::tgamma(1 / alpha) / (2 * alpha) *
                            std::pow(2 * kWavenumber * kWavenumber * relief.structure, -1 / alpha);
    EXPECT_THAT(relief.kirchhoff_backscatter(kPi / 2), RelativelyNear(integral)) << "for gamma = " << gamma;
  }
}

// A large plate, seen from straight above, sends back the mirror's echo |R|^2/4 (backscatter_test.cpp): the integral of
// sigma 2 pi x dx over x = cos(grazing). Relief so low that its lobe ends far within the angles taken, but for tails
// that fall as x^(-2 - 2 alpha).
TEST(KirchhoffTest, ConservesTheReflectedEnergy) {
  for (const double gamma : {3.0, 3.25, 3.9}) {
    const PowerLawRelief relief(1e-9, gamma, kWavenumber);
    double sum = 0;
    constexpr int kSteps = 20000;
    const double from = std::log(1e-12);
    const double to = std::log(0.5);
    for (int i = 0; i < kSteps; ++i) {
      const double x = std::exp(from + (to - from) * (i + 0.5) / kSteps);
      sum += relief.kirchhoff_backscatter(std::acos(x)) * 2 * kPi * x * x * (to - from) / kSteps;
    }
    EXPECT_NEAR(sum, 0.25, 1e-4) << "for gamma = " << gamma;
  }
}

// The structure function from the spectrum: C^2 r^(2 alpha) = 2 Int W(K) (1 - J0(K r)) 2 pi K dK.
TEST(PowerLawReliefTest, HeightsDifferAsTheSpectrumSays) {
  const PowerLawRelief relief(kStrength, 3.25, kWavenumber);
  for (const double r : {0.5, 2.0}) {
    double sum = 0;
    constexpr int kSteps = 400000;
    const double from = std::log(1e-9 / r);
    const double to = std::log(1e3 / r);
    for (int i = 0; i < kSteps; ++i) {
      const double wavenumber = std::exp(from + (to - from) * (i + 0.5) / kSteps);
      const double spectrum = kStrength * std::pow(wavenumber, -3.25);
      const double x = wavenumber * r;
      const double one_less_bessel = x < 1e-3 ? x * x / 4 : 1 - std::cyl_bessel_j(0, x);
      sum += 2 * spectrum * one_less_bessel * 2 * kPi * wavenumber * wavenumber * (to - from) / kSteps;
    }
    // What is left out at either end: below 1e-9 some 1e-7, above 1e3 some 1e-4.
    EXPECT_NEAR(sum / (relief.structure * std::pow(r, 1.25)), 1, 5e-4) << "over " << r;
  }
}

// The report's slope is that of a chord as long as heights need to change the phase of the wave; it grows with the
// wavenumber as k^((1 - alpha)/alpha).
TEST(PowerLawReliefTest, ShorterWavesSeeSteeperSlopes) {
  const double slope = PowerLawRelief(kStrength, 3.25, 1).rms_slope;
  EXPECT_THAT(PowerLawRelief(kStrength, 3.25, 4).rms_slope, RelativelyNear(slope * std::pow(4, 0.375 / 0.625)));
}

// Inches or centimetres: a ratio has no unit. w2 is a length^4 in a spectrum over length^-gamma, thus length^(4 -
// gamma).
TEST(PowerLawReliefTest, DoesNotDependOnTheUnitOfLength) {
  const double scale = 2.54;
  const PowerLawRelief centimetres(kStrength, 3.25, kWavenumber);
  const PowerLawRelief inches(kStrength * std::pow(scale, -(4 - 3.25)), 3.25, kWavenumber * scale);
  EXPECT_THAT(inches.rms_slope, RelativelyNear(centimetres.rms_slope));
  EXPECT_THAT(inches.kirchhoff_backscatter(1.2), RelativelyNear(centimetres.kirchhoff_backscatter(1.2)));
}

}  // namespace
}  // namespace insonify::power_law_relief_test
