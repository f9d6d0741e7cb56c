// ray_tube_test.cpp -- ray-tube spreading by planes, spheres and cylinders, against the mirror equations.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "echo/laws/laws.h"

namespace insonify::ray_tube_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double area(const RayTube& tube, double across) {
  return std::abs(double{tube.constant} + across * (double{tube.linear} + across * double{tube.quadratic}));
}

RayTube tube_of(const std::array<Vec3f, 3>& corners, const std::array<Vec3f, 3>& normals, const Vec3f& direction,
                const Vec3f& normal, float range) {
  return ray_tube({triple_of(corners[1] - corners[0]), triple_of(corners[2] - corners[0]), triple_of(normals[0]),
                   triple_of(normals[1]), triple_of(normals[2])},
                  triple_of(direction), triple_of(normal), range);
}

// The ray tube of a small triangle at the origin of a surface with the normal z and the curvatures curved_x along x and
// curved_y along y.
RayTube tube_by(double curved_x, double curved_y, const Vec3f& direction, float range, float side = 1) {
  std::array<Vec3f, 3> corners = {Vec3f(2e-3F, 0, 0), Vec3f(-1e-3F, 2e-3F, 0), Vec3f(-1e-3F, -2e-3F, 0)}, normals;
  for (int k = 0; k < 3; ++k) {
    normals[k] =
        side * Vec3f(static_cast<float>(curved_x) * corners[k].x(), static_cast<float>(curved_y) * corners[k].y(), 1)
                   .normalized();
  }
  return tube_of(corners, normals, direction, side * Vec3f::UnitZ(), range);
}

Vec3f from_angle(double degrees, double turned = 0) {
  const double s = std::sin(degrees * kDegree);
  return Vec3(s * std::cos(turned * kDegree), s * std::sin(turned * kDegree), -std::cos(degrees * kDegree))
      .cast<float>();
}

TEST(RayTubeTest, PlaneSpreadsAsFromItsImage) {
  for (const double angle : {0.0, 30.0, 75.0}) {
    const RayTube tube = tube_by(0, 0, from_angle(angle, 20), 7);
    EXPECT_FLOAT_EQ(tube.constant, 49);
    EXPECT_NEAR(area(tube, 3), 100, 1e-4);
  }
  // A relief that tilts the whole triangle leaves it a plane.
  const std::array<Vec3f, 3> corners = {Vec3f::Zero(), Vec3f::UnitX(), Vec3f::UnitY()};
  const std::array<Vec3f, 3> normals = {Vec3f::UnitZ(), Vec3f::UnitZ(), Vec3f::UnitZ()};
  EXPECT_NEAR(area(tube_of(corners, normals, from_angle(20), Vec3f(0.2F, 0, 1).normalized(), 7), 3), 100, 1e-4);
}

// Mirror equations of a sphere of radius a: 1/r + 2/(a cos t) in the plane of incidence, 1/r + 2 cos t/a across it; a <
// 0 is concave.
TEST(RayTubeTest, SpheresDivergeAndFocus) {
  for (const double radius : {0.4, 3.0, -8.0}) {
    for (const double angle : {0.0, 20.0, 45.0, 70.0}) {
      for (const double turned : {0.0, 35.0, 90.0}) {
        const double r = 6, across = 2.5, cosine = std::cos(angle * kDegree);
        const double expected = std::abs(r * r * (1 + across * (1 / r + 2 / (radius * cosine))) *
                                         (1 + across * (1 / r + 2 * cosine / radius)));
        for (const float side : {1.0F, -1.0F}) {
          const RayTube tube = tube_by(1 / radius, 1 / radius, from_angle(angle, turned), 6, side);
          EXPECT_NEAR(area(tube, across) / expected, 1, 2e-3) << radius << ", " << angle << ", " << turned;
        }
      }
    }
  }
}

// A cylinder spreads as a sphere across its axis, and as a plane along it.
TEST(RayTubeTest, CylindersSpreadInOnePlane) {
  const double r = 6, a = 0.5, across = 4;
  EXPECT_NEAR(area(tube_by(1 / a, 0, from_angle(0), 6), across),
              r * r * (1 + across * (1 / r + 2 / a)) * (1 + across / r), 0.5);
}

// At grazing incidence the curvature of a triangle cannot be estimated from its corners.
TEST(RayTubeTest, GrazingIncidenceCountsAsAPlane) {
  EXPECT_FLOAT_EQ(tube_by(2, 2, from_angle(90), 5).constant, 25);
}

}  // namespace
}  // namespace insonify::ray_tube_test
