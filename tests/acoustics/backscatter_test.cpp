// backscatter_test.cpp -- scattering laws against independently computed values, and the normalisation of the facet
// lobe: the total echo of a large plate and of a sphere equals that of a mirror.

#include "insonify/acoustics/backscatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "support/message_of.h"
#include "support/relative.h"

namespace insonify::backscatter_test {
namespace {

constexpr double kPi = std::numbers::pi;

double db(double ratio) {
  return 10 * std::log10(ratio);
}

// Simpson's rule.
double integral(const std::function<double(double)>& f, double from, double to) {
  constexpr int kSteps = 20000;
  const double step = (to - from) / kSteps;
  double sum = f(from) + f(to);
  for (int i = 1; i < kSteps; ++i) {
    sum += (i % 2 == 1 ? 4 : 2) * f(from + i * step);
  }
  return sum * step / 3;
}

TEST(LambertBackscatterTest, FallsAsTheSquareOfTheCosine) {
  const double mu = 0.07;
  EXPECT_EQ(lambert_backscatter(mu, 0), mu);
  EXPECT_THAT(lambert_backscatter(mu, kPi / 4), RelativelyNear(mu / 2));
  EXPECT_THAT(lambert_backscatter(mu, kPi / 3), RelativelyNear(mu / 4));
}

TEST(LambertBackscatterTest, IsZeroAtTheEdgeAndFromBehind) {
  for (const double incidence : {kPi / 2, 2.0, kPi}) {
    EXPECT_EQ(lambert_backscatter(0.3, incidence), 0);
    EXPECT_EQ(lambert_scatter(0.3, incidence, 0.4), 0);
    EXPECT_EQ(lambert_scatter(0.3, 0.4, incidence), 0);
    EXPECT_EQ(facet_backscatter(0.8, 0.3, incidence), 0);
  }
}

// Power through the hemisphere is the integral of mu cos(in) cos(out) over solid angle = pi mu cos(in), of the cos(in)
// that falls on a unit of surface.
TEST(LambertScatterTest, ScattersAllIncidentEnergyAtTheGreatestParameter) {
  const double incidence = 0.7;
  const auto ring = [&](double out) {
    return lambert_scatter(kGreatestLambertParameter, incidence, out) * 2 * kPi * std::sin(out);
  };
  EXPECT_THAT(integral(ring, 0, kPi / 2), RelativelyNear(std::cos(incidence)));
  EXPECT_EQ(kGreatestLambertParameter, std::numbers::inv_pi);
}

TEST(LambertScatterTest, IsReciprocal) {
  EXPECT_EQ(lambert_scatter(0.1, 0.3, 1.1), lambert_scatter(0.1, 1.1, 0.3));
}

struct Lobe {
  double rms_slope, incidence_deg, expected_db;
};

// Computed from the formula in double precision, independently of this code; R = 1.
constexpr Lobe kLobes[] = {
    {0.05, 0, 12.01820131641885},    {0.05, 5, 5.436021088795511},   {0.05, 10, -14.721333817471953},
    {0.05, 20, -101.96697361060001}, {0.1, 0, 5.9976014031392255},   {0.1, 5, 4.401729565708418},
    {0.1, 10, -0.48782614943154057}, {0.1, 20, -21.688266821903582}, {0.2, 0, -0.02299851014039837},
    {0.2, 5, -0.37229325002307184},  {0.2, 10, -1.4448991673811555}, {0.2, 20, -6.1340400596891955},
};

TEST(FacetBackscatterTest, IsTheKirchhoffLobe) {
  for (const Lobe& lobe : kLobes) {
    const double incidence = radians_from_degrees(lobe.incidence_deg);
    EXPECT_THAT(db(facet_backscatter(1, lobe.rms_slope, incidence)), RelativelyNear(lobe.expected_db));
    EXPECT_THAT(facet_backscatter(-0.5, lobe.rms_slope, incidence),
                RelativelyNear(std::pow(10, lobe.expected_db / 10) / 4));
  }
}

// Beckmann's distribution of tilts D = exp(-tan^2/m^2) / (pi m^2 cos^4) with m = sqrt(2) s; its facets' echo is F D/4.
TEST(FacetBackscatterTest, IsAQuarterOfBeckmannsDistribution) {
  const double s = 0.17;
  const double tilt = 0.35;
  const double m2 = 2 * s * s;
  const double beckmann = std::exp(-std::pow(std::tan(tilt), 2) / m2) / (kPi * m2 * std::pow(std::cos(tilt), 4));
  EXPECT_THAT(facet_backscatter(0.6, s, tilt), RelativelyNear(0.36 * beckmann / 4));
}

// Normalisation of the lobe (docs/concepts/scattering.md). A plate at distance d: a ring of it at incidence t has the
// area dA = 2 pi d^2 tan t / cos^2 t dt and the range d/cos t, so the echo is the integral of s_b 2 pi tan t cos^2 t /
// d^2. It must equal that of the source's mirror image at 2 d, 1/(4 d^2).
TEST(FacetBackscatterTest, GivesALargePlateTheMirrorsEchoForEverySlope) {
  for (const double s : {0.02, 0.05, 0.1, 0.2, 0.3}) {
    const auto ring = [&](double t) {
      return facet_backscatter(1, s, t) * 2 * kPi * std::tan(t) * std::pow(std::cos(t), 2);
    };
    EXPECT_THAT(integral(ring, 0, 1.5), RelativelyNear(0.25)) << "for s = " << s;
  }
}

// A sphere from afar: dA = 2 pi a^2 sin t dt. a^2/4 is the limit of a small slope; what a larger one adds was computed
// independently of this code and is told to three digits.
TEST(FacetBackscatterTest, GivesASphereNearlyItsTargetStrength) {
  constexpr double kThreeDigits = 5e-4;  // [dB]
  const double expected_db[][2] = {{0.02, 0.002}, {0.05, 0.011}, {0.1, 0.043}, {0.2, 0.164}, {0.3, 0.348}};
  for (const auto& [s, excess_db] : expected_db) {
    const auto ring = [&, slope = s](double t) { return facet_backscatter(1, slope, t) * 2 * kPi * std::sin(t); };
    EXPECT_NEAR(db(integral(ring, 0, kPi / 2) / 0.25), excess_db, kThreeDigits) << "for s = " << s;
  }
}

TEST(FacetScatterTest, IsTheBackscatterOfTheHalfVector) {
  const Vec3 normal = Vec3::UnitZ();
  const Vec3 in = Vec3(0.6, 0, 0.8);
  const Vec3 mirrored = Vec3(-0.6, 0, 0.8);
  EXPECT_NEAR(half_vector_tilt(normal, in, mirrored), 0, 1e-15);
  EXPECT_THAT(half_vector_tilt(normal, in, in), RelativelyNear(std::asin(0.6)));
  // Halfway between straight up and along x: 45 degrees.
  EXPECT_THAT(half_vector_tilt(normal, Vec3::UnitZ(), Vec3::UnitX()), RelativelyNear(kPi / 4));
  EXPECT_EQ(facet_scatter(0.7, 0.2, 0.31), facet_backscatter(0.7, 0.2, 0.31));
}

TEST(FacetScatterTest, HalfVectorKeepsItsDigitsAtSmallTilts) {
  const double tilt = 1e-9;
  const Vec3 towards(std::sin(tilt), 0, std::cos(tilt));
  EXPECT_THAT(half_vector_tilt(Vec3::UnitZ(), towards, towards), RelativelyNear(tilt));
}

TEST(BackscatterTest, RefusesArgumentsOutOfLimits) {
  EXPECT_EQ(message_of([] { static_cast<void>(lambert_backscatter(-0.1, 0)); }),
            "lambert_scatter.mu = -0.1 must be at least 0");
  EXPECT_EQ(message_of([] { static_cast<void>(facet_backscatter(1, 0, 0)); }),
            "facet_scatter.rms_slope = 0 must be greater than 0");
  EXPECT_EQ(message_of([] { static_cast<void>(facet_scatter(1.5, 0.1, 0)); }),
            "facet_scatter.reflection = 1.5 must be from -1 to 1");
}

}  // namespace
}  // namespace insonify::backscatter_test
