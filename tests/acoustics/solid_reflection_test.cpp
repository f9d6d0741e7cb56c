// solid_reflection_test.cpp -- reflection by elastic half-spaces and plates at oblique incidence.

#include "acoustics/solid_reflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "insonify/acoustics/reflection.h"

namespace insonify::solid_reflection_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kWaterDensity = 1026, kWaterSpeed = 1500;

ReflectingMedium medium(double density, double sound_speed, double shear_speed, double loss = 0) {
  return {density / kWaterDensity, sound_speed / kWaterSpeed, shear_speed / kWaterSpeed, loss};
}

const ReflectingMedium kSteel = medium(7850, 5900, 3200), kPvc = medium(1380, 2380, 1060),
                       kConcrete = medium(2400, 3700, 2270);

// Reference values: the conditions at the boundary, continuous normal displacement and stress and no tangential stress,
// solved as linear equations in the amplitudes of the reflected wave and of both kinds of wave in the solid.
TEST(HalfSpaceReflectionTest, SolvesTheBoundaryConditionsOfAnElasticSolid) {
  struct Case {
    ReflectingMedium medium;
    double incidence_deg, magnitude;
  };
  for (const Case& c :
       {Case{kSteel, 0, 0.935679358}, Case{kSteel, 10, 0.934544801}, Case{kSteel, 20, 0.914296349},
        Case{kSteel, 25, 0.919748746}, Case{kPvc, 0, 0.361860928}, Case{kPvc, 20, 0.347422033},
        Case{kPvc, 40, 0.889700536}, Case{kPvc, 60, 0.282929197}, Case{kPvc, 80, 0.626526314},
        Case{kConcrete, 10, 0.696990179}, Case{kConcrete, 25, 0.609861804}, Case{kConcrete, 40, 0.717354838}}) {
    EXPECT_NEAR(std::abs(half_space_reflection(c.medium, std::cos(c.incidence_deg * kDegree))), c.magnitude, 2e-9)
        << c.incidence_deg;
  }
}

// Beyond asin(1500/3200) = 27.95 degrees neither wave carries energy into steel.
TEST(HalfSpaceReflectionTest, ReflectsAllBeyondTheCriticalAngleOfShear) {
  for (const double incidence : {28.5, 35.0, 50.0, 89.0}) {
    EXPECT_NEAR(std::abs(half_space_reflection(kSteel, std::cos(incidence * kDegree))), 1, 1e-12) << incidence;
  }
  EXPECT_LT(std::abs(half_space_reflection(kSteel, std::cos(27.4 * kDegree))), 0.99);
}

// Rayleigh's coefficient of a fluid, also with loss, at angles on both sides of the critical one. Sand (TR 9407).
TEST(HalfSpaceReflectionTest, OfAFluidIsRayleighs) {
  const ReflectingMedium sand{1.8446, 1.1782, 0, 0.01624};
  for (const double grazing : {1.0, 10.0, 31.9, 45.0, 70.0, 90.0}) {
    const std::complex<double> own = half_space_reflection(sand, std::sin(grazing * kDegree)),
                               rayleigh = bottom_reflection(1.8446, 1.1782, 0.01624, grazing * kDegree);
    EXPECT_NEAR(std::abs(own - rayleigh), 0, 1e-9) << grazing;
  }
}

// Reference values: the same boundary conditions on both faces, six linear equations; what passes through takes the
// rest of the energy there, to 1e-6.
TEST(PlateReflectionByAngleTest, SolvesTheBoundaryConditionsOfBothFaces) {
  struct Case {
    ReflectingMedium medium;
    double thickness, incidence_deg, magnitude;
  };
  const ReflectingMedium hdpe = medium(960, 2430, 950);
  for (const Case& c :
       {Case{kSteel, 3e-3, 0, 0.996041547}, Case{kSteel, 3e-3, 15, 0.999750798}, Case{kSteel, 3e-3, 35, 0.979563095},
        Case{kSteel, 3e-3, 60, 0.999997397}, Case{kSteel, 3e-4, 15, 0.959048424}, Case{kSteel, 3e-4, 35, 0.935606843},
        Case{kSteel, 3e-4, 60, 0.735541790}, Case{kPvc, 3e-3, 0, 0.415601504}, Case{kPvc, 3e-3, 15, 0.836716956},
        Case{kPvc, 3e-3, 35, 0.440196171}, Case{kPvc, 3e-3, 60, 0.320769264}, Case{hdpe, 3e-4, 0, 0.221204283},
        Case{hdpe, 3e-4, 35, 0.299056445}, Case{hdpe, 3e-4, 60, 0.977235134}}) {
    const double turns = c.thickness * 720e3 / kWaterSpeed;
    EXPECT_NEAR(std::abs(plate_reflection(c.medium, turns, std::cos(c.incidence_deg * kDegree))), c.magnitude, 1e-7)
        << c.thickness << ", " << c.incidence_deg;
  }
}

