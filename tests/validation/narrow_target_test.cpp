// narrow_target_test.cpp -- round bodies from a tenth of a column to four columns wide, at the default sampling: the
// level of every single ping. Columns are 0.234 degrees apart: 0.16 m at 40 m.

#include "validation/small_targets.h"

namespace insonify::validation::narrow_target_test {
namespace {

SonarConfig default_sonar(double max_range) {
  SonarConfig sonar;
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 15 * kDegree;
  sonar.elevation_aperture = 6 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = max_range;
  sonar.bin_count = 1000;
  return sonar;
}

// Over 0.72 m, of which each step is another place among the columns and rows.
Vec3 offset_of(int place) {
  return {0, 0.031 * (place - 12), 0.013 * (place * 7 % kPlaces - 12)};
}

Levels levels_of(const Scenario& scenario, const Scene& scene) {
  return validation::levels_of(scenario, scene, 1, offset_of, whole);
}

class NarrowTargetTest : public testing::TestWithParam<Method> {};
class NarrowTargetEffectTest : public testing::TestWithParam<Method> {};

struct Ball {
  double radius, distance, slope, lambert_db;
};

TEST_P(NarrowTargetTest, BallsHaveTheirTargetStrengthInEveryPing) {
  for (const Ball& ball : {Ball{0.01905, 12, 0.05, -40}, Ball{0.048, 33, 0.02, -40}, Ball{0.055, 25, 0.05, -30},
                           Ball{0.075, 40, 0.05, -40}, Ball{0.1, 61, 0.1, -28}, Ball{0.15, 52, 0.01, -50},
                           Ball{0.22, 70, 0.05, -30}, Ball{0.4, 90, 0.03, -35}}) {
    Material material = glinting(kReflection, ball.slope);
    material.lambert_db = ball.lambert_db;
    const Levels levels = levels_of(calibrated(default_sonar(ball.distance + 5), GetParam()),
                                    sphere_at({ball.distance, 0, 0}, ball.radius, material, 0.26));
    EXPECT_NEAR(levels.mean_db,
                10 * std::log10(ball_intensity(ball.radius, ball.distance, ball.slope, ball.lambert_db)), 0.25)
        << ball.radius << " m at " << ball.distance;
    EXPECT_LE(levels.spread_db, 0.5) << ball.radius << " m at " << ball.distance;
  }
}

// A ball is one body whether its triangles are given once, twice, or on both sides, whichever is given first.
TEST_P(NarrowTargetEffectTest, BallsGivenTwiceEchoOnce) {
  for (const double radius : {0.02, 0.15}) {
    const double distance = 200 * radius + 10;
    const Mesh ball = make_sphere(radius, 0.26);
    const auto copied = [&](bool first, bool second) {  // Whether each copy is turned inwards.
      Mesh mesh = ball;
      mesh.triangles.clear();
      for (const bool turned : {first, second}) {
        for (const auto& [a, b, c] : ball.triangles) {
          mesh.triangles.push_back({a, turned ? c : b, turned ? b : c});
        }
      }
      EXPECT_EQ(clean_mesh(mesh).dropped(), 0U);
      return mesh;
    };
    for (const Mesh& mesh : {copied(false, false), copied(false, true), copied(true, false)}) {
      const Levels levels = levels_of(calibrated(default_sonar(distance + 5), GetParam()),
                                      scene_of(mesh, glinting(kReflection, 0.05), {.position = {distance, 0, 0}}));
      EXPECT_NEAR(levels.mean_db, 10 * std::log10(ball_intensity(radius, distance, 0.05, -200)), 0.25) << radius;
    }
  }
}

// An ellipsoid along an axis of length a: |R|^2 R1 R2 / 4 with the radii of curvature R1 = b^2 / a and R2 = c^2 / a,
// less by 1 + R / r for each at the range r to its front.
double ellipsoid_db(const Vec3& radii, double distance) {
  const double range = distance - radii.x();
  const double one = radii.y() * radii.y() / radii.x(), two = radii.z() * radii.z() / radii.x();
  return 10 * std::log10(kReflection * kReflection * one * two / 4 / std::pow(range, 4) /
                         ((1 + one / range) * (1 + two / range)));
}

// Bins of normals 15 degrees wide blur how the curvature varies: more where the body is longer. The last one is too
// long to be one piece; its end is found by the rays along it.
TEST_P(NarrowTargetTest, EllipsoidsHaveTheirTargetStrengthFromAllSides) {
  struct Ellipsoid {
    Vec3 radii;
    double tolerance_db;
  };
  for (const Ellipsoid& ellipsoid : {Ellipsoid{{0.3, 0.16, 0.16}, 0.9}, Ellipsoid{{0.16, 0.3, 0.16}, 0.9},
                                     Ellipsoid{{0.16, 0.16, 0.3}, 0.9}, Ellipsoid{{0.45, 0.15, 0.15}, 1.4}}) {
    for (const double distance : {30.0, 60.0}) {
      const Levels levels = levels_of(
          calibrated(default_sonar(distance + 5), GetParam()),
          scene_of(make_ellipsoid(ellipsoid.radii, 0.15), glinting(kReflection, 0.05), {.position = {distance, 0, 0}}));
      EXPECT_NEAR(levels.mean_db, ellipsoid_db(ellipsoid.radii, distance), ellipsoid.tolerance_db)
          << ellipsoid.radii.transpose() << " at " << distance << " m";
      EXPECT_LE(levels.spread_db, 0.5) << ellipsoid.radii.transpose() << " at " << distance << " m";
    }
  }
}

// The sphere of tungsten carbide by which echo sounders are calibrated, in the limit of geometrical optics: its
// impedance is 14 900 x 6 853 against that of water, |R| = 0.970 (Foote, J. Acoust. Soc. Am. 71, 742, 1982, for the
// material): 20 log10(0.01905 / 2) - 0.26 dB = -40.7 dB.
TEST_P(NarrowTargetTest, ASphereOfTungstenCarbideHasMinus40dB7) {
  Material carbide = glinting(0.970, 0.02);
  carbide.lambert_db = -60;
  const Levels levels =
      levels_of(calibrated(default_sonar(15), GetParam()), sphere_at({10, 0, 0}, 0.01905, carbide, 0.2));
  EXPECT_NEAR(levels.mean_db + 40 * std::log10(10 - 0.01905), -40.7, 0.2);
  EXPECT_LE(levels.spread_db, 0.5);
}

// A diffuse ball of which a plate hides the left half has half its echo, -3.01 dB. Of one in a floor up to its middle,
// seen along the floor, the upper half remains, too. Bins of 15 degrees are hidden as a whole: within 0.6 dB.
TEST_P(NarrowTargetTest, WhatIsHiddenOfABallDoesNotEcho) {
  constexpr double kDistance = 45, kRadius = 0.3;
  const Material nothing = diffuse(-200);
  const Scene ball = sphere_at({kDistance, 0, 0}, kRadius, diffuse(-12), 0.26);
  const Scene plate = scene_of(make_box({0.01, 2, 4}), nothing, {.position = {kDistance - 1, 1, 0}});
  const Scene floor = seabed_at(0, nothing);
  const Scenario scenario = calibrated(default_sonar(55), GetParam());
  const double free = total_db(ping_of(scenario, ball));
  EXPECT_NEAR(total_db(ping_of(scenario, scene_of_all({ball, plate}))) - free, -3.01, 0.6);
  PingRequest above;
  above.world_from_vehicle.position.z() = 0.1;
  Ping ping;
  Simulator(scenario, scene_of_all({ball, floor}), 2).ping(0, above, ping);
  EXPECT_NEAR(total_db(ping) - free, -3.01, 0.6);
}

// The echoes of a large ball's bins of normals meet in range: no gap in bins of 1 cm over the front 0.3 m.
TEST_P(NarrowTargetTest, ALargeBallHasNoGapsInRange) {
  constexpr double kDistance = 80, kRadius = 0.45;
  SonarConfig sonar = default_sonar(85);
  sonar.min_range = 75;
  const Ping ping = ping_of(calibrated(sonar, GetParam()), sphere_at({kDistance, 0, 0}, kRadius, diffuse(-12), 0.26));
  const int front = static_cast<int>((kDistance - kRadius - 75) * 100);
  for (int bin = front + 1; bin < front + 30; ++bin) {
    double sum = 0;
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      sum += ping.intensity[ping.index(bin, beam)];
    }
    EXPECT_GT(sum, 0) << bin - front << " cm behind the front";
  }
}

// Through an array and a pulse with bins coarser than it, moving, with absorption: the sum over cells is the ball's.
TEST_P(NarrowTargetEffectTest, BallsAreSteadyWithArrayPulseAndCoarseBins) {
  for (const int bins : {60, 700}) {
    SonarConfig sonar = default_sonar(50);
    sonar.bin_count = bins;
    Scenario scenario = calibrated(sonar, GetParam());
    scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
    scenario.receiver.pulse = PulseKind::kCw;
    scenario.receiver.pulse_duration = 120e-6;
    const Scene ball = sphere_at({41, 0.1, 0}, 0.07, glinting(kReflection, 0.05), 0.26);
    EXPECT_LE(levels_of(scenario, ball).spread_db, kMostSpread) << bins;
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, NarrowTargetTest, testing::Values(kRays, kRaster), kName);
INSTANTIATE_TEST_SUITE_P(Methods, NarrowTargetEffectTest, testing::Values(kRays), kName);

}  // namespace
}  // namespace insonify::validation::narrow_target_test
