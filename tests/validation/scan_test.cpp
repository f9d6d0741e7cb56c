// scan_test.cpp -- T15 of docs/concepts/physics-tests.md: distortion of static targets in the picture of a scanning
// sonar on a moving vehicle.

#include "validation/calibrated_scene.h"

namespace insonify::validation::scan_test {
namespace {

class ScanTest : public testing::TestWithParam<Method> {};

constexpr double kStep = 0.9 * kDegree;
constexpr int kPings = 400;  // A full circle.

// A head that steps by its beam's width once in 2 x 30 / 1500 = 0.04 s: a circle takes 16 s.
SonarConfig head() {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = kStep;
  sonar.elevation_aperture = 10 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 30;
  sonar.bin_count = 600;
  sonar.head.step = kStep;
  sonar.sampling = {1, 2};
  return sonar;
}

// Position of a target in the picture, drawn at the head's angle and the echo's range as if the vehicle had not moved.
struct Shown {
  int pings = 0;  // Number of pings that received it.
  double bearing = 0, range = 0;
};

Shown scan(const Method& method, const Vec3& target, const Waypoint& after_a_circle) {
  Scenario scenario = calibrated(head(), method);
  scenario.water.sound_speed = 1500;
  scenario.points = {{.position = target}};
  scenario.trajectory.waypoints = {{.time = 0}, after_a_circle};
  Simulator simulator(scenario, {}, 1);
  Shown shown;
  for (int number = 0; number < kPings; ++number) {
    const Ping ping = simulator.make_ping(0, number);
    EXPECT_NEAR(ping.time, 0.04 * number, 1e-9);
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      if (ping.intensity[bin] > 0) {
        ++shown.pings;
        shown.bearing = ping.head_angle;
        shown.range = simulator.sonar(0).bin_range(bin);
      }
    }
  }
  return shown;
}

void expect_shown(const Shown& shown, double bearing, double range) {
  EXPECT_EQ(shown.pings, 1);
  EXPECT_NEAR(shown.bearing, bearing, 0.5 * kStep + 1e-6);
  EXPECT_NEAR(shown.range, range, 0.5 * head().bin_length() + 1e-6);
}

// Without motion targets appear at their positions. Ranges are chosen off the edges of bins.
TEST_P(ScanTest, ShowsTargetsAtTheirPositionsWhenNothingMoves) {
  const Waypoint still{.time = 16};
  expect_shown(scan(GetParam(), {0, 10.01, 0}, still), 90 * kDegree, 10.01);
  expect_shown(scan(GetParam(), {-10.01, 0.01, 0}, still), 180 * kDegree, 10.01);
  expect_shown(scan(GetParam(), {0, -10.01, 0}, still), 270 * kDegree, 10.01);
}

// The vehicle moves at 0.5 m/s along +x.
TEST_P(ScanTest, ForwardMotionShearsThePicture) {
  const Waypoint ahead{.time = 16, .position = {8, 0, 0}};
  const auto expect_at = [&](const Vec3& target, double x, double y) {
    const double bearing = std::atan2(y, x);
    expect_shown(scan(GetParam(), target, ahead), bearing < 0 ? bearing + 360 * kDegree : bearing, std::hypot(x, y));
  };
  expect_at({0, 10, 0}, -2.237413887042213, 10.009614333133452);
  expect_at({-10, 0.02, 0}, -14, 0.02);  // A little to port: straight astern is the border of two bins.
  expect_at({0, -10, 0}, -5.313515601411355, -10.035484639695191);
}

// The vehicle turns to port at 2 degrees/s while the head turns at 22.5: targets appear at smaller head angles.
TEST_P(ScanTest, TurningShiftsBearings) {
  const Waypoint turned{.time = 16, .orientation = {0, 0, 32 * kDegree}};
  expect_shown(scan(GetParam(), {0, 10.01, 0}, turned), 82.8 * kDegree, 10.01);
  expect_shown(scan(GetParam(), {-10.01, 0, 0}, turned), 165.6 * kDegree, 10.01);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, ScanTest, testing::Values(kReference, kRays), kName);

}  // namespace
}  // namespace insonify::validation::scan_test