// Mass law: a sheet far thinner than the wavelength moves as a whole. 0.02 mm of steel at 720 kHz: omega m/(2 rho c) =
// 2 pi 720e3 0.157/(2 1.539e6) = 0.23075, |R| = x/sqrt(1 + x^2); at 50 degrees x falls by the cosine.
TEST(PlateReflectionByAngleTest, ThinSheetsFollowTheMassLaw) {
  for (const double incidence : {0.0, 20.0, 50.0}) {
    const double x = 0.23075 * std::cos(incidence * kDegree);
    EXPECT_NEAR(std::abs(plate_reflection(kSteel, 2e-5 * 720e3 / kWaterSpeed, std::cos(incidence * kDegree))),
                x / std::sqrt(1 + x * x), 0.01 * x)
        << incidence;
  }
}

// A fluid layer lets everything through where it is half a wavelength thick along its normal, also at an angle: d cos t
// = lambda/2, with t from Snell's law. At normal incidence it is the formula of acoustics/reflection.h.
TEST(PlateReflectionByAngleTest, HalfWaveLayersAreTransparent) {
  const ReflectingMedium layer{1.5, 1.4, 0, 0};
  for (const double incidence : {0.0, 20.0, 40.0}) {
    const double sine = 1.4 * std::sin(incidence * kDegree), turns = 0.5 * 1.4 / std::sqrt(1 - sine * sine);
    EXPECT_NEAR(std::abs(plate_reflection(layer, turns, std::cos(incidence * kDegree))), 0, 1e-9) << incidence;
    EXPECT_GT(std::abs(plate_reflection(layer, 0.5 * turns, std::cos(incidence * kDegree))), 0.2) << incidence;
  }
  EXPECT_NEAR(std::abs(plate_reflection(kSteel, 0.3, 1)),
              plate_reflection(kWaterDensity * kWaterSpeed, 7850, 5900, 0.3, kWaterSpeed), 1e-9);
}

// Nothing comes back from the far face of a plate that absorbs.
TEST(PlateReflectionByAngleTest, ThickLossyPlatesAreHalfSpaces) {
  const ReflectingMedium lossy = medium(1380, 2380, 1060, 0.05);
  for (const double incidence : {0.0, 25.0, 50.0, 75.0}) {
    const double cosine = std::cos(incidence * kDegree);
    EXPECT_NEAR(std::abs(plate_reflection(lossy, 80, cosine) - half_space_reflection(lossy, cosine)), 0, 1e-9)
        << incidence;
  }
}

// |T| by the same six equations, computed apart from this code: elastic plates, and one of each kind with loss.
TEST(PlateTransmissionTest, SolvesTheBoundaryConditionsOfBothFaces) {
  struct Case {
    ReflectingMedium medium;
    double thickness, incidence_deg, magnitude;
  };
  const ReflectingMedium hdpe = medium(960, 2430, 950), aluminium = medium(2700, 6420, 3040),
                         acrylic = medium(1190, 2750, 1400), lossy_acrylic = medium(1190, 2750, 1400, 0.01),
                         lossy_fluid{1.5, 1.4, 0, 0.02};
  for (const Case& c :
       {Case{hdpe, 3e-4, 0, 0.975227494}, Case{hdpe, 3e-4, 35, 0.954235423}, Case{hdpe, 3e-4, 60, 0.212159123},
        Case{aluminium, 3e-4, 0, 0.648971404}, Case{aluminium, 3e-4, 50, 0.863658697},
        Case{kSteel, 3e-3, 0, 0.088888906}, Case{kSteel, 3e-3, 20, 0.371511497}, Case{kSteel, 3e-3, 60, 0.002281613},
        Case{kPvc, 3e-3, 20, 0.663472560}, Case{acrylic, 1e-2, 35, 0.656119741}, Case{acrylic, 1e-2, 50, 0.999997117},
        Case{lossy_acrylic, 5e-3, 25, 0.504585062}, Case{lossy_fluid, 4e-3, 15, 0.657597111}}) {
    const double turns = c.thickness * 720e3 / kWaterSpeed;
    EXPECT_NEAR(std::abs(plate_transmission(c.medium, turns, std::cos(c.incidence_deg * kDegree))), c.magnitude, 1e-7)
        << c.thickness << ", " << c.incidence_deg;
  }
}

// Energy: what is not reflected passes, and with loss some of it is missing.
TEST(PlateTransmissionTest, KeepsTheEnergy) {
  for (const double thickness : {1e-4, 1e-3, 7e-3, 3e-2}) {
    for (int degrees = 0; degrees < 90; degrees += 3) {
      const double turns = thickness * 400e3 / kWaterSpeed, cosine = std::cos(degrees * kDegree);
      for (const double loss : {0.0, 0.01}) {
        const ReflectingMedium plate = medium(1380, 2380, 1060, loss);
        const double sum =
            std::norm(plate_reflection(plate, turns, cosine)) + std::norm(plate_transmission(plate, turns, cosine));
        EXPECT_LE(sum, 1 + 1e-9) << thickness << ", " << degrees;
        EXPECT_TRUE(loss > 0 ? sum < 1 - 1e-5 : sum > 1 - 1e-9) << thickness << ", " << degrees;
      }
    }
  }
}

}  // namespace
}  // namespace insonify::solid_reflection_test
