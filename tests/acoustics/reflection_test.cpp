// reflection_test.cpp -- reflection coefficients against independently computed values and simple special cases.

#include "insonify/acoustics/reflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "insonify/geometry.h"
#include "insonify/material.h"
#include "support/message_of.h"
#include "support/relative.h"

namespace insonify::reflection_test {
namespace {

constexpr double kPi = std::numbers::pi;

double loss_db(std::complex<double> reflection) {
  return -20 * std::log10(std::abs(reflection));
}

// ---------------------------------------------------------------- Half-space

// Steel 7850 x 5900, air 1.204 x 343.2, PVC 1380 x 2380, wetsuit foam 200 x 500 against sea water 1026 x 1500 and fresh
// water 998.2 x 1482.4.
TEST(ReflectionCoefficientTest, IsTheContrastOfImpedances) {
  const double fresh = 998.2 * 1482.4;
  EXPECT_THAT(reflection_coefficient(kSeaWaterImpedance, 7850.0 * 5900), RelativelyNear(0.9356793580473941));
  EXPECT_THAT(reflection_coefficient(fresh, 7850.0 * 5900), RelativelyNear(0.9380797159859691));
  EXPECT_THAT(reflection_coefficient(kSeaWaterImpedance, 1.204 * 343.2), RelativelyNear(-0.9994631554457708));
  EXPECT_THAT(reflection_coefficient(kSeaWaterImpedance, 1380.0 * 2380), RelativelyNear(0.3618609279761164));
  EXPECT_THAT(reflection_coefficient(fresh, 200.0 * 500), RelativelyNear(-0.8733962213127232));
}

TEST(ReflectionCoefficientTest, ChangesSignWithTheSideItIsSeenFrom) {
  EXPECT_EQ(reflection_coefficient(2e6, 3e6), 0.2);
  EXPECT_EQ(reflection_coefficient(3e6, 2e6), -0.2);
  EXPECT_EQ(reflection_coefficient(2e6, 2e6), 0);
}

TEST(ReflectionCoefficientTest, IsThatOfAMaterial) {
  const Material material{.density = 1800, .sound_speed = 2900};
  EXPECT_EQ(material.reflection_coefficient(1.5e6), reflection_coefficient(1.5e6, 1800.0 * 2900));
}

// ---------------------------------------------------------------- Plate

struct PlateCase {
  double density, sound_speed, thickness, at_720_khz, at_1200_khz;
};

// In sea water, computed independently of this code: steel of 1 and 5 mm, PVC of 5 mm (near resonance at 720 kHz),
// acrylic of 10 mm, HDPE of 3 mm.
constexpr PlateCase kPlates[] = {
    {7850, 5900, 1e-3, 0.9954337058886727, 0.9975942679371734},
    {7850, 5900, 5e-3, 0.9946107552929795, 0.847646934468197},
    {1380, 2380, 5e-3, 0.06574353397591726, 0.10895356323376908},
    {1190, 2750, 1e-2, 0.48854092054301373, 0.5304851254461718},
    {960, 2430, 3e-3, 0.2652772337524273, 0.04963043345853201},
};

TEST(PlateReflectionTest, IsThatOfALayerInWater) {
  for (const PlateCase& p : kPlates) {
    EXPECT_THAT(plate_reflection(kSeaWaterImpedance, p.density, p.sound_speed, p.thickness, 720e3),
                RelativelyNear(p.at_720_khz));
    EXPECT_THAT(plate_reflection(kSeaWaterImpedance, p.density, p.sound_speed, p.thickness, 1.2e6),
                RelativelyNear(p.at_1200_khz));
  }
}

// At 2000 m/s and 500 kHz the wavelength is 4 mm. A plate of half a wavelength transmits everything; one of a quarter
// reflects (m^2 - 1)/(m^2 + 1).
TEST(PlateReflectionTest, VanishesAtHalfAWaveAndPeaksAtAQuarter) {
  const double m = 3;
  EXPECT_NEAR(plate_reflection(1.5e6, m * 1.5e6 / 2000, 2000, 2e-3, 500e3), 0, 1e-12);
  EXPECT_THAT(plate_reflection(1.5e6, m * 1.5e6 / 2000, 2000, 1e-3, 500e3), RelativelyNear((m * m - 1) / (m * m + 1)));
  EXPECT_EQ(plate_reflection(1.5e6, 2250, 2000, 0, 500e3), 0);
}

// The sum of the multiple reflections inside the plate: R12 + T12 R21 T21 z^2 + T12 R21^3 T21 z^4 + ..., where z^2 is
// the phase factor of one passage forth and back.
TEST(PlateReflectionTest, IsTheSumOfTheEchoesInsideIt) {
  const double density = 1380;
  const double sound_speed = 2380;
  const double thickness = 3.1e-3;
  const double frequency = 675e3;
  const double r = reflection_coefficient(kSeaWaterImpedance, density * sound_speed);
  const std::complex<double> there_and_back = std::polar(1.0, 2 * 2 * kPi * frequency / sound_speed * thickness);
  std::complex<double> sum = r;
  std::complex<double> echo = (1 - r * r) * -r * there_and_back;
  for (int i = 0; i < 100; ++i) {
    sum += echo;
    echo *= r * r * there_and_back;
  }
  EXPECT_THAT(plate_reflection(kSeaWaterImpedance, density, sound_speed, thickness, frequency),
              RelativelyNear(std::abs(sum)));
}

// ---------------------------------------------------------------- Bottom

struct BottomCase {
  double grazing_deg, medium_sand_db, silty_clay_db;
};

// TR 9407's medium sand and silty clay (sediment.h), computed independently of this code.
constexpr BottomCase kBottoms[] = {
    {5, 0.2092738446213743, 9.013027196468796},  {10, 0.36857895592374174, 17.80788564769097},
    {20, 0.5642657346139515, 45.06183311741452}, {30, 1.1534928049346416, 29.218797825714717},
    {45, 6.5495279422854855, 25.89010625886949}, {60, 7.974658987084572, 24.97457249703082},
    {90, 8.641252143487048, 24.543353036100704},
};

TEST(BottomReflectionTest, IsRayleighs) {
  for (const BottomCase& b : kBottoms) {
    const double grazing = radians_from_degrees(b.grazing_deg);
    EXPECT_THAT(loss_db(bottom_reflection(1.8446160500000002, 1.1781937875000001, 0.016241264888776853, grazing)),
                RelativelyNear(b.medium_sand_db));
    EXPECT_THAT(loss_db(bottom_reflection(1.1461216, 0.9824408, 0.0016256350329222357, grazing)),
                RelativelyNear(b.silty_clay_db));
  }
}

TEST(BottomReflectionTest, IsTheHalfSpacesAtNormalIncidenceAndTotalAtGrazing) {
  EXPECT_NEAR(std::abs(bottom_reflection(1.8, 1.2, 0, kPi / 2) - reflection_coefficient(1, 1.8 * 1.2)), 0, 1e-15);
  EXPECT_EQ(bottom_reflection(1.8, 1.2, 0.01, 0), -1.0);
  EXPECT_EQ(bottom_reflection(1.8, 1, 0, 0), -1.0);
}

// A fast bottom without loss: nothing passes below arccos(1/nu), 31.9 degrees of medium sand.
TEST(BottomReflectionTest, IsTotalBelowTheCriticalAngle) {
  const double critical = std::acos(1 / 1.1781937875);
  EXPECT_NEAR(degrees_from_radians(critical), 31.92, 0.005);
  EXPECT_THAT(std::abs(bottom_reflection(1.84, 1.1781937875, 0, critical - 0.001)), RelativelyNear(1.0));
  EXPECT_LT(std::abs(bottom_reflection(1.84, 1.1781937875, 0, critical + 0.001)), 0.95);
  EXPECT_LT(std::abs(bottom_reflection(1.84, 1.1781937875, 0.01, critical - 0.1)), 1);
}

// A slow, dense bottom: rho tan(theta) matches at the angle of intromission, sin^2 = (1/nu^2 - 1)/(rho^2 - 1).
TEST(BottomReflectionTest, VanishesAtTheAngleOfIntromission) {
  const double nu = 0.98;
  const double rho = 1.3;
  const double intromission = std::asin(std::sqrt((1 / (nu * nu) - 1) / (rho * rho - 1)));
  EXPECT_NEAR(std::abs(bottom_reflection(rho, nu, 0, intromission)), 0, 1e-13);
}

TEST(ReflectionTest, RefusesArgumentsOutOfLimits) {
  const auto message = [](auto act) { return message_of([&] { static_cast<void>(act()); }); };
  EXPECT_EQ(message([] { return plate_reflection(1.5e6, 0, 1500, 1e-3, 1e5); }),
            "plate_reflection.density = 0 kg/m^3 must be greater than 0 kg/m^3");
  EXPECT_EQ(message([] { return bottom_reflection(1.2, 0, 0, 0.3); }),
            "bottom_reflection.sound_speed_ratio = 0 must be greater than 0");
  EXPECT_EQ(message([] { return bottom_reflection(1.2, 1.1, 0, kPi); }),
            "bottom_reflection.grazing_deg = 180 deg must be from 0 to 90 deg");
}

}  // namespace
}  // namespace insonify::reflection_test
