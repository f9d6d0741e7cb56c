// surface_scattering_test.cpp -- sea-surface scattering against independently computed values, and laws that hold for
// any constants.

#include "insonify/acoustics/surface_scattering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "insonify/geometry.h"
#include "support/message_of.h"
#include "support/relative.h"

namespace insonify::surface_scattering_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kKnot = 1852.0 / 3600;  // [m/s]

double db(double ratio) {
  return 10 * std::log10(ratio);
}

// ---------------------------------------------------------------- APL-UW TR 9407

TEST(SeaSurfaceBackscatterTest, IsThatOfTheReport) {
  const double rows[][4] = {{10, 30e3, 5, -39.3254915050119},     {20, 60e3, 8, -25.259735163393103},
                            {30, 100e3, 10, -24.910197540769513}, {10, 100e3, 10, -30.996500735151884},
                            {20, 30e3, 15, -26.283092653567106},  {10, 60e3, 13, -30.262412334617412}};
  for (const auto& [grazing_deg, frequency, wind_speed, expected_db] : rows) {
    EXPECT_THAT(db(sea_surface_backscatter(radians_from_degrees(grazing_deg), frequency, wind_speed)),
                RelativelyNear(expected_db));
  }
}

// Straight up the reference took another angle for where the facets' lobe ends: one where cos^4, not sec^4, times the
// exponential is 15 dB down. That moves the share of facets by 2e-4.
TEST(SeaSurfaceBackscatterTest, IsThatOfTheReportStraightUp) {
  constexpr double kOtherEdge = 1e-3;  // [dB]
  EXPECT_NEAR(db(sea_surface_backscatter(kPi / 2, 100e3, 5)), 6.082757575313462, kOtherEdge);
}

// Straight up and almost without bubbles a surface of facets alone, sec^4 exp(-tan^2/s2)/(4 pi s2) with
// s2 = 0.0046 ln(2.1 U^2), but for the share 1/(1 + exp(0.524 edge)) that ripples would have: the edge, in degrees, is
// where the lobe has fallen by 15 dB.
TEST(SeaSurfaceBackscatterTest, IsAGlitterStraightUp) {
  constexpr double kBubbles = 5e-6;
  const double s2 = 0.0046 * std::log(2.1 * 3 * 3);
  const auto lobe = [&](double incidence) {
    return std::exp(-std::pow(std::tan(incidence), 2) / s2) / std::pow(std::cos(incidence), 4);
  };
  double inside = 0;
  double outside = 0.5;
  for (int i = 0; i < 60; ++i) {
    const double middle = (inside + outside) / 2;
    (lobe(middle) > std::pow(10, -1.5) ? inside : outside) = middle;
  }
  const double share = 1 / (1 + std::exp(-0.524 * degrees_from_radians(inside)));
  const double loss = std::pow(10, -surface_bubble_loss_db(kPi / 2, 10e3, 3) / 10);
  EXPECT_NEAR(sea_surface_backscatter(kPi / 2, 10e3, 3) / (share * loss / (4 * kPi * s2)), 1, kBubbles);
}

// The report's ripples grow as tan^4 and are cut off at 85 degrees.
TEST(SeaSurfaceBackscatterTest, HasRipplesUpTo85Degrees) {
  const double with = sea_surface_backscatter(radians_from_degrees(84.999), 10e3, 10);
  const double without = sea_surface_backscatter(radians_from_degrees(85.001), 10e3, 10);
  EXPECT_GT(with / without, 1.005);
  EXPECT_LT(with / without, 1.03);
}

TEST(SeaSurfaceBackscatterTest, IsConstantAboveAHundredKilohertz) {
  EXPECT_EQ(sea_surface_backscatter(0.4, 720e3, 7), sea_surface_backscatter(0.4, 100e3, 7));
  EXPECT_EQ(surface_bubble_loss_db(0.4, 720e3, 7), surface_bubble_loss_db(0.4, 100e3, 7));
}

// Until, from some 8 m/s on, bubbles hide the surface behind them.
TEST(SeaSurfaceBackscatterTest, GrowsWithTheWindAtLowGrazingAngles) {
  double previous = 0;
  for (double wind_speed = 0; wind_speed <= 8; wind_speed += 0.5) {
    const double current = sea_surface_backscatter(radians_from_degrees(10), 50e3, wind_speed);
    EXPECT_GT(current, previous) << "at " << wind_speed << " m/s";
    previous = current;
  }
}

// The report's pieces meet where they change over: wind of 1, 6 and 11 m/s.
TEST(SeaSurfaceBackscatterTest, HasNoStepsInTheWind) {
  for (const double wind_speed : {1.0, 6.0, 11.0}) {
    for (const double grazing : {0.2, 0.8, kPi / 2}) {
      const double below = sea_surface_backscatter(grazing, 60e3, wind_speed - 1e-9);
      EXPECT_NEAR(sea_surface_backscatter(grazing, 60e3, wind_speed) / below, 1, 0.005) << wind_speed << " m/s";
    }
  }
}

