// target_strength_test.cpp -- cross sections against independently computed values, their near and far limits, and a
// direct Kirchhoff sum over a plate.

#include "insonify/acoustics/target_strength.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "acoustics/diffraction.h"
#include "insonify/acoustics/backscatter.h"
#include "support/message_of.h"
#include "support/relative.h"

namespace insonify::target_strength_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWavelength = 1500.0 / 720e3;

// ---------------------------------------------------------------- Fresnel's integrals

// Abramowitz and Stegun, Handbook of Mathematical Functions (1964), table 7.7, to its seven digits.
TEST(FresnelTest, IsThatOfTheTable) {
  constexpr double kDigits = 5e-8;
  const double rows[][3] = {{0.5, 0.4923442, 0.0647324}, {1, 0.7798934, 0.4382591}, {1.5, 0.4452612, 0.6975050},
                            {2, 0.4882534, 0.3434157},   {3, 0.6057208, 0.4963130}, {5, 0.5636312, 0.4991914}};
  for (const auto& [x, c, s] : rows) {
    EXPECT_NEAR(fresnel_integral(x).real(), c, kDigits) << "at " << x;
    EXPECT_NEAR(fresnel_integral(x).imag(), s, kDigits) << "at " << x;
  }
}

// Simpson's rule, where series and continued fraction meet.
TEST(FresnelTest, IsTheIntegralOnBothSidesOfTheSeam) {
  for (const double x : {0.3, 1.2, 1.59, 1.61, 1.9, 2.7, 6.0}) {
    constexpr int kSteps = 40000;
    const double step = x / kSteps;
    std::complex<double> sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double weight = i == 0 || i == kSteps ? 1 : (i % 2 == 1 ? 4 : 2);
      sum += weight * std::polar(1.0, kPi / 2 * i * step * i * step);
    }
    EXPECT_NEAR(std::abs(fresnel_integral(x) - sum * step / 3.0), 0, 1e-12) << "at " << x;
  }
}

TEST(FresnelTest, ConvergesToTheMiddleOfTheSpiral) {
  EXPECT_EQ(fresnel_integral(0), 0.0);
  EXPECT_NEAR(std::abs(fresnel_integral(1e6) - std::complex<double>(0.5, 0.5)), 0, 1e-6);
}

// ---------------------------------------------------------------- Smooth bodies

TEST(SphereTest, IsASquareOfHalfTheRadiusFromAfar) {
  EXPECT_THAT(target_strength_db(sphere_cross_section(0.1)), RelativelyNear(-26.020599913279625));
  EXPECT_THAT(target_strength_db(sphere_cross_section(0.25)), RelativelyNear(-18.06179973983887));
  EXPECT_THAT(target_strength_db(sphere_cross_section(0.5)), RelativelyNear(-12.041199826559248));
  EXPECT_THAT(target_strength_db(sphere_cross_section(1)), RelativelyNear(-6.020599913279624));
}

// Centre at 10 m.
TEST(SphereTest, IsWeakerNearby) {
  EXPECT_THAT(target_strength_db(sphere_cross_section(0.5, 9.5)), RelativelyNear(-12.486727720782294));
  EXPECT_EQ(sphere_cross_section(0.5, 9.5), convex_cross_section(0.5, 0.5, 9.5));
  EXPECT_THAT(sphere_cross_section(0.5, 1e12), RelativelyNear(sphere_cross_section(0.5)));
}

TEST(ConvexTest, IsALongCylinderOrAWallWhereItIsStraight) {
  EXPECT_THAT(target_strength_db(convex_cross_section(0.1, kFarField, 10)), RelativelyNear(-6.063813651106049));
  EXPECT_THAT(target_strength_db(convex_cross_section(kFarField, kFarField, 10)), RelativelyNear(13.979400086720377));
  EXPECT_EQ(convex_cross_section(0.1, 3, 7), convex_cross_section(3, 0.1, 7));
}

// 0.2 m by 0.8 m: 0.2 x 0.8/4.
TEST(ConvexTest, IsAQuarterOfTheProductOfRadiiFromAfar) {
  EXPECT_THAT(convex_cross_section(0.2, 0.8), RelativelyNear(0.04));
}

// ---------------------------------------------------------------- Cylinder and plate

struct NearAndFar {
  double side, range, near_db, far_db;
};

// Radius 0.1 m at 720 kHz and 1500 m/s.
TEST(CylinderTest, IsThatOfFresnelsIntegrals) {
  constexpr NearAndFar kCylinders[] = {{0.02, 10, -20.22085254436127, -20.177287669604315},
                                       {0.05, 10, -12.275420535526296, -12.218487496163563},
                                       {0.1, 10, -6.461353271287388, -6.197887582883938}};
  for (const NearAndFar& c : kCylinders) {
    EXPECT_THAT(target_strength_db(cylinder_cross_section(0.1, c.side, kWavelength, c.range)),
                RelativelyNear(c.near_db));
    EXPECT_THAT(target_strength_db(cylinder_cross_section(0.1, c.side, kWavelength)), RelativelyNear(c.far_db));
  }
  EXPECT_THAT(target_strength_db(cylinder_cross_section(0.1, 1, kWavelength, 10)), RelativelyNear(-6.465123605305694));
}

