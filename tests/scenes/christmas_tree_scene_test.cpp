// christmas_tree_scene_test.cpp -- ranges, angles and shadow of the Christmas tree scene against its geometry.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "scenes/scene_scan.h"

namespace insonify::christmas_tree_scene_test {
namespace {

using testing_scenes::SceneScan;

// The scene's measures, as scenes/christmas_tree.sdf and .yaml and scenes/make/tree/tree.h give them [m]. The sonar
// hangs over the origin; its head turns in the plane y = 0, its beam is 0.9 degrees wide there and 10 degrees across.
constexpr double kSonarHeight = 8.5;
constexpr double kWellX = 6.2;
constexpr double kTreeYaw = radians_from_degrees(158);
constexpr double kRoofTop = 4.345;
constexpr double kRailMiddle = 1.62;  // Distance of the frame's upper rails from the well's axis, on all four sides.
constexpr double kRailTop = 4.32;     // Height of their top.
constexpr double kHalfBeam = radians_from_degrees(0.45);
constexpr double kHalfSwath = radians_from_degrees(5);

// Tolerance of two bins, for the position of an echo within its first bin and the length of its footprint.
double two_bins(const SceneScan& scan) {
  return 2 * scan.sonar().bin_length();
}

TEST(ChristmasTreeSceneTest, SeafloorLineLiesAtTheSonarsHeight) {
  // In front of the well the bed is level within 0.2 m: waves of 0.12 m, burrowers' mounds of at most 0.15 m.
  SceneScan scan("christmas_tree");
  for (const double down_deg : {90.0, 84.0, 78.0, 72.0}) {
    const Ping ping = scan.ping_at(-down_deg);
    const auto bed = scan.first_echo(ping, "seabed");
    ASSERT_TRUE(bed) << down_deg;
    EXPECT_NEAR(*bed, kSonarHeight / std::sin(radians_from_degrees(down_deg)), 0.2) << down_deg;
    EXPECT_FALSE(scan.first_echo(ping, "tree")) << down_deg;
  }
}

TEST(ChristmasTreeSceneTest, RoofLiesAtItsHeight) {
  // A level plate, first hit by the steepest rays of the beam. The angles avoid cap and padeyes.
  SceneScan scan("christmas_tree");
  for (const double down_deg : {28.5, 40.0}) {
    const Ping ping = scan.ping_at(-down_deg);
    const double expected = (kSonarHeight - kRoofTop) / std::sin(radians_from_degrees(down_deg) + kHalfBeam);
    const auto roof = scan.first_echo(ping, "tree");
    ASSERT_TRUE(roof) << down_deg;
    EXPECT_NEAR(*roof, expected, two_bins(scan)) << down_deg;
    const int bin = static_cast<int>((*roof - scan.sonar().min_range) / scan.sonar().bin_length());
    EXPECT_EQ(scan.material(ping, bin), "grp") << down_deg;
  }
}

TEST(ChristmasTreeSceneTest, PanelStandsWhereItsPlaneIs) {
  // The nearest point of the panel, 1.5 m from the axis and 1.16 m to both sides, that a beam 50 degrees down covers;
  // by brute force. Grab bars and stabs stand up to 0.18 m before it.
  SceneScan scan("christmas_tree");
  const double down = radians_from_degrees(50);
  double nearest = std::numeric_limits<double>::infinity();
  for (double across = -1.16; across <= 1.16; across += 0.005) {
    for (double z = 2.08; z <= 3.70; z += 0.005) {
      const double x = kWellX + 1.5 * std::cos(kTreeYaw) - across * std::sin(kTreeYaw);
      const double y = 1.5 * std::sin(kTreeYaw) + across * std::cos(kTreeYaw);
      const double depth = kSonarHeight - z;
      const bool covered = std::abs(std::atan2(depth, x) - down) < kHalfBeam &&
                           std::abs(std::atan2(y, std::hypot(x, depth))) < kHalfSwath;
      nearest = covered ? std::min(nearest, std::hypot(x, y, depth)) : nearest;
    }
  }
  const auto panel = scan.first_echo(scan.ping_at(-50), "tree");
  ASSERT_TRUE(panel);
  EXPECT_GT(*panel, nearest - 0.18 - two_bins(scan));
  EXPECT_LT(*panel, nearest + two_bins(scan));
}

TEST(ChristmasTreeSceneTest, TreeThrowsAShadowAsLongAsItsHeightSays) {
  // The end of the shadow is determined by the point of the frame's upper rear rail that is nearest to the sonar within
  // the swath. That rail is oblique: its middle line is x = well + rail / cos(22 deg) + y tan(22 deg), and the swath
  // reaches 5 degrees to y < 0.
  SceneScan scan("christmas_tree");
  const double turn = std::numbers::pi - kTreeYaw;
  const double axis_x = kWellX + kRailMiddle / std::cos(turn);
  const double swath = std::hypot(axis_x, kSonarHeight - kRailTop) * std::tan(kHalfSwath);
  const double edge = axis_x - swath * std::tan(turn);
  const double shadow = kRailTop * edge / (kSonarHeight - kRailTop);  // Beyond the rail.
  const double end = std::hypot(edge + shadow, kSonarHeight);

  // From behind the guide base, at 41 degrees down, to 30 degrees the bed is in shadow ...
  for (double down_deg = 41; down_deg >= 30; down_deg -= 0.5) {
    EXPECT_FALSE(scan.first_echo(scan.ping_at(-down_deg), "seabed")) << down_deg;
  }
  // ... and the first echo after it is where the shadow ends. 0.25 m: half a step and the bed's waves.
  std::optional<double> first;
  for (double down_deg = 30; down_deg > 25 && !first; down_deg -= 0.5) {
    first = scan.first_echo(scan.ping_at(-down_deg), "seabed");
  }
  ASSERT_TRUE(first);
  EXPECT_NEAR(*first, end, 0.25);
}

TEST(ChristmasTreeSceneTest, StrongestEchoesAreTheTrees) {
  SceneScan scan("christmas_tree");
  std::set<std::string> materials;
  for (double down_deg = 56; down_deg >= 30; down_deg -= 1) {
    const Ping ping = scan.ping_at(-down_deg);
    const int strongest = SceneScan::strongest_bin(ping);
    EXPECT_TRUE(scan.is_of(ping, strongest, "tree")) << down_deg;
    EXPECT_GT(ping.intensity[strongest], 0.9F) << down_deg;
    materials.insert(scan.material(ping, strongest));
  }
  EXPECT_FALSE(materials.contains("sand"));
  EXPECT_TRUE(materials.contains("steel"));
}

}  // namespace
}  // namespace insonify::christmas_tree_scene_test
