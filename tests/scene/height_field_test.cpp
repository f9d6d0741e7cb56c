// height_field_test.cpp -- triangulation of height grids: positions, normals, holes and diagonals.

#include <gtest/gtest.h>

#include "scene/mesh_checks.h"
#include "support/message_of.h"

namespace insonify::height_field_test {
namespace {

constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

// 3 columns at 2 m by 2 rows at 4 m. The first row is the northern one: y = +2.
TEST(HeightFieldTest, RunsFromTheNorthWestCorner) {
  const Mesh mesh = make_height_field({3, 2, 2, 4, {1, 2, 3, 4, 5, 6}, {}});
  const auto height_at = [&](float x, float y) {
    for (const Vec3f& vertex : mesh.vertices) {
      if (vertex.x() == x && vertex.y() == y) {
        return vertex.z();
      }
    }
    return kHole;
  };
  EXPECT_EQ(mesh.vertices.size(), 6U);
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(height_at(-2, 2), 1);
  EXPECT_EQ(height_at(0, 2), 2);
  EXPECT_EQ(height_at(2, 2), 3);
  EXPECT_EQ(height_at(-2, -2), 4);
  EXPECT_EQ(height_at(2, -2), 6);
}

// z = x / 2 - y / 4: the normal is (-1/2, 1/4, 1) everywhere, one-sided slopes at the rim included.
TEST(HeightFieldTest, SlopeGivesTheNormal) {
  HeightGrid grid{5, 4, 0.5, 2, {}, {}};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      const double x = (column - 2) * 0.5;
      const double y = (1.5 - row) * 2;
      grid.heights.push_back(static_cast<float>(x / 2 - y / 4));
    }
  }
  const Mesh mesh = make_height_field(grid);
  const Vec3f expected = Vec3f(-0.5F, 0.25F, 1).normalized();
  for (const Vec3f& normal : mesh.normals) {
    EXPECT_LT((normal - expected).norm(), 1e-6);
  }
  EXPECT_GT(least_agreement(mesh), 1 - 1e-6) << "triangles wind upwards";
  // Area of the plan, 2 m x 6 m, over the cosine of the slope.
  EXPECT_NEAR(area_of(mesh), 12 / static_cast<double>(expected.z()), 1e-5);
}

TEST(HeightFieldTest, ThreeCornersMakeOneTriangleAndTwoNone) {
  // The hole takes a corner off each of four cells.
  const Mesh one_hole = make_height_field({3, 3, 1, 1, {0, 0, 0, 0, kHole, 0, 0, 0, 0}, {}});
  EXPECT_EQ(one_hole.triangles.size(), 4U);
  EXPECT_EQ(one_hole.vertices.size(), 8U);
  EXPECT_NEAR(area_of(one_hole), 2, 1e-6);
  EXPECT_GT(least_agreement(one_hole), 0.999);

  const Mesh two_holes = make_height_field({3, 2, 1, 1, {0, 0, kHole, 0, 0, kHole}, {}});
  EXPECT_EQ(two_holes.triangles.size(), 2U);
  EXPECT_EQ(two_holes.vertices.size(), 4U);
}

TEST(HeightFieldTest, IsolatedPointsGiveNoVertices) {
  const Mesh mesh = make_height_field({4,
                                       4,
                                       1,
                                       1,
                                       {9, kHole, kHole, kHole,      //
                                        kHole, kHole, kHole, kHole,  //
                                        kHole, kHole, 1, 2,          //
                                        kHole, kHole, 3, 4},
                                       {}});
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(bounds_of(mesh).high.z(), 4);
}

// A crest of height 1 from one corner to the opposite, on a slope from 0 to .25. Cut along the crest, both triangles
// hold its two ends: the six corners sum to 4.25. Cut across it they would sum to 2.5.
TEST(HeightFieldTest, CutsCellsAlongTheirCrest) {
  for (const std::vector<float>& heights : {std::vector<float>{0, 1, 1, 0.25F}, std::vector<float>{1, 0, 0.25F, 1}}) {
    const Mesh mesh = make_height_field({2, 2, 1, 1, heights, {}});
    double sum = 0;
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) {
        sum += static_cast<double>(mesh.vertices[vertex].z());
      }
    }
    EXPECT_EQ(sum, 4.25);
  }
}

TEST(HeightFieldTest, KeepsTo26BytesATriangle) {
  HeightGrid grid{300, 200, 1, 1, std::vector<float>(60000, -5), {}};
  const Mesh mesh = make_height_field(grid);
  const std::size_t bytes = mesh.vertices.capacity() * sizeof(Vec3f) + mesh.normals.capacity() * sizeof(Vec3f) +
                            mesh.triangles.capacity() * sizeof(mesh.triangles[0]) + mesh.material_slots.capacity() * 2;
  EXPECT_LT(static_cast<double>(bytes) / static_cast<double>(mesh.triangles.size()), 26);
}

std::string message_for(const HeightGrid& grid) {
  return message_of([&] { (void)make_height_field(grid); });
}

TEST(HeightFieldErrorTest, SaysWhatIsWrongWithTheGrid) {
  EXPECT_EQ(message_for({1, 2, 1, 1, {0, 0}, {}}), "height grid.columns = 1 must be at least 2");
  EXPECT_EQ(message_for({2, 2, 0, 1, {0, 0, 0, 0}, {}}), "height grid.spacing_x = 0 m must be greater than 0 m");
  EXPECT_EQ(message_for({2, 3, 1, 1, {0, 0, 0, 0}, {}}), "height grid: 4 heights, 2 columns x 3 rows need 6");
  EXPECT_EQ(message_for({2, 2, 1, 1, {0, INFINITY, 0, 0}, {}}),
            "height grid: heights[1] = inf must be a finite number, or NaN where there is no data");
  EXPECT_EQ(message_for({2, 2, 1, 1, {0, kHole, kHole, 0}, {}}),
            "height grid: no triangles, as no three neighbouring points have data");
}

}  // namespace
}  // namespace insonify::height_field_test
