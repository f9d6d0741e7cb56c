// head_side_lobes_test.cpp -- what a scanning head hears through its side lobes: points, small objects and large ones.

#include "validation/calibrated_scene.h"

namespace insonify::validation::head_side_lobes_test {
namespace {

class HeadSideLobesTest : public testing::TestWithParam<Method> {};

constexpr double kPi = std::numbers::pi;
constexpr double kLength = 0.8858929413781328;  // D / wavelength times 2 sin(width / 2), uniform line.
constexpr double kWidth = 3;                    // Width of the beam [deg].

// Peaks of the second and the sixth side lobe of sinc^4 [wavelength / D], and their levels [dB].
constexpr double kSecond = 2.45902, kSecondDb = -35.660842;
constexpr double kSixth = 6.48439, kSixthDb = -52.381658;

SonarConfig head() {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = kWidth * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 15;
  sonar.bin_count = 100;
  sonar.sampling = {32, 400};
  return sonar;
}

Scenario with_line(const Method& method) {
  Scenario scenario = calibrated(head(), method);
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  return scenario;
}

double lines() {
  return kLength / (2 * std::sin(0.5 * kWidth * kDegree));
}

// Azimuth at a distance in the pattern [rad].
double azimuth_at(double x) {
  return std::asin(x / lines());
}

double both_ways(double azimuth) {
  const double x = kPi * lines() * std::sin(azimuth);
  return std::abs(x) < 1e-9 ? 1 : std::pow(std::sin(x) / x, 4);
}

// A path by a mirror leaves towards one bearing and arrives from another: of sinc^2, once of each. A wall at y = 1 m
// shows a point at y = 0.3 m, 12 m ahead, 6.63 degrees beside itself.
TEST_P(HeadSideLobesTest, GhostsAreSentAndReceivedAtTheirOwnBearings) {
  Material mirror = glinting(1, 0.01);
  mirror.rms_height = 1e-7;
  const double there = std::atan2(0.3, 12.0), image = std::atan2(1.7, 12.0);
  const double straight = std::hypot(0.3, 12.0), around = std::hypot(1.7, 12.0);
  const auto once = [](double azimuth) { return std::sqrt(both_ways(azimuth)); };
  for (const double turned : {0.0, there, image}) {
    SonarConfig sonar = head();
    sonar.min_range = 11.8;
    sonar.max_range = 12.4;
    sonar.orientation = {0, 0, turned};
    Scenario scenario = with_line(GetParam());
    sonar.name = scenario.sonars[0].name;
    scenario.sonars = {sonar};
    scenario.secondary = SecondaryEchoes::kAll;
    scenario.max_surfaces = 2;
    scenario.points = {{.position = {12, 0.3, 0}, .target_strength_db = 20}};
    const std::vector<double> ping = by_range(ping_of(scenario, plane(-Vec3::UnitY(), {0, 1, 0}, mirror)));
    const auto bin = static_cast<std::size_t>((0.5 * (straight + around) - 11.8) / 0.006);
    const double level =
        20 + 10 * std::log10(2 * once(there - turned) * once(image - turned)) - 20 * std::log10(straight * around);
    EXPECT_NEAR(10 * std::log10(ping[bin]), level, 0.5) << turned;
  }
}

// The same of a surface: a small plate that faces the head, seen by a wall beside it. Its echo by the wall is the same
// out and back, and as much weaker as the head sends less towards the wall.
TEST_P(HeadSideLobesTest, SurfacesGhostsAreSentAndReceivedAtTheirOwnBearings) {
  Material mirror = glinting(1, 0.01);
  mirror.rms_height = 1e-7;
  const Scene scene =
      scene_of_all({plane(-Vec3::UnitY(), {0, 0.5, 0}, mirror),
                    scene_of(make_plane(-Vec3::UnitX(), 0.1, 0.1), diffuse(-10), {.position = {10, 0, 0}})});
  const double image = std::atan2(1.0, 10.0), around = std::hypot(1.0, 10.0);
  const auto received = [&](double turned) {
    SonarConfig sonar = head();
    sonar.min_range = 10.005;
    sonar.max_range = 10.045;  // Half-way between 10 m and 10.0499 m is 10.0249 m.
    sonar.orientation = {0, 0, turned};
    Scenario scenario = with_line(GetParam());
    sonar.name = scenario.sonars[0].name;
    sonar.sampling = {64, 400};
    scenario.sonars = {sonar};
    scenario.secondary = SecondaryEchoes::kAll;
    scenario.max_surfaces = 2;
    return total_db(ping_of(scenario, scene));
  };
  const auto once = [](double azimuth) { return std::sqrt(both_ways(azimuth)); };
  for (const double turned : {0.0, 0.2 * image, 0.8 * image, image}) {
    // mu A cos(in) cos(out) / (10^2 around^2), of both paths.
    const double level = -10 + 10 * std::log10(2 * 0.01 * 10 / around / (100 * around * around)) +
                         10 * std::log10(once(turned) * once(image - turned));
    EXPECT_NEAR(received(turned), level, 1) << turned;
  }
}

TEST_P(HeadSideLobesTest, PointsAreHeardDownToSixtyDecibels) {
  for (const auto& [x, level] : {std::pair(kSecond, kSecondDb), std::pair(kSixth, kSixthDb)}) {
    for (const double side : {1, -1}) {
      Scenario scenario = with_line(GetParam());
      scenario.points = {
          {.position = point_from_spherical({10.03, side * azimuth_at(x), 0}), .target_strength_db = -5}};
      EXPECT_NEAR(total_db(ping_of(scenario, {})), -5 - 40 * std::log10(10.03) + level, 0.01) << x;
    }
  }
}

// A Lambert sphere of 5 cm at 10 m is 0.17 wavelength / D wide; at the peak of a lobe it is at most 0.3 dB below it.
TEST_P(HeadSideLobesTest, SmallObjectsHaveTheLevelOfTheirLobe) {
  Scenario scenario = with_line(GetParam());
  scenario.sonars[0].elevation_aperture = 4 * kDegree;
  const Scene sphere = sphere_at(point_from_spherical({10, azimuth_at(kSecond), 0}), 0.05, diffuse(-10));
  const double strength = 10 * std::log10(2 * kPi * 0.1 * 0.05 * 0.05 / 3) - 40;
  EXPECT_NEAR(total_db(ping_of(scenario, sphere)), strength + kSecondDb - 0.1, 0.4);
}

// A Lambert plate that faces the sonar from 24.19 degrees off, 12 degrees wide, covers lobes 5 to 8: their sum, by
// quadrature over the plate. It fills four cells that are as wide as the beam, from 18.19 to 30.19 degrees.
TEST_P(HeadSideLobesTest, LargeObjectsSumTheLobesTheyCover) {
  constexpr double kDistance = 10;
  const double middle = 24.1875 * kDegree, side = 2 * kDistance * std::tan(6 * kDegree);
  Scene scene = plate_at(kDistance, side, diffuse(-10));
  scene.instances[0].world_from_mesh = {point_from_spherical({kDistance, middle, 0}),
                                        orientation_from_rpy(0, 0, middle)};
  double sum = 0;
  constexpr int kSteps = 800;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps / 8; ++j) {
      const double across = ((i + 0.5) / kSteps - 0.5) * side, up = ((j + 0.5) / (kSteps / 8) - 0.5) * side;
      const double square = kDistance * kDistance + across * across + up * up;
      const double cosine = kDistance / std::sqrt(square);
      sum += 0.1 * cosine * cosine / (square * square) * both_ways(middle + std::atan2(across, kDistance));
    }
  }
  sum *= side * side / (kSteps * (kSteps / 8));
  EXPECT_NEAR(total_db(ping_of(with_line(GetParam()), scene)), 10 * std::log10(sum), 0.3);
}

// With speckle the mean of 300 seeds has a standard deviation of at most 6 %; wide cells receive energy, too.
TEST(HeadSideLobesSpeckleTest, SpeckleKeepsTheMeanOfWideCells) {
  Scenario scenario = with_line(kRays);
  scenario.sonars[0].sampling = {8, 60};
  Scene scene = plate_at(10, 2.4, diffuse(-10));
  scene.instances[0].world_from_mesh = {point_from_spherical({10, 21 * kDegree, 0}),
                                        orientation_from_rpy(0, 0, 21 * kDegree)};
  const double mean = std::pow(10, 0.1 * total_db(ping_of(scenario, scene)));
  scenario.receiver.speckle = true;
  double sum = 0;
  for (scenario.seed = 1; scenario.seed <= 300; ++scenario.seed) {
    sum += std::pow(10, 0.1 * total_db(ping_of(scenario, scene)));
  }
  EXPECT_NEAR(sum / 300 / mean, 1, 0.18);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, HeadSideLobesTest, testing::Values(kRays, kRaster), kName);

}  // namespace
}  // namespace insonify::validation::head_side_lobes_test
