// ferry_and_tank_meshes_test.cpp -- dimensions of the meshes of the ferry, its bed and the test tank.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "insonify/files.h"
#include "scenes/mesh_probe.h"
#include "scenes/obj_mesh.h"

namespace insonify::ferry_and_tank_meshes_test {
namespace {

using testing_scenes::generated_meshes;
using testing_scenes::kRounding;
using testing_scenes::Probe;

TEST(TankMeshTest, InsideIsTwentyThreeByEighteenPointEightOneByEight) {
  // From a point off the middle, at heights without windows, pipes and ladders.
  Probe tank("tank");
  const Vec3 inside(1.5, -2.25, -6.0);
  EXPECT_NEAR(tank.distance(inside, Vec3::UnitX()), 23.0 / 2 - 1.5, kRounding);
  EXPECT_NEAR(tank.distance(inside, -Vec3::UnitX()), 23.0 / 2 + 1.5, kRounding);
  EXPECT_NEAR(tank.distance(inside, Vec3::UnitY()), 18.81 / 2 + 2.25, kRounding);
  EXPECT_NEAR(tank.distance(inside, -Vec3::UnitY()), 18.81 / 2 - 2.25, kRounding);
  EXPECT_NEAR(tank.distance(inside, -Vec3::UnitZ()), 8.0 - 6.0, kRounding);
  EXPECT_TRUE(std::isinf(tank.distance(inside, Vec3::UnitZ())));  // Open at the top.
}

TEST(TankMeshTest, WallsRiseAboveTheWater) {
  Probe tank("tank");
  EXPECT_TRUE(std::isfinite(tank.distance({0, 0, 0.4}, Vec3::UnitX())));
  EXPECT_TRUE(std::isinf(tank.distance({0, 0, 0.8}, Vec3::UnitX())));
}

TEST(TankMeshTest, WindowIsSetBackInItsWall) {
  // The niche in the +x wall: its pane is 0.3 m behind the wall's face, and the frame's bars do not cover its middle.
  Probe tank("tank");
  EXPECT_NEAR(tank.distance({0, 0, -3.9}, Vec3::UnitX()), 11.5 + 0.3, kRounding);
}

TEST(VehicleBoxTest, HidesAllBehindItFromASonarNearby) {
  // Seen from 2.85 m, a box 1.8 m high covers the Micron's 35 degrees of elevation: atan(0.9 / 2.85) = 17.5 degrees.
  Probe box("vehicle_box");
  for (const double elevation_deg : {-16.0, -9.0, 0.0, 9.0, 16.0}) {
    const double elevation = radians_from_degrees(elevation_deg);
    EXPECT_LT(box.distance({-3.4, 0, 0}, {std::cos(elevation), 0, std::sin(elevation)}), 3.0) << elevation_deg;
  }
}

TEST(FerryMeshTest, IsFiftyTwoMetresLongBetweenItsRamps) {
  // Rays along the ship that pass beside the ramps, which are 4.6 m wide, and hit transom and stem. The stem leans
  // forward by up to 1.7 m at the deck. Dents displace plating across and up, never along.
  Probe ferry("ferry");
  EXPECT_NEAR(ferry.distance({-20, 3.5, 2.6}, Vec3::UnitX()), 20, kRounding);
  const double stem = 80 - ferry.distance({80, 2.6, 3.5}, -Vec3::UnitX());
  EXPECT_GT(stem, 52);
  EXPECT_LT(stem, 52 + 1.7);
}

TEST(FerryMeshTest, IsTwelveMetresBroadAmidships) {
  // Between the fenders. Dents displace plating by up to 5 cm.
  Probe ferry("ferry");
  EXPECT_NEAR(20 - ferry.distance({26, 20, 2.5}, -Vec3::UnitY()), 6.0, 0.05);
  EXPECT_NEAR(20 - ferry.distance({26, -20, 2.5}, Vec3::UnitY()), 6.0, 0.05);
}

TEST(FerryMeshTest, TornHoleOpensTheStarboardBowAlone) {
  Probe ferry("ferry");
  const double port = 20 - ferry.distance({39.75, 20, 2.1}, -Vec3::UnitY());
  const double starboard = 20 - ferry.distance({39.75, -20, 2.1}, Vec3::UnitY());
  EXPECT_GT(port, 4.5);       // Undamaged plating.
  EXPECT_LT(starboard, 3.0);  // Through the hole, to whatever is inside.
}

TEST(FerryMeshTest, BulwarkHasFreeingPorts) {
  // Ports of 1.3 m every 3.6 m from x = 3.2 m: a ray through one passes over the deck, a ray beside it does not.
  Probe ferry("ferry");
  const auto reach = [&](double x) { return 20 - ferry.distance({x, 20, 4.0}, -Vec3::UnitY()); };
  EXPECT_LT(reach(42.9 + 0.65), 5.0);
  EXPECT_GT(reach(45.2), 5.0);
}

TEST(SeabedMeshTest, CoversItsGround) {
  Probe seabed("seabed");
  for (const double x : {-29.9, 30.0, 89.9}) {
    for (const double y : {-59.9, 3.0, 59.9}) {
      EXPECT_LT(std::abs(seabed.height(x, y)), 1.5) << x << ", " << y;
    }
  }
}

// Mean distance and height from crest to crest and trough along a line of heights. The bed's swells are far longer than
// ripples, so a crest is any point higher than all others within 0.3 m.
struct Ripples {
  double count = 0, length = 0, rise = 0;

