// triangulate_test.cpp -- triangulation preserves area and winding of polygons.

#include "io/mesh/triangulate.h"

#include <gtest/gtest.h>

#include <random>

namespace insonify::triangulate_test {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Twice the sum of the triangles' areas, and of their projections on the polygon's normal: equal if all have its
// winding.
struct Areas {
  double sum = 0;
  Vec3 along = Vec3::Zero();
};

Areas areas_of(const std::vector<Vec3f>& corners, const Triangles& triangles) {
  Areas areas;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 doubled = (corners[b] - corners[a]).cast<double>().cross((corners[c] - corners[a]).cast<double>());
    areas.sum += doubled.norm();
    areas.along += doubled;
  }
  return areas;
}

Triangles cut(const std::vector<Vec3f>& corners) {
  Triangles triangles;
  triangulate(corners, triangles);
  return triangles;
}

void expect_area(const std::vector<Vec3f>& corners, double area) {
  const Triangles triangles = cut(corners);
  EXPECT_EQ(triangles.size(), corners.size() - 2);
  const Areas areas = areas_of(corners, triangles);
  EXPECT_NEAR(areas.sum / 2, area, 1e-5 * area);
  EXPECT_NEAR(areas.along.norm() / 2, area, 1e-5 * area);
}

TEST(TriangulateTest, CutsAQuadAlongTheDiagonalInside) {
  expect_area({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 2);
  // Arrow heads, with the notch at each corner in turn: the tip at 3 less the notch at 1, half a base of 1 each side.
  std::vector<Vec3f> arrow{{0, 1, 0}, {1, 0, 0}, {0, 3, 0}, {-1, 0, 0}};
  for (int i = 0; i < 4; ++i) {
    std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
    expect_area(arrow, 2);
  }
}

// The diagonal from (0, 2) to (2, 0) runs exactly through the corner at (1, 1).
TEST(TriangulateTest, CutsAnL) {
  std::vector<Vec3f> corners{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  for (int i = 0; i < 6; ++i) {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    expect_area(corners, 3);
  }
}

TEST(TriangulateTest, CutsACombWithCornersOnItsEdges) {
  // Three teeth of 1 x 2 on a back of 5 x 1, with a spare corner in the middle of the back: 11 m^2.
  expect_area({{0, 0, 0},
               {2.5F, 0, 0},
               {5, 0, 0},
               {5, 3, 0},
               {4, 3, 0},
               {4, 1, 0},
               {3, 1, 0},
               {3, 3, 0},
               {2, 3, 0},
               {2, 1, 0},
               {1, 1, 0},
               {1, 3, 0},
               {0, 3, 0}},
              11);
}

TEST(TriangulateTest, CutsAHoleDrawnWithASlit) {
  // A square of side 3 with a hole of side 1; the slit runs from corner to corner.
  expect_area(
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}},
      8);
}

// Star-shaped polygons in planes of any direction; the area by the shoelace formula.
TEST(TriangulateTest, CutsRandomPolygonsInAnyPlane) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const int count = 4 + trial % 20;
    const Eigen::Quaterniond turn =
        Eigen::AngleAxisd(6 * uniform(random), Vec3::UnitX()) * Eigen::AngleAxisd(6 * uniform(random), Vec3::UnitZ());
    std::vector<Vec3f> corners;
    std::vector<Vec3> flat;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.8 * uniform(random)) / count;
      flat.push_back((0.2 + uniform(random)) * Vec3(std::cos(angle), std::sin(angle), 0));
      corners.push_back(Vec3f((turn * flat.back() + Vec3(5, -3, 1)).cast<float>()));
    }
    double area = 0;
    for (int i = 0; i < count; ++i) {
      area += flat[i].cross(flat[(i + 1) % count]).z() / 2;
    }
    expect_area(corners, area);
  }
}

TEST(TriangulateTest, GetsThroughWhatIsNoPolygon) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {1, nan, 0}, {0, 1, 0}, {0, 0.5F, 0}}).size(), 3U);
  EXPECT_EQ(cut({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).size(), 2U);
  EXPECT_EQ(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 0}}).size(), 3U) << "crosses itself";
}

}  // namespace
}  // namespace insonify::triangulate_test
