// bed_test.cpp -- heights of beds found by vertical rays.

#include "pattern/bed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pattern/pattern_scenes.h"

namespace insonify::bed_test {
namespace {

using testing_surveys::bed_scene;

TEST(BedTest, FindsTheHeightBetweenCorners) {
  // A plane is linear within each triangle, whatever its diagonal.
  const Bed bed(bed_scene(40, [](double x, double y) { return 0.25 * x - 0.5 * y - 3; }), {{-30, -30}, {30, 30}});
  for (const auto& [x, y] :
       {std::pair(0.0, 0.0), std::pair(1.5, -7.25), std::pair(-29.9, 29.9), std::pair(30.0, -30.0)}) {
    ASSERT_TRUE(bed.at(x, y)) << x;
    EXPECT_NEAR(bed.at(x, y)->height, 0.25 * x - 0.5 * y - 3, 1e-5);
    EXPECT_EQ(bed.at(x, y)->instance, 0);
  }
  EXPECT_FALSE(bed.at(31, 0));  // Outside the rectangle.
}

TEST(BedTest, TakesTheHighestSurfaceAndNoHole) {
  Scene scene = bed_scene(40, [](double x, double) { return x > 10 ? std::nan("") : -5.0; });
  scene.instances.push_back({.name = "box",
                             .mesh = std::make_shared<const Mesh>(make_box({4, 4, 2})),
                             .world_from_mesh = {Vec3(0, 0, -4), Eigen::Quaterniond::Identity()}});
  const Bed bed(scene, {{-30, -30}, {30, 30}});
  EXPECT_EQ(bed.at(1.2, 0.7)->height, -3);  // -4 + 2/2.
  EXPECT_EQ(bed.at(1.2, 0.7)->instance, 1);
  EXPECT_EQ(bed.at(2.2, 0.7)->height, -5);
  EXPECT_FALSE(bed.at(15, 0));
  EXPECT_EQ(Bed(scene, {{-30, -30}, {30, 30}}, -3.5).at(1.2, 0.7)->height, -5);  // Its bottom, on the bed.
}

TEST(BedTest, MeetsEveryPointOfASurfaceOfSharedEdges) {
  const Bed bed(bed_scene(20, [](double x, double y) { return std::sin(x) + std::cos(y); }), {{-19, -19}, {19, 19}});
  for (double x = -19; x <= 19; x += 0.125) {  // Many on edges and corners.
    for (double y = -19; y <= 19; y += 0.125) {
      ASSERT_TRUE(bed.at(x, y)) << x << " " << y;
    }
  }
}

TEST(BedTest, HoldsManyLargeTriangles) {
  Scene scene;
  for (int i = 0; i < 500; ++i) {
    scene.instances.push_back({.name = "sheet",
                               .mesh = std::make_shared<const Mesh>(make_plane(Vec3::UnitZ(), 1000, 1000)),
                               .world_from_mesh = {Vec3(0, 0, -i), Eigen::Quaterniond::Identity()}});
  }
  EXPECT_EQ(Bed(scene, {{-30, -30}, {30, 30}}).at(3, 4)->height, 0);
}

}  // namespace
}  // namespace insonify::bed_test