TEST(CylinderTest, HasTheLimitsOfAShortAndAnInfiniteOne) {
  EXPECT_THAT(cylinder_cross_section(0.1, 0.05, kWavelength, 1e9),
              RelativelyNear(cylinder_cross_section(0.1, 0.05, kWavelength)));
  EXPECT_NEAR(cylinder_cross_section(0.1, 1e5, kWavelength, 10) / convex_cross_section(0.1, kFarField, 10), 1, 1e-5);
}

TEST(PlateTest, IsThatOfFresnelsIntegrals) {
  constexpr NearAndFar kPlates[] = {
      {0.02, 10, -14.334677699790069, -14.333975425929006}, {0.05, 10, 1.556186317879886, 1.583624920952498},
      {0.1, 10, 13.1843208463577, 13.624824747511745},      {0.2, 10, 18.25371890154533, 25.666024574070995},
      {1, 10, 13.176780178321088, 53.624824747511745},      {0.05, 50, 1.5825276144800018, 1.583624920952498},
  };
  for (const NearAndFar& p : kPlates) {
    EXPECT_THAT(target_strength_db(plate_cross_section(p.side, p.side, kWavelength, p.range)),
                RelativelyNear(p.near_db));
    EXPECT_THAT(target_strength_db(plate_cross_section(p.side, p.side, kWavelength)), RelativelyNear(p.far_db));
  }
}

TEST(PlateTest, IsAMirrorWhereItIsInfinite) {
  EXPECT_NEAR(plate_cross_section(1e5, 1e5, kWavelength, 10) / 25, 1, 1e-5);
}

// The Kirchhoff integral itself, |1/lambda sum exp(2ik rho)|^2 over the plate, with rho = r + (x^2 + y^2)/(2 r): the
// depth of field that Fresnel's integrals stand for.
TEST(PlateTest, IsTheSumOfItsPoints) {
  constexpr int kPoints = 800;
  const double range = 10;
  const double k = 2 * kPi / kWavelength;
  const auto strip = [&](double length) {
    std::complex<double> sum = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double x = length * ((i + 0.5) / kPoints - 0.5);
      sum += std::polar(length / kPoints, k * x * x / range);
    }
    return sum;
  };
  const double sum = std::norm(strip(0.3) * strip(0.12) / kWavelength);
  EXPECT_NEAR(plate_cross_section(0.3, 0.12, kWavelength, range) / sum, 1, 1e-4);
}

// ---------------------------------------------------------------- Lambert's sphere and corners

TEST(LambertSphereTest, IsTwoThirdsOfPiMuASquared) {
  EXPECT_THAT(target_strength_db(lambert_sphere_cross_section(std::pow(10, -2.7), 0.5)),
              RelativelyNear(-29.810013776895097));
}

// From its surface: the integral of mu cos^2 over the half that faces the sonar, 2 pi a^2 sin t dt.
TEST(LambertSphereTest, IsTheSumOfItsSurface) {
  const double mu = 0.02;
  const double radius = 0.7;
  double sum = 0;
  constexpr int kRings = 4000;
  for (int i = 0; i < kRings; ++i) {
    const double t = (i + 0.5) * kPi / 2 / kRings;
    sum += lambert_backscatter(mu, t) * 2 * kPi * radius * radius * std::sin(t) * kPi / 2 / kRings;
  }
  EXPECT_NEAR(sum / lambert_sphere_cross_section(mu, radius), 1, 1e-6);
}

TEST(CornerTest, IsAsStrongAsThePlateOfItsAperture) {
  EXPECT_THAT(target_strength_db(dihedral_cross_section(0.1, 0.1, kWavelength)), RelativelyNear(16.635124704151558));
  EXPECT_THAT(target_strength_db(triangular_trihedral_cross_section(0.1, kWavelength)),
              RelativelyNear(8.853612200315121));
  EXPECT_THAT(target_strength_db(square_trihedral_cross_section(0.1, kWavelength)), RelativelyNear(18.39603729470837));
  // The mouth of a dihedral, seen along its axis, is sqrt(2) width x height.
  EXPECT_THAT(dihedral_cross_section(0.3, 0.2, kWavelength),
              RelativelyNear(plate_cross_section(std::sqrt(2) * 0.3, 0.2, kWavelength)));
}

TEST(TargetStrengthTest, RefusesArgumentsOutOfLimits) {
  const auto message = [](auto act) { return message_of([&] { static_cast<void>(act()); }); };
  EXPECT_EQ(message([] { return sphere_cross_section(-1); }),
            "sphere_cross_section.radius = -1 m must be greater than 0 m");
  EXPECT_EQ(message([] { return sphere_cross_section(1, 0); }),
            "sphere_cross_section.range = 0 m must be greater than 0 m");
  EXPECT_EQ(message([] { return convex_cross_section(1, NAN); }),
            "convex_cross_section.radius2 = nan m must be greater than 0 m");
  EXPECT_EQ(message([] { return plate_cross_section(1, 2, 0, 10); }),
            "plate_cross_section.wavelength = 0 m must be greater than 0 m");
  EXPECT_EQ(message([] { return cylinder_cross_section(1, INFINITY, 0.1, 10); }),
            "cylinder_cross_section.length = inf m must be finite and greater than 0 m");
  EXPECT_EQ(message([] { return target_strength_db(-1); }),
            "target_strength_db.cross_section = -1 m^2 must be at least 0 m^2");
  EXPECT_EQ(target_strength_db(0), -INFINITY);
}

}  // namespace
}  // namespace insonify::target_strength_test
