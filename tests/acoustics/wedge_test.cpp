// wedge_test.cpp -- the echo of edges against the exact series of wedges, and in the limits of thin plates.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "acoustics/diffraction.h"

namespace insonify::wedge_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kNarrow = 1e-3;  // Of a mirror's directions: far from all tests' angles.

double backscatter(double exterior, double angle, double first, double second) {
  return wedge_backscatter(exterior, {{{angle, first}, {exterior * kPi - angle, second}}}, kNarrow);
}

// The field of a plane wave from the angle `angle` at the distance x/k from the edge in that direction, less the
// incident and the reflected waves of geometrical acoustics there: exact series of Bowman, Senior and Uslenghi,
// Electromagnetic and Acoustic Scattering by Simple Shapes (1969), ch. 6, for e^(-i omega t), scaled so that it becomes
// S as x grows.
double from_series(double exterior, double angle, bool hard, double x) {
  std::complex<double> total = 0;
  for (int m = 0; m < 4 * x + 80; ++m) {
    const double order = m / exterior;
    const double bessel = std::cyl_bessel_j(order, x);
    const double trig = hard ? std::cos(order * angle) : std::sin(order * angle);
    total += (m == 0 ? 2.0 : 4.0) / exterior * std::polar(1.0, -0.5 * kPi * order) * bessel * trig * trig;
  }
  std::complex<double> geometric = std::polar(1.0, -x);
  const double sign = hard ? 1 : -1;
  for (const double own : {angle, exterior * kPi - angle}) {
    if (2 * own < kPi) {
      geometric += sign * std::polar(1.0, -x * std::cos(2 * own));
    }
  }
  // u = D e^(ix)/sqrt(x/k), D = e^(i pi/4) S sqrt(2 pi/k) in the sign of a mirror.
  const std::complex<double> scaled = (total - geometric) * std::sqrt(x / (2 * kPi)) * std::polar(1.0, -x - 0.25 * kPi);
  return scaled.real();
}

// The next term is smaller by 1/x: extrapolated from two distances.
double exact(double exterior, double angle, bool hard) {
  constexpr double kNear = 60, kFar = 90;
  const double near = from_series(exterior, angle, hard, kNear), far = from_series(exterior, angle, hard, kFar);
  return far + (far - near) * kNear / (kFar - kNear);
}

TEST(WedgeTest, IsTheFarFieldOfTheExactSeries) {
  struct Case {
    double exterior, degrees;
  };
  for (const Case& c : {Case{1.5, 135}, Case{1.5, 60}, Case{1.5, 30}, Case{1.5, 120}, Case{2, 140}, Case{2, 50},
                        Case{1.25, 70}, Case{1.7, 200}, Case{1.7, 153}}) {
    for (const bool hard : {true, false}) {
      const double sign = hard ? 1 : -1;
      const double angle = c.degrees * kDegree;
      EXPECT_NEAR(backscatter(c.exterior, angle, sign, sign), exact(c.exterior, angle, hard),
                  0.002 + 0.01 * std::abs(exact(c.exterior, angle, hard)))
          << c.exterior << ", " << c.degrees << ", " << hard;
    }
  }
}

// sin(pi/n)/(2 pi n) (1/(cos(pi/n) - 1) +- 1/(cos(pi/n) - cos(2 phi/n))) by hand: n = 3/2 at 135 degrees .09189 (-2/3
// +- 2).
TEST(WedgeTest, RightAngledEdgeBetweenItsFaces) {
  EXPECT_NEAR(backscatter(1.5, 135 * kDegree, 1, 1), 0.12252, 1e-5);
  EXPECT_NEAR(backscatter(1.5, 135 * kDegree, -1, -1), -0.24504, 1e-5);
  EXPECT_NEAR(backscatter(1.5, 135 * kDegree, 0, 0), -0.06126, 1e-5);
}

// A hard half-plane, turned by t from head on: (1/sin t - 1)/(4 pi) of the near edge, -(1/sin t + 1)/(4 pi) of the far
// one (Ufimtsev, Fundamentals of the Physical Theory of Diffraction, 2007, ch. 5; a strip's two edges). A soft one has
// the signs of the ones turned. Physical acoustics has 1/(4 pi tan t) of both.
TEST(WedgeTest, EdgesOfThinPlates) {
  for (const double degrees : {3.0, 17.0, 44.0, 80.0}) {
    const double t = degrees * kDegree, over = 1 / std::sin(t);
    EXPECT_NEAR(backscatter(2, kPi / 2 + t, 1, 1), (over - 1) / (4 * kPi), 1e-9);
    EXPECT_NEAR(backscatter(2, kPi / 2 - t, 1, 1), -(over + 1) / (4 * kPi), 1e-9);
    EXPECT_NEAR(backscatter(2, kPi / 2 + t, -1, -1), -(over + 1) / (4 * kPi), 1e-9);
  }
  EXPECT_NEAR(backscatter(2, kPi, 1, 1), 0, 1e-12);
}

TEST(WedgeTest, TermsBelongToTheirFaces) {
  // With the other face's reflection nothing changes of the first's: exterior 3/2, 100 degrees.
  const double first = backscatter(1.5, 100 * kDegree, 0.8, 0.3) - backscatter(1.5, 100 * kDegree, 0, 0.3);
  EXPECT_NEAR(first, 0.8 / (6 * kPi * std::tan(10 * kDegree / 1.5)), 1e-9);
  EXPECT_NEAR(backscatter(1.5, 100 * kDegree, 0.8, 0.3), backscatter(1.5, 170 * kDegree, 0.3, 0.8), 1e-12);
  // Held within a mirror's directions, on both sides.
  const auto held = [](double degrees) {
    return wedge_backscatter(1.5, {{{degrees * kDegree, 1}, {(270 - degrees) * kDegree, 0}}}, 2 * kDegree);
  };
  EXPECT_EQ(held(90.5), held(91.9));
  EXPECT_EQ(held(89.5), held(88.1));
  EXPECT_NEAR(held(90.5) - backscatter(1.5, kPi / 2, 0, 0), 1 / (6 * kPi * std::tan(2 * kDegree / 1.5)), 1e-9);
}

}  // namespace
}  // namespace insonify::wedge_test
