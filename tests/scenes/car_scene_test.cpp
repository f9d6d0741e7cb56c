// car_scene_test.cpp -- ranges, bearings and shadows of the car scene against its geometry.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "scenes/scene_scan.h"

namespace insonify::car_scene_test {
namespace {

using testing_scenes::SceneScan;

// As in scenes/car.yaml and car.sdf: the sonar 3 m above the origin, looking along x and 17 degrees down, with a beam
// 1.5 degrees wide; the car's left side faces it.
constexpr double kSonarHeight = 3;
constexpr double kTilt = radians_from_degrees(17);
constexpr double kHalfBeam = radians_from_degrees(0.75);

Vec3 world_from_car(const Vec3& p) {
  const auto turn = [](double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(radians_from_degrees(degrees), axis);
  };
  return Vec3(6.6, 0.2, -0.17) + turn(112, Vec3::UnitZ()) * (turn(-3, Vec3::UnitY()) * (turn(6, Vec3::UnitX()) * p));
}

// Range and head angle of a point of the world.
struct Sighting {
  double range, bearing_deg;
};
Sighting sighting_of(const Vec3& p) {
  const Vec3 way = p - Vec3(0, 0, kSonarHeight);
  const double ahead = way.x() * std::cos(kTilt) - way.z() * std::sin(kTilt);
  return {way.norm(), degrees_from_radians(std::atan2(way.y(), ahead))};
}

double two_bins(const SceneScan& scan) {
  return 2 * scan.sonar().bin_length();
}

TEST(CarSceneTest, LostWheelLiesWhereItWasPut) {
  // 4.55 m ahead, 2.35 m to port, about 0.1 m over the mean bed; its tyre is 0.31 m in radius. The bed's waves and the
  // wheel's tilt change its range by less than 0.1 m.
  SceneScan scan("car");
  const Sighting wheel = sighting_of({4.55, 2.35, 0.1});
  const Ping ping = scan.ping_at(wheel.bearing_deg);
  const auto rim = scan.first_echo(ping, "debris", wheel.range - 1);
  ASSERT_TRUE(rim);
  EXPECT_NEAR(*rim, wheel.range - 0.31 * std::cos(std::asin(2.9 / wheel.range)), 0.1);

  // Its width is that of a tyre: atan(0.31 / 5.9) = 3.0 degrees to each side, plus half a beam and a step.
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(scan.first_echo(scan.ping_at(wheel.bearing_deg + 2 * side), "debris", wheel.range - 0.5)) << side;
    const auto beside = scan.first_echo(scan.ping_at(wheel.bearing_deg + 4.5 * side), "debris", wheel.range - 0.5);
    EXPECT_TRUE(!beside || *beside > wheel.range + 0.5) << side;
  }
}

TEST(CarSceneTest, LeftRearWingLiesAtItsRange) {
  // The nearest point within the beam on the flat of the wing behind its wheel, by brute force: 0.81 m from the car's
  // middle, 0.3 to 0.85 m above the feet of the wheels. It is rounded by 3 cm and dented by 3.
  SceneScan scan("car");
  const double bearing = sighting_of(world_from_car({-1.95, 0.81, 0.55})).bearing_deg;
  double nearest = std::numeric_limits<double>::infinity();
  for (double x = -2.2; x <= -1.72; x += 0.005) {
    for (double z = 0.3; z <= 0.85; z += 0.01) {
      const Sighting point = sighting_of(world_from_car({x, 0.81, z}));
      if (std::abs(point.bearing_deg - bearing) < degrees_from_radians(kHalfBeam)) {
        nearest = std::min(nearest, point.range);
      }
    }
  }
  const auto wing = scan.first_echo(scan.ping_at(bearing), "car");
  ASSERT_TRUE(wing);
  EXPECT_NEAR(*wing, nearest, 0.06 + two_bins(scan));
}

TEST(CarSceneTest, RoofThrowsAShadowAsLongAsItsHeightSays) {
  // The undamaged left half of the roof determines the end of the shadow along the bearing of its middle, whichever of
  // its points casts it furthest. It is 1.38 m high at its rail (y = 0.45 m) and 1.42 m in the middle; the crushed part
  // reaches y = 0.35 m.
  SceneScan scan("car");
  const double bearing = sighting_of(world_from_car({-0.35, 0.4, 1.39})).bearing_deg;
  double end = 0;  // Horizontal range.
  for (double x = -0.8; x <= 0.1; x += 0.01) {
    for (double y = 0.30; y <= 0.45; y += 0.01) {
      const Vec3 p = world_from_car({x, y, 1.39});
      if (std::abs(sighting_of(p).bearing_deg - bearing) < degrees_from_radians(kHalfBeam)) {
        const double range = std::hypot(p.x(), p.y());
        const double shadow = p.z() * range / (kSonarHeight - p.z());
        end = std::max(end, range + shadow);
      }
    }
  }
  const Ping ping = scan.ping_at(bearing);
  const double slant = std::hypot(end, kSonarHeight);
  const auto lit = scan.first_echo(ping, "seabed", 10.0);  // Beyond the car.
  ASSERT_TRUE(lit);
  EXPECT_NEAR(*lit, slant, 0.35);  // The bed's waves, 0.1 m high, shift it by up to 0.5 m where rays fall one in five;
                                   // most of the bed is level.
}

TEST(CarSceneTest, StrongestEchoesAreNotTheSands) {
  SceneScan scan("car");
  for (double bearing = -12; bearing <= 14; bearing += 2) {
    const Ping ping = scan.ping_at(bearing);
    const int strongest = SceneScan::strongest_bin(ping);
    EXPECT_FALSE(scan.is_of(ping, strongest, "seabed")) << bearing;
    EXPECT_NE(scan.material(ping, strongest), "sand") << bearing;
    EXPECT_GT(ping.intensity[strongest], 0.9F) << bearing;
  }
}

TEST(CarSceneTest, OneSeesTheSeatsThroughTheDoorWays) {
  // Among the echoes of the car's middle are those of its upholstery.
  SceneScan scan("car");
  int bins = 0;
  for (double bearing = -5; bearing <= 8; bearing += 0.45) {
    const Ping ping = scan.ping_at(bearing);
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      bins += scan.is_of(ping, bin, "car") && scan.material(ping, bin) == "upholstery" ? 1 : 0;
    }
  }
  EXPECT_GT(bins, 150);  // Seen from the right, where the doors are shut, it is a few dozen.
}

}  // namespace
}  // namespace insonify::car_scene_test
