// tank_and_ferry_scene_test.cpp -- ranges and bearings of the tank and ferry scenes against their geometry.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/scene_ping.h"
#include "scenes/scene_scan.h"

namespace insonify::tank_and_ferry_scene_test {
namespace {

using testing_scenes::ScenePing;
using testing_scenes::SceneScan;

// Distance from the middle of the tank to its walls along a horizontal ray [m]; the walls are 23.0 and 18.81 m apart.
double wall_range(double azimuth) {
  return std::min(11.5 / std::abs(std::cos(azimuth)), 9.405 / std::abs(std::sin(azimuth)));
}

// The first echo is from the nearest point within the beam, 3 degrees wide. The bearings avoid ladders, inlet and
// window.
TEST(TankSceneTest, WallsLieAtTheirRangesOnEveryBearing) {
  SceneScan scan("tank");
  for (const double bearing : {14.0, 25.0, 52.0, 98.0, 130.0, 171.0, -172.0, -145.0, -120.0, -80.0}) {
    const Ping ping = scan.ping_at(bearing);
    double expected = 4 / std::sin(radians_from_degrees(17.5));  // The floor, 4 m down, at the lower edge of the beam.
    for (double off = -1.5; off <= 1.5; off += 0.1) {
      expected = std::min(expected, wall_range(ping.head_angle + radians_from_degrees(off)));
    }
    const auto wall = scan.first_echo(ping, "tank");
    ASSERT_TRUE(wall) << bearing;
    EXPECT_NEAR(*wall, expected, 0.06) << bearing;
    EXPECT_EQ(scan.material(ping, SceneScan::strongest_bin(ping)), "concrete") << bearing;
  }
}

// A frame of 2.4 x 1.3 m about (3, -1.7), turned by 164 degrees: the nearest point of that rectangle.
TEST(TankSceneTest, TheVehicleIsHeardAtItsNearestPoint) {
  SceneScan scan("tank");
  const double turn = radians_from_degrees(164);
  const double x = -3 * std::cos(turn) + 1.7 * std::sin(turn), y = 3 * std::sin(turn) + 1.7 * std::cos(turn);
  const double near_x = std::clamp(x, -1.2, 1.2), near_y = std::clamp(y, -0.65, 0.65);
  const double world_x = 3 + near_x * std::cos(turn) - near_y * std::sin(turn);
  const double world_y = -1.7 + near_x * std::sin(turn) + near_y * std::cos(turn);
  const Ping ping = scan.ping_at(degrees_from_radians(std::atan2(world_y, world_x)));
  const auto vehicle = scan.first_echo(ping, "vehicle");
  ASSERT_TRUE(vehicle);
  EXPECT_NEAR(*vehicle, std::hypot(world_x, world_y), 0.08);
  EXPECT_FALSE(scan.first_echo(scan.ping_at(90), "vehicle"));
}

// ---------------------------------------------------------------------------------------------------------------------

// The pose of scenes/ferry.sdf; in the ferry's own frame x runs forward from the transom and y to port.
const Pose kWorldFromWreck{
    {39, 24, -0.9},
    orientation_from_rpy(radians_from_degrees(17), radians_from_degrees(-2.2), radians_from_degrees(-106))};

// The sonar is 8 m above a bed that is level within half a metre. It is pitched 13 degrees down, with half an elevation
// aperture of 10 degrees.
TEST(FerrySceneTest, TheBedBeginsWhereTheLowestSoundMeetsIt) {
  const ScenePing scene("ferry");
  const int first = scene.first_bin_of("sand", scene.beam_at(0));
  ASSERT_GE(first, 0);
  const double steepest = std::sin(radians_from_degrees(23));
  EXPECT_GT(scene.sonar().bin_range(first), 7.4 / steepest);
  EXPECT_LT(scene.sonar().bin_range(first), 8.6 / steepest);
}

// The starboard side, 6 m from the middle line, faces the sonar; plates bulge and have dents of a few decimetres.
TEST(FerrySceneTest, TheHullLiesAtItsRange) {
  const ScenePing scene("ferry");
  for (const double along : {20.0, 26.0, 32.0, 38.0}) {
    const ScenePing::Sighting side = scene.sighting(kWorldFromWreck * Vec3(along, -6, 3.5));
    ASSERT_LT(std::abs(side.elevation), radians_from_degrees(10)) << along;
    const int first = scene.first_bin_of("wreck", scene.beam_at(side.azimuth));
    ASSERT_GE(first, 0) << along;
    EXPECT_NEAR(scene.sonar().bin_range(first), side.range, 1.0) << along;
  }
}

// Ripples of the bed's normal map are about a metre from crest to crest along the current, nearly the sonar's x axis.
// Along a beam over open sand the intensity has the same period.
TEST(FerrySceneTest, RipplesShowAboutOnceAMetre) {
  const ScenePing scene("ferry", [](Scenario& scenario) { scenario.secondary = SecondaryEchoes::kNone; });
  const Ping& ping = scene.ping();
  double crests = 0, metres = 0;
  for (int beam = scene.beam_at(radians_from_degrees(42)); beam < scene.beam_at(radians_from_degrees(36)); ++beam) {
    const int first = scene.bin_at(26), last = scene.bin_at(34);
    const auto smooth = [&](int bin) {
      double sum = 0;
      for (int i = -3; i <= 3; ++i) {
        sum += ping.intensity[ping.index(bin + i, beam)];
      }
      return sum;
    };
    for (int bin = first; bin < last; ++bin) {
      double highest = 0;
      for (int i = -7; i <= 7; ++i) {
        highest = std::max(highest, smooth(bin + i));
      }
      crests += smooth(bin) == highest ? 1 : 0;
    }
    metres += (last - first) * scene.sonar().bin_length();
  }
  // Slant ranges lengthen the ripples by less than a tenth; the beam is some 30 degrees off the current.
  EXPECT_GT(crests / metres, 0.7);
  EXPECT_LT(crests / metres, 1.3);
}

}  // namespace
}  // namespace insonify::tank_and_ferry_scene_test