TEST(SurfaceBubbleLossTest, IsThatOfTheReport) {
  const double rows[][4] = {{90, 10e3, 3, 0.004060765151007331},
                            {90, 10e3, 10, 0.3314137669788182},
                            {20, 100e3, 5, 0.9265373804491942},
                            {20, 100e3, 8, 4.832480831680509}};
  for (const auto& [grazing_deg, frequency, wind_speed, expected_db] : rows) {
    const double grazing = radians_from_degrees(grazing_deg);
    EXPECT_THAT(surface_bubble_loss_db(grazing, frequency, wind_speed), RelativelyNear(expected_db));
    EXPECT_THAT(sea_surface_reflection(grazing, frequency, wind_speed),
                RelativelyNear(std::pow(10, -expected_db / 20)));
  }
}

// Half the sine, twice the way through the bubbles.
TEST(SurfaceBubbleLossTest, GrowsWithThePathThroughTheBubbles) {
  EXPECT_THAT(surface_bubble_loss_db(kPi / 6, 50e3, 9), RelativelyNear(2 * surface_bubble_loss_db(kPi / 2, 50e3, 9)));
}

// ---------------------------------------------------------------- Coherent part

// h sin(theta) of a wavelength over 2 pi: exp(-2).
TEST(CoherentReflectionTest, IsRayleighs) {
  EXPECT_EQ(coherent_reflection(0, 0.002, 1), 1);
  EXPECT_EQ(coherent_reflection(0.3, 0.002, 0), 1);
  EXPECT_THAT(coherent_reflection(0.01 / (2 * kPi), 0.01, kPi / 2), RelativelyNear(std::exp(-2)));
  EXPECT_THAT(coherent_reflection(0.02 / (2 * kPi), 0.01, kPi / 6), RelativelyNear(std::exp(-2)));
}

// Sea state 1: waves of some 3 cm rms, 100 kHz, 20 degrees.
TEST(CoherentReflectionTest, IsGoneAtAHundredKilohertzInAnySea) {
  EXPECT_LT(coherent_reflection(0.03, 0.015, radians_from_degrees(20)), 1e-12);
}

// The mean of exp(2 i k sin(theta) z) over normally distributed heights z.
TEST(CoherentReflectionTest, IsTheMeanOverHeights) {
  const double h = 0.004;
  const double k = 2 * kPi / 0.02;
  const double grazing = 0.7;
  double sum = 0;
  for (int i = -8000; i <= 8000; ++i) {
    const double z = i * 1e-3 * h;
    sum += std::exp(-z * z / (2 * h * h)) * std::cos(2 * k * std::sin(grazing) * z) * 1e-3 / std::sqrt(2 * kPi);
  }
  EXPECT_THAT(coherent_reflection(h, 0.02, grazing), RelativelyNear(sum));
}

// ---------------------------------------------------------------- Chapman and Harris

TEST(ChapmanHarrisTest, IsThatOfThePaper) {
  const double rows[][4] = {
      {10, 10, 1000, -58.649810270129144}, {20, 15, 3000, -37.25756228823019}, {30, 20, 6400, -27.42760486009498}};
  for (const auto& [grazing_deg, knots, frequency, expected_db] : rows) {
    EXPECT_THAT(chapman_harris_db(radians_from_degrees(grazing_deg), frequency, knots * kKnot),
                RelativelyNear(expected_db));
  }
}

TEST(SurfaceScatteringTest, RefusesArgumentsOutOfLimits) {
  const auto message = [](auto act) { return message_of([&] { static_cast<void>(act()); }); };
  EXPECT_EQ(message([] { return chapman_harris_db(0.2, 720e3, 5); }),
            "chapman_harris_db.frequency = 720000 Hz must be from 400 to 6400 Hz");
  EXPECT_EQ(message([] { return sea_surface_backscatter(0, 50e3, 5); }),
            "sea_surface_backscatter.grazing_deg = 0 deg must be greater than 0, at most 90 deg");
  EXPECT_EQ(message([] { return surface_bubble_loss_db(0.5, 5e3, 5); }),
            "surface_bubble_loss_db.frequency = 5000 Hz must be at least 10000 Hz");
  EXPECT_EQ(message([] { return sea_surface_reflection(0.5, 50e3, 31); }),
            "sea_surface_reflection.wind_speed = 31 m/s must be from 0 to 30 m/s");
  EXPECT_EQ(message([] { return coherent_reflection(-1, 0.02, 0.5); }),
            "coherent_reflection.rms_height = -1 m must be at least 0 m");
}

}  // namespace
}  // namespace insonify::surface_scattering_test
