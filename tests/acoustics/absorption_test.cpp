// absorption_test.cpp -- absorption against values computed independently from the papers, values computed by hand, and
// laws that hold for any constants.

#include "insonify/acoustics/absorption.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/relative.h"

namespace insonify::absorption_test {
namespace {

// Rounding only: the expected values are exact, the code does about ten operations.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

// Computed from the printed equations of both papers in double precision, independently of this code. Losses in dB/km
// as there.
struct Point {
  double frequency_khz, temperature_c, salinity, depth, ph;
  double ainslie_mccolm_db_per_km, ainslie_mccolm_np_per_m, francois_garrison_db_per_km;

  Water water() const { return {.temperature_c = temperature_c, .salinity = salinity, .ph = ph, .depth = depth}; }
};

constexpr Point kPoints[] = {
    {100, 10, 35, 0, 8, 34.34102155612109, 0.003953656215665581, 33.63031641787127},
    {375, 10, 35, 10, 8, 94.17538804964192, 0.010842342232501755, 89.7866502325491},
    {720, 10, 35, 0, 8, 223.4610386862771, 0.025726902827199378, 208.64481883618845},
    {700, 20, 35, 1, 8.1, 214.6419486087555, 0.02471156755988573, 202.5164657460187},
    {720, 25, 35, 5, 8.1, 241.94495751724878, 0.02785494262521474, 227.8410570328391},
    {900, 15, 35, 20, 8, 297.6633123919606, 0.03426975529224792, 278.25748218614615},
    {1200, 10, 35, 0, 8, 535.6073823366115, 0.061664078713292214, 495.4142179977649},
    {1800, 10, 35, 0, 8, 1144.71583846192, 0.13179028126782982, 1054.9602347823418},
    {3000, 10, 35, 0, 8, 3093.5771447535867, 0.3561612308768346, 2845.222697817237},
    {720, 20, 0, 0, 7, 121.10482785197703, 0.013942708565078624, 114.09984000000001},
    {1200, 10, 0, 0, 7, 487.20166521664817, 0.056091164580486484, 447.552},
    {325, 4, 35, 1000, 8, 67.07808569683483, 0.007722650009605451, 66.30675567188408},
    {675, 28, 36, 10, 8.1, 253.47471798849398, 0.0291823553545588, 235.59777859173624},
};

class AbsorptionTest : public testing::TestWithParam<Point> {};

TEST_P(AbsorptionTest, IsThatOfAinslieAndMcColm) {
  const double db_per_m = absorption_db_per_m(GetParam().frequency_khz * 1e3, GetParam().water());
  EXPECT_THAT(db_per_m * 1e3, RelativelyNear(GetParam().ainslie_mccolm_db_per_km));
  EXPECT_THAT(db_per_m * kNeperPerDecibel, RelativelyNear(GetParam().ainslie_mccolm_np_per_m));
}

TEST_P(AbsorptionTest, IsThatOfFrancoisAndGarrison) {
  const double db_per_m = francois_garrison_db_per_m(GetParam().frequency_khz * 1e3, GetParam().water());
  EXPECT_THAT(db_per_m * 1e3, RelativelyNear(GetParam().francois_garrison_db_per_km));
}

INSTANTIATE_TEST_SUITE_P(Points, AbsorptionTest, testing::ValuesIn(kPoints));

TEST(AbsorptionLawTest, IsZeroAtZeroFrequency) {
  EXPECT_EQ(absorption_db_per_m(0, Water{}), 0);
  EXPECT_EQ(absorption_db_per_m(0, Water{.salinity = 0}), 0);
  EXPECT_EQ(francois_garrison_db_per_m(0, Water{.salinity = 0}), 0);
}

// Without salt only viscosity absorbs: 0.00049 dB/km/kHz^2 at 0 degC, so 490 dB/km at 1 MHz.
TEST(AbsorptionLawTest, FreshWaterLosesOnlyToViscosity) {
  const Water fresh{.temperature_c = 0, .salinity = 0};
  EXPECT_NEAR(absorption_db_per_m(1e6, fresh), 0.490, 0.490 * kRounding);
}

// The viscous loss is proportional to exp(-T/27), which halves every 27 ln 2 degrees.
TEST(AbsorptionLawTest, ViscousLossHalvesEvery27Log2Degrees) {
  const Water warm{.temperature_c = 27 * std::numbers::ln2, .salinity = 0};
  EXPECT_NEAR(absorption_db_per_m(1e6, warm), 0.245, 0.245 * kRounding);
}

// At 0 degC, 35 PSU, pH 8 and the surface every exponential in the formula is one, so each of the three losses can be
// computed by hand. 42 kHz is the relaxation frequency of magnesium sulphate, where its loss is half of the plateau.
TEST(AbsorptionLawTest, ThreeLossesAddUpAtTheSulphateRelaxationFrequency) {
  const double boric_acid = 0.106 * 0.78 * 42 * 42 / (0.78 * 0.78 + 42 * 42);
  const double magnesium_sulphate = 0.52 * 42 / 2;
  const double viscosity = 0.00049 * 42 * 42;
  const double expected = (boric_acid + magnesium_sulphate + viscosity) / 1e3;  // 0.0119 dB/m
  const Water freezing{.temperature_c = 0};
  EXPECT_NEAR(absorption_db_per_m(42e3, freezing), expected, expected * kRounding);
}

// Far above 1 kHz boric acid has levelled off at 0.106 f1 exp((pH - 8)/0.56), f1 = 0.78 exp(10/26) at 10 degC: from
// pH 7.7 to 8.3 that is 0.0827 x 1.4690 x (1.7086 - 0.5853) = 0.136 dB/km, whatever the sonar's frequency.
TEST(AbsorptionLawTest, AcidityChangesNextToNothingAboveAHundredKilohertz) {
  for (const double frequency : {100e3, 720e3, 3e6}) {
    const double difference = absorption_db_per_m(frequency, {.ph = 8.3}) - absorption_db_per_m(frequency, {.ph = 7.7});
    EXPECT_NEAR(difference * 1e3, 0.1364, 1e-4) << "at " << frequency << " Hz";
  }
}

TEST(AbsorptionLawTest, GrowsWithFrequency) {
  double previous = 0;
  for (double frequency = 100; frequency <= 3e6; frequency *= 1.2) {
    const double current = absorption_db_per_m(frequency, Water{});
    EXPECT_GT(current, previous) << "at " << frequency << " Hz";
    previous = current;
  }
}

// ---------------------------------------------------------------- Against other fits of the same ocean

struct Band {
  double salinity, deepest, low, high;
  double least, most;  // Limits of A&M / F&G - 1.
};

// Spread of the two formulas over 0..30 degC, rounded outwards; their authors claim 10 % and 5 %.
constexpr Band kBands[] = {
    {35, 1000, 100e3, 300e3, -0.062, 0.062}, {35, 1000, 300e3, 1e6, -0.027, 0.086}, {35, 1000, 1e6, 3e6, -0.028, 0.089},
    {0, 0, 100e3, 3e6, -0.026, 0.091},       {0, 1000, 100e3, 3e6, -0.046, 0.091},
};

class AbsorptionAgreementTest : public testing::TestWithParam<Band> {};

TEST_P(AbsorptionAgreementTest, HoldsBetweenTheTwoFormulas) {
  const Band band = GetParam();
  for (double frequency = band.low; frequency <= band.high; frequency *= 1.1) {
    for (double temperature_c = 0; temperature_c <= 30; temperature_c += 2.5) {
      for (double depth = 0; depth <= band.deepest; depth += 250) {
        const Water water{.temperature_c = temperature_c, .salinity = band.salinity, .depth = depth};
        const double ratio = absorption_db_per_m(frequency, water) / francois_garrison_db_per_m(frequency, water) - 1;
        EXPECT_GE(ratio, band.least) << frequency << " Hz, " << temperature_c << " degC, " << depth << " m";
        EXPECT_LE(ratio, band.most) << frequency << " Hz, " << temperature_c << " degC, " << depth << " m";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bands, AbsorptionAgreementTest, testing::ValuesIn(kBands));

// Fisher and Simmons, J. Acoust. Soc. Am. 62(3), 558 (1977): pure water, in Np/m with the frequency in Hz.
TEST(AbsorptionLawTest, FreshWaterIsWithinTenPercentOfFisherAndSimmons) {
  for (const double t : {0.0, 5.0, 15.0, 20.0, 30.0}) {
    const double fisher_simmons = (55.9 - 2.37 * t + 0.0477 * t * t - 3.48e-4 * t * t * t) * 1e-15 * 720e3 * 720e3;
    const Water fresh{.temperature_c = t, .salinity = 0};
    const double nepers = absorption_db_per_m(720e3, fresh) * kNeperPerDecibel;
    EXPECT_NEAR(nepers, fisher_simmons, 0.10 * fisher_simmons) << "at " << t << " degC";
  }
}

// ---------------------------------------------------------------- Decibels and nepers

TEST(AbsorptionUnitsTest, ADecibelIsATwentiethOfTheLogarithmOfTen) {
  EXPECT_THAT(kNeperPerDecibel, RelativelyNear(std::numbers::ln10 / 20));
  EXPECT_THAT(1 / kNeperPerDecibel, RelativelyNear(8.685889638065037));
}

// What is left after 10 m and 50 m at 720 kHz in the default water: pressure one way, which is also intensity's square
// root; pressure both ways = intensity one way; intensity both ways.
TEST(AbsorptionUnitsTest, LossOnTheWayFollowsFromNepersPerMetre) {
  const double gamma = absorption_db_per_m(720e3, Water{}) * kNeperPerDecibel;
  EXPECT_THAT(std::exp(-gamma * 10), RelativelyNear(0.7731601838355059));
  EXPECT_THAT(std::exp(-2 * gamma * 10), RelativelyNear(0.5977766698685532));
  EXPECT_THAT(std::exp(-4 * gamma * 10), RelativelyNear(0.35733694703913726));
  EXPECT_THAT(std::exp(-gamma * 50), RelativelyNear(0.27627869966399776));
  EXPECT_THAT(std::exp(-2 * gamma * 50), RelativelyNear(0.07632991988802948));
  EXPECT_THAT(std::exp(-4 * gamma * 50), RelativelyNear(0.005826256670112998));
  EXPECT_THAT(-10 * std::log10(std::exp(-4 * gamma * 50)), RelativelyNear(22.34610386862771));
}

}  // namespace
}  // namespace insonify::absorption_test
