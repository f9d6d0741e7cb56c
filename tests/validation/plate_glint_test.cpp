// plate_glint_test.cpp -- pings of smooth plates, walls and boxes: mirrors near, plates of A^2/lambda^2 far, and only
// when they are seen head on.

#include "support/prism.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::plate_glint_test {
namespace {

constexpr double kSpeed = 1500;

Material polished(double rms_height) {
  Material material = glinting(0.8, 0.05);
  material.rms_height = rms_height;
  return material;
}

SonarConfig sonar_at(double distance) {
  SonarConfig sonar;
  sonar.frequency = 720e3;
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 32 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = distance - 1;
  sonar.max_range = distance + 1;
  sonar.bin_count = 100;
  sonar.sampling = {4, 400};
  return sonar;
}

Scenario scenario_at(double distance, const Method& method) {
  Scenario scenario = calibrated(sonar_at(distance), method);
  scenario.water.sound_speed = kSpeed;
  return scenario;
}

class PlateGlintTest : public testing::TestWithParam<Method> {};

// 1 m at 50 m: 30.29 dB by Fresnel's integrals (TS), so -37.67 dB at that range for |R| = 1. 0.2 m at 60 m: A^2 /
// lambda^2 = 25.69 dB, less 10 log10(1 - pi^2 u^4 / 45), 0.10 dB, for each side, u = 0.566 being its edges' argument. A
// wall is a mirror, -20 log10(2 r).
TEST_P(PlateGlintTest, HasTheEchoOfFresnelsIntegrals) {
  struct Case {
    double side, distance, level;
  };
  for (const Case& c : {Case{1, 50, 30.29 - 40 * std::log10(50)}, Case{0.2, 60, 25.49 - 40 * std::log10(60)},
                        Case{30, 7, -20 * std::log10(14)}}) {
    const Ping ping = ping_of(scenario_at(c.distance, GetParam()), plate_at(c.distance, c.side, polished(1e-6)));
    EXPECT_NEAR(total_db(ping) - 20 * std::log10(0.8), c.level, 0.15) << c.side;
  }
}

// What is not coherent stays in the lobe: together a wall has the mirror's echo, whatever its roughness; the glint in
// one cell has e^-g of it. By hand: h = 0.1 mm, k = 3015.9 per m, g = 0.36383.
TEST_P(PlateGlintTest, SharesTheEchoOfAWallWithItsLobe) {
  constexpr double kDistance = 6, kMirror = -23.5218;  // 20 log10(0.8 / 12)
  SonarConfig sonar = sonar_at(kDistance);
  sonar.elevation_aperture = 32 * kDegree;
  Scenario scenario = scenario_at(kDistance, GetParam());
  scenario.sonars = {sonar};
  for (const auto& [height, glint_db] : {std::pair(1e-6, 0.0), std::pair(1e-4, -1.5801), std::pair(2e-4, -6.3204)}) {
    const Ping ping = ping_of(scenario, plate_at(kDistance, 30, polished(height)));
    EXPECT_NEAR(total_db(ping), kMirror, 0.3) << height;
    const float most = *std::ranges::max_element(ping.intensity);
    const double lobe_share = 1 - std::pow(10, glint_db / 10);
    EXPECT_GE(10 * std::log10(most) - kMirror, glint_db - 0.2) << height;
    EXPECT_LE(10 * std::log10(most) - kMirror, 10 * std::log10(std::pow(10, glint_db / 10) + 0.2 * lobe_share))
        << height;
  }
}

// A plate of 0.5 m at 40 m is dark once it is turned by a degree and a half; by the lobe alone it would lose tan^2 / (2
// s^2), 0.60 dB.
TEST_P(PlateGlintTest, IsSeenHeadOnOnly) {
  const auto level = [&](double degrees, double height) {
    return total_db(ping_of(scenario_at(40, GetParam()), plate_at(40, 0.5, polished(height), degrees * kDegree)));
  };
  EXPECT_LT(level(1.5, 1e-6), level(0, 1e-6) - 20);
  EXPECT_NEAR(level(1.5, 5e-3), level(0, 5e-3) - 0.6, 0.2);
  EXPECT_GT(level(0, 1e-6), level(0, 5e-3) + 6);
}

// Through array, pulse and bins that are coarser or finer than it, a glint is a point's echo.
TEST_P(PlateGlintTest, ReachesTheReceiverAsAPointDoes) {
  for (const int bins : {40, 400}) {
    Scenario scenario = scenario_at(50, GetParam());
    scenario.sonars[0].bin_count = bins;
    scenario.receiver.azimuth_pattern = BeamPattern::kHann;
    scenario.receiver.pulse = PulseKind::kLfm;
    scenario.receiver.pulse_duration = 50e-6;
    const Ping plate = ping_of(scenario, plate_at(50, 1, polished(1e-6)));
    scenario.points = {{.position = {50, 0, 0}, .target_strength_db = 30.29 + 20 * std::log10(0.8)}};
    Scene behind = plate_at(80, 1, diffuse(-10));
    const Ping point = ping_of(scenario, behind);
    const double plate_peak = 10 * std::log10(*std::ranges::max_element(plate.intensity)),
                 point_peak = 10 * std::log10(*std::ranges::max_element(point.intensity));
    EXPECT_NEAR(plate_peak, point_peak, 0.2) << bins;
  }
}

// A face of 0.96 m, with sharp edges and with chamfers or rounded edges as mesh files have them, without vertex
// normals: head on the same mirror, within what the edges' ripples change, turned by 5 degrees as dark.
TEST_P(PlateGlintTest, IsThatOfAFaceWithRoundedEdgesToo) {
  const auto level = [&](Mesh mesh, double degrees) {
    (void)clean_mesh(mesh);
    const Pose pose{.position = {10.5, 0, 0}, .orientation = orientation_from_rpy(0, 0, degrees * kDegree)};
    return total_db(ping_of(scenario_at(10, GetParam()), scene_of(std::move(mesh), polished(1e-6), pose)));
  };
  for (const int steps : {1, 3}) {
    const Mesh sharp = make_box({1, 0.96, 1}), rounded = prism(rounded_square(1, 0.02, steps), 1);
    EXPECT_NEAR(level(rounded, 0), level(sharp, 0), 0.5) << steps;
    EXPECT_LT(level(rounded, 5), level(sharp, 5) + 3) << steps;
  }
}

// A box shows the face that the sonar is square to; something before it hides the glint. The face's four edges, 1.43
// degrees off their mirror's directions, are seen beside it: each 10 log10((.8 / (4 pi tan))^2 lambda/(2 r^3)) = -60.73
// dB, within Fresnel's ripples by the ends of each.
TEST_P(PlateGlintTest, IsHiddenByWhatIsBefore) {
  const Scene box = scene_of(make_box({1, 1, 1}), polished(1e-6), {.position = {20.5, 0, 0}});
  const double clear = total_db(ping_of(scenario_at(20, GetParam()), box));
  EXPECT_NEAR(clear, 20 * std::log10(0.8 / 40), 3);
  const Scene both = scene_of_all({box, sphere_at({15, 0, 0}, 0.3, diffuse(-60), 0.4)});
  EXPECT_NEAR(total_db(ping_of(scenario_at(20, GetParam()), both)), -60.73 + 6.02, 1);
}

// Half a wall at 7 m is hidden by a screen whose straight edge, 0.1 m before it, is seen u sqrt(lambda r) / 2 beside
// the foot of the perpendicular. What is left is |(1/2 + C(u)) + i (1/2 + S(u))|^2 / 2 of the mirror, with C and S from
// tables: at u = 0 a quarter, for u = 1 more than without the screen. So for edges along both sides of the wall, and
// for a turned one.
TEST_P(PlateGlintTest, IsPartlyHidden) {
  constexpr double kWall = 7, kScreen = 6.9, kUnit = 0.0603807;  // sqrt(1500 / 720e3 * 7) / 2
  const Scene wall = plate_at(kWall, 30, polished(1e-6));
  const Scenario scenario = scenario_at(kWall, GetParam());
  const double clear = total_db(ping_of(scenario, wall));
  const auto screened = [&](double u, double roll) {
    Scene screen = plate_at(kScreen, 4, diffuse(-90));
    Pose& pose = screen.instances[0].world_from_mesh;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(roll, Vec3::UnitX()));
    pose.position = turn * Vec3(kScreen, u * kUnit * kScreen / kWall + 2, 0);
    pose.orientation = turn * pose.orientation;
    return total_db(ping_of(scenario, scene_of_all({wall, screen}))) - clear;
  };
  for (const double roll : {0.0, 90 * kDegree, 212 * kDegree}) {
    EXPECT_NEAR(screened(-1, roll), -13.86, 1.4) << roll;
    EXPECT_NEAR(screened(0, roll), -6.02, 0.5) << roll;
    EXPECT_NEAR(screened(0.4, roll), -2.64, 0.9) << roll;
    EXPECT_NEAR(screened(1, roll), 1.00, 0.5) << roll;
  }
}