  void measure(const std::vector<double>& heights, double step) {
    const auto reach = static_cast<std::ptrdiff_t>(0.3 / step);
    auto last = heights.end();
    for (auto it = heights.begin() + reach; it < heights.end() - reach; ++it) {
      if (std::max_element(it - reach, it + reach + 1) != it) {
        continue;
      }
      if (last != heights.end()) {
        count += 1;
        length += step * static_cast<double>(it - last);
        rise += (*it + *last) / 2 - *std::min_element(last, it);
      }
      last = it;
    }
  }
};

TEST(SeabedMeshTest, RipplesAreAboutAMetreLongAndTenCentimetresHigh) {
  // Heights by integration of the bed's normal map along the current (azimuth 0.21 rad), over sand away from the wreck.
  const Mesh seabed = load_mesh(generated_meshes() / "seabed.obj");
  ASSERT_EQ(seabed.reliefs.size(), 1U);
  ASSERT_NE(seabed.reliefs[0], nullptr);
  const Eigen::Vector2d current(std::cos(0.21), std::sin(0.21));
  constexpr double kStep = 0.025;
  Ripples ripples;
  for (const double y : {-34.0, -28.0, 24.0, 30.0}) {
    std::vector<double> heights = {0};
    for (int i = 0; i < 800; ++i) {
      const Eigen::Vector2d at = Eigen::Vector2d(7, y) + (i + 0.5) * kStep * current;
      const Eigen::Vector2f texture =
          ((at - Eigen::Vector2d(-30, -60)) / 120).cast<float>();  // Texture coordinates of the bed.
      const Eigen::Vector2f slope = seabed.reliefs[0]->slopes.at(texture.x(), texture.y());
      heights.push_back(heights.back() + kStep * slope.cast<double>().dot(current));
    }
    ripples.measure(heights, kStep);
  }
  ASSERT_GT(ripples.count, 50);
  EXPECT_GT(ripples.length / ripples.count, 0.8);
  EXPECT_LT(ripples.length / ripples.count, 1.1);
  EXPECT_GT(ripples.rise / ripples.count, 0.075);
  EXPECT_LT(ripples.rise / ripples.count, 0.12);
}

// Every vertex of the bed has the texture coordinates of its position.
TEST(SeabedMeshTest, ItsNormalMapLiesWhereItIs) {
  const Mesh seabed = load_mesh(generated_meshes() / "seabed.obj");
  ASSERT_EQ(seabed.texture_coordinates.size(), seabed.triangles.size());
  for (std::size_t t = 0; t < seabed.triangles.size(); t += 1000) {
    for (int k = 0; k < 3; ++k) {
      const Vec3f& vertex = seabed.vertices[seabed.triangles[t][k]];
      EXPECT_NEAR(seabed.texture_coordinates[t][k].x(), (vertex.x() + 30) / 120, 1e-5);
      EXPECT_NEAR(seabed.texture_coordinates[t][k].y(), (vertex.y() + 60) / 120, 1e-5);
    }
  }
}

}  // namespace
}  // namespace insonify::ferry_and_tank_meshes_test
