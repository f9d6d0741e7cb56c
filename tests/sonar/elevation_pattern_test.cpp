// elevation_pattern_test.cpp -- width, sector and envelope of elevation patterns.

#include "sonar/elevation_pattern.h"

#include <gtest/gtest.h>

#include <complex>
#include <random>

#include "receiver/array/line_array.h"

namespace insonify::elevation_pattern_test {
namespace {

constexpr double kDegree = radians_from_degrees(1);

// Tolerance of interpolation in a table.
constexpr double kTable = 1e-5;

SonarConfig sonar_of(double aperture_deg, double center_deg) {
  SonarConfig sonar;
  sonar.elevation_aperture = aperture_deg * kDegree;
  sonar.elevation_center = center_deg * kDegree;
  return sonar;
}

ElevationPattern pattern_of(const SonarConfig& sonar, BeamPattern window = BeamPattern::kRectangular,
                            double side_lobe_db = -30) {
  return {line_array(window, side_lobe_db, sonar.elevation_aperture), sonar.elevation_aperture, sonar.elevation_center};
}

TEST(ElevationPatternTest, IsAsWideAtHalfPowerAsTheAperture) {
  for (const double aperture : {1.0, 12.0, 20.0, 40.0}) {
    for (const double center : {0.0, -10.0, 25.0}) {
      for (int window = 1; window <= static_cast<int>(BeamPattern::kDolphChebyshev); ++window) {
        const SonarConfig sonar = sonar_of(aperture, center);
        const ElevationPattern pattern = pattern_of(sonar, static_cast<BeamPattern>(window));
        EXPECT_NEAR(pattern.intensity(center * kDegree), 1, kTable) << aperture << ", " << window;
        for (const double half : {-0.5, 0.5}) {
          EXPECT_NEAR(pattern.intensity((center + half * aperture) * kDegree), 0.5, kTable)
              << aperture << ", " << window;
        }
      }
    }
  }
}

// sinc^2 of x = L/lambda sin(elevation); for 20 degrees L/lambda = 0.8858929413781328 / (2 sin 10 deg) = 2.550827.
TEST(ElevationPatternTest, WithoutAWindowIsASincInTheSineOfElevation) {
  const ElevationPattern pattern = pattern_of(sonar_of(20, -5));
  for (const double elevation : {-60.0, -39.1, -20.0, -5.0, 1.3, 17.0, 29.1, 70.0}) {
    const double x = std::numbers::pi * 2.550827061 * std::sin((elevation + 5) * kDegree);
    EXPECT_NEAR(pattern.intensity(elevation * kDegree), x == 0 ? 1 : std::pow(std::sin(x) / x, 2), kTable) << elevation;
  }
}

// One way, |sinc(x)| last exceeds -20 dB (half of -40 dB) in its second side lobe, up to x = 2.68118.
TEST(ElevationPatternTest, EndsWhereTheTwoWayPatternStaysBelowMinusFortyDecibels) {
  const double length = 0.8858929413781328 / (2 * std::sin(4 * kDegree));
  const double edge = std::asin(2.68118 / length);
  const ElevationPattern pattern = pattern_of(sonar_of(8, -20));
  EXPECT_NEAR(pattern.low(), -20 * kDegree - edge, 0.02 / length);
  EXPECT_NEAR(pattern.high(), -20 * kDegree + edge, 0.02 / length);
  EXPECT_LE(pattern.intensity(pattern.high()), 0.01);

  // With side lobes of -31 dB or -40 dB only the main lobe is above the floor.
  const ElevationPattern hann = pattern_of(sonar_of(8, 0), BeamPattern::kHann);
  EXPECT_LT(hann.high(), 12 * kDegree);
  const ElevationPattern dolph = pattern_of(sonar_of(8, 0), BeamPattern::kDolphChebyshev, -40);
  EXPECT_LT(dolph.high(), 12 * kDegree);
  // With side lobes of -15 dB all are above the floor.
  EXPECT_EQ(pattern_of(sonar_of(8, 0), BeamPattern::kDolphChebyshev, -15).high(), kSteepestElevation);
}

TEST(ElevationPatternTest, EndsAtTheSteepestElevationAndNextToTheArray) {
  const ElevationPattern wide = pattern_of(sonar_of(60, 0));
  EXPECT_NEAR(wide.low(), -89 * kDegree, 1e-12);
  EXPECT_NEAR(wide.high(), 89 * kDegree, 1e-12);
  const ElevationPattern tilted = pattern_of(sonar_of(60, -50));
  EXPECT_NEAR(tilted.low(), -89 * kDegree, 1e-12);
  EXPECT_NEAR(tilted.high(), 40 * kDegree, 1e-12);  // 90 degrees off the axis: the array is baffled.
}

TEST(ElevationPatternTest, EnvelopeFallsFromTheAxisOutwardsAndLiesAboveThePattern) {
  const ElevationPattern pattern = pattern_of(sonar_of(12, -10));
  double before = 1;
  for (double off = 0; off < 40; off += 0.01) {
    const double up = pattern.envelope((-10 + off) * kDegree), down = pattern.envelope((-10 - off) * kDegree);
    EXPECT_NEAR(up, down, 1e-3) << off;
    EXPECT_LE(up, before + 1e-6) << off;
    EXPECT_GE(up * up, pattern.intensity((-10 + off) * kDegree) - kTable) << off;
    EXPECT_GE(up, 0.1 - 1e-6) << off;
    before = up;
  }
  EXPECT_NEAR(pattern.envelope(-10 * kDegree), 1, kTable);
}

// Arrays of eight pistons half a wavelength long, drawn at random: the mean of their power re that on the axis. Four
// wavelengths are 2 asin(0.88589 / 8) wide at half power. The mean of 20 000 exponential numbers is within 0.7 % (1
// sigma).
TEST(VerticalArrayTest, ErrorsFillNullsAsTheMeanOverArraysDoes) {
  constexpr int kParts = 8, kArrays = 20000;
  constexpr double kDb = 1.5, kPhase = 20 * kDegree;
  const double aperture = 2 * std::asin(0.8858929413781328 / 8);
  const std::array<double, 7> sines = {0, 0.05, 0.25, 0.37, 0.5, 0.75, 0.97};  // Nulls at multiples of 0.25.
  std::array<double, 7> power = {};
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (int array = 0; array < kArrays; ++array) {
    std::array<std::complex<double>, kParts> gains;
    for (auto& gain : gains) {
      const double level_db = kDb * normal(random);
      gain = std::polar(std::pow(10, level_db / 20), kPhase * normal(random));
    }
    for (std::size_t i = 0; i < sines.size(); ++i) {
      std::complex<double> sum = 0;
      for (int n = 0; n < kParts; ++n) {
        sum += gains[n] * std::polar(1.0, std::numbers::pi * sines[i] * n);
      }
      const double x = 0.5 * std::numbers::pi * sines[i], part = x == 0 ? 1 : std::sin(x) / x;
      power[i] += std::norm(sum) * part * part;
    }
  }
  const VerticalArray filled({.element_error_db = kDb, .element_error = kPhase}, aperture);
  EXPECT_NEAR(filled.length(), 4, 1e-9);
  for (std::size_t i = 0; i < sines.size(); ++i) {
    EXPECT_NEAR(filled.intensity(sines[i]) * power[0] / power[i], 1, 0.03) << sines[i];
  }
  const VerticalArray perfect({}, aperture);
  EXPECT_LT(perfect.intensity(0.25), 1e-18);
  EXPECT_GT(filled.intensity(0.25), 0.01);
}

// Errors scatter power, and phases add none: the integral over all x of the pattern without its norm is that of the
// perfect array, 1 / taper efficiency. A Hann window weighs fewer parts, which fills its nulls 1.5 times as much.
TEST(VerticalArrayTest, PhaseErrorsKeepThePowerOfAnyWindow) {
  const double phase = 0.3, aperture = 12 * kDegree, left = std::exp(-phase * phase);
  for (const auto& [window, efficiency] : {std::pair{ArrayWindow::kRectangular, 1.0}, {ArrayWindow::kHann, 2.0 / 3}}) {
    const VerticalArray perfect({.window = window}, aperture);
    const VerticalArray filled({.window = window, .element_error = phase}, aperture);
    const double parts = 2 * perfect.length();
    const double scattered = (1 - left) / (parts * efficiency);
    for (const double sine : {0.0, 0.3, 0.61, 0.9}) {
      const double x = 0.5 * std::numbers::pi * sine, part = x == 0 ? 1 : std::sin(x) / x;
      EXPECT_NEAR(filled.intensity(sine) * (left + scattered), left * perfect.intensity(sine) + scattered * part * part,
                  1e-12);
    }
    // The integral of sinc^2(x / parts) over x is the number of parts.
    EXPECT_NEAR(left / efficiency + scattered * parts, 1 / efficiency, 1e-12);
  }
}

// Where errors lift the far side lobes above half of -40 dB, the sector reaches to them.
TEST(ElevationPatternTest, ReachesTheSideLobesThatErrorsLift) {
  const ArraySettings perfect{.window = ArrayWindow::kHann};
  ArraySettings filled = perfect;
  filled.element_error = 50 * kDegree;
  EXPECT_LT(ElevationPattern(perfect, 12 * kDegree, 0).high(), 20 * kDegree);
  EXPECT_EQ(ElevationPattern(filled, 12 * kDegree, 0).high(), kSteepestElevation);
}

}  // namespace
}  // namespace insonify::elevation_pattern_test