// A wall that ends at u = 2 beside the foot of the perpendicular, hidden below u = 0.5: |F(0.5, 2)|^2 / |F(-inf, 2)|^2,
// with C + i S = .4923 + .0647 i at 0.5 and .4883 + .3434 i at 2. Hidden on the wrong side it would be -9.5 dB.
TEST_P(PlateGlintTest, IsPartlyHiddenBesideItsEdge) {
  constexpr double kUnit = 0.0603807;
  Scene wall = plate_at(7, 30, polished(1e-6)), screen = plate_at(6.9, 4, diffuse(-90));
  wall.instances[0].world_from_mesh.position.y() = 2 * kUnit - 15;
  screen.instances[0].world_from_mesh.position.y() = 0.5 * kUnit * 6.9 / 7 - 2;
  const Scenario scenario = scenario_at(7, GetParam());
  EXPECT_NEAR(total_db(ping_of(scenario, scene_of_all({wall, screen}))) - total_db(ping_of(scenario, wall)), -13.37,
              1.4);
}

// The same quarter through array, pulse, bins coarser and finer than it, and while the sonar moves.
TEST_P(PlateGlintTest, IsPartlyHiddenForEveryReceiver) {
  const Scene wall = plate_at(7, 30, polished(1e-6));
  Scene screen = plate_at(6.9, 4, diffuse(-90));
  screen.instances[0].world_from_mesh.position.y() = 2;
  for (const int bins : {40, 400}) {
    Scenario scenario = scenario_at(7, GetParam());
    scenario.sonars[0].bin_count = bins;
    scenario.receiver.azimuth_pattern = BeamPattern::kHann;
    scenario.receiver.pulse = PulseKind::kLfm;
    scenario.receiver.pulse_duration = 50e-6;
    scenario.motion_in_ping = true;
    scenario.trajectory.waypoints = {{.time = 0}, {.time = 1, .position = {0.5, 0, 0}}};
    EXPECT_NEAR(total_db(ping_of(scenario, scene_of_all({wall, screen}))) - total_db(ping_of(scenario, wall)), -6.02,
                0.5)
        << bins;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, PlateGlintTest, testing::Values(kRays, kRaster, kReference),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace insonify::validation::plate_glint_test
