// reverberation_test.cpp -- pings with random walks: levels behind the walls of a tank, path orders, seeds, engines and
// settings that do not go together.

#include <gmock/gmock.h>

#include "insonify/error.h"
#include "support/same_pings.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::reverberation_test {
namespace {

// A tank of 2.4 x 1.6 x 1.1 m; the sonar looks at the wall 1.9 m ahead.
Scene tank() {
  Material wall = glinting(0.85, 0.12);
  wall.lambert_db = -14;
  return scene_of(make_box({2.4, 1.6, 1.1}), wall, {});
}

constexpr double kWallAhead = 1.9;

Scenario in_tank(const Method& method, int walks) {
  SonarConfig sonar;
  sonar.beam_count = 48;
  sonar.azimuth_aperture = 40 * kDegree;
  sonar.elevation_aperture = 12 * kDegree;
  sonar.min_range = 0.2;
  sonar.max_range = 5;
  sonar.bin_count = 240;
  sonar.sampling = {4, 60};
  sonar.position = {1.2 - kWallAhead, 0.1, -0.05};
  Scenario scenario = calibrated(sonar, method);
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.ground_truth = GroundTruth::kFull;
  scenario.random_walks = walks;
  return scenario;
}

// Mean intensity over all beams and an interval of range.
double mean_between(const Ping& ping, const SonarConfig& sonar, double near, double far) {
  double sum = 0;
  int count = 0;
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    for (int beam = 0; beam < ping.beam_count && sonar.bin_range(bin) >= near && sonar.bin_range(bin) < far; ++beam) {
      sum += ping.intensity[ping.index(bin, beam)];
      ++count;
    }
  }
  return sum / count;
}

class ReverberationTest : public testing::TestWithParam<Method> {};

// Diffuse walls, so that nothing but walks comes from behind the wall: mirrors would also show the walls' images there.
TEST_P(ReverberationTest, LevelBehindTheWallIsAboveThatBeforeIt) {
  const Scene scene = scene_of(make_box({2.4, 1.6, 1.1}), diffuse(-8), {});
  const Scenario scenario = in_tank(GetParam(), 3000);
  const SonarConfig& sonar = scenario.sonars[0];
  const Ping ping = ping_of(scenario, scene), silent = ping_of(in_tank(GetParam(), 0), scene);
  const double wall = mean_between(ping, sonar, kWallAhead - 0.05, kWallAhead + 0.1);
  const double behind = mean_between(ping, sonar, 1.2 * kWallAhead, 2 * kWallAhead);
  const double before = mean_between(ping, sonar, 0.3, 0.8 * kWallAhead);
  EXPECT_GT(behind, 30 * before);
  EXPECT_LT(behind, 0.1 * wall);
  EXPECT_GT(behind, 1e-4 * wall);
  EXPECT_EQ(mean_between(silent, sonar, 1.2 * kWallAhead, 2 * kWallAhead), 0);
}

// Behind the wall most of the echo has met three surfaces or more, and walks are no direct echoes.
TEST_P(ReverberationTest, PathOrdersAreThoseOfTheWalks) {
  const Scenario scenario = in_tank(GetParam(), 20'000);
  const SonarConfig& sonar = scenario.sonars[0];
  const Ping ping = ping_of(scenario, tank()), silent = ping_of(in_tank(GetParam(), 0), tank());
  int filled = 0, third = 0;
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    for (int beam = 0; beam < ping.beam_count && sonar.bin_range(bin) > 1.5 * kWallAhead; ++beam) {
      const std::size_t cell = ping.index(bin, beam);
      filled += ping.path_order[cell] > 0 ? 1 : 0;
      third += ping.path_order[cell] == 3 ? 1 : 0;
      EXPECT_EQ(ping.path_order[cell] > 0, ping.intensity[cell] > 0);
    }
  }
  EXPECT_GT(filled, 0.6 * 48 * 100);
  EXPECT_GT(third, 0.95 * filled);
  EXPECT_EQ(ping.direct_intensity, silent.direct_intensity);
}

// A sonar that stands still has the same walks in every ping; waves reflect them differently in each.
TEST_P(ReverberationTest, WalksDependOnSeedSonarAndPlaceAlone) {
  const Scenario scenario = in_tank(GetParam(), 300);
  Simulator simulator(scenario, tank(), 2);
  const Ping third = simulator.make_ping(0, 3);
  EXPECT_EQ(simulator.make_ping(0, 4).intensity, third.intensity);
  expect_same(simulator.make_ping(0, 3), third);
  for (const double wind : {0.0, 5.0}) {
    Scenario at_sea = scenario;
    at_sea.surface = SeaSurface{.level = 0.4, .wind_speed = wind};
    Simulator under_waves(at_sea, tank(), 2);
    EXPECT_EQ(under_waves.make_ping(0, 4).intensity == under_waves.make_ping(0, 3).intensity, wind == 0);
  }
  expect_same(Simulator(scenario, tank(), 1).make_ping(0, 3), third);
  Scenario other = scenario;
  other.seed = 77;
  EXPECT_NE(Simulator(other, tank(), 2).make_ping(0, 3).intensity, third.intensity);
  other = scenario;
  other.sonars[0].name = "aft";
  EXPECT_NE(Simulator(other, tank(), 2).make_ping(0, 3).intensity, third.intensity);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, ReverberationTest, testing::Values(kReference, kRays, kRaster), kName);

// The same walks on both engines: rounding moves little of their energy to other bins, and a leg that just meets an
// edge may be lost.
TEST(ReverberationEnginesTest, Agree) {
  const Ping cpu = ping_of(in_tank(kRays, 1000), tank()), reference = ping_of(in_tank(kReference, 1000), tank());
  double apart = 0, sum = 0;
  for (std::size_t cell = 0; cell < cpu.intensity.size(); ++cell) {
    apart += std::abs(cpu.intensity[cell] - reference.intensity[cell]);
    sum += reference.intensity[cell];
  }
  EXPECT_LT(apart, 2e-3 * sum);
}

// A head with a beam of 3 degrees.
Scenario head_in_tank(int walks, BeamPattern pattern = BeamPattern::kRectangular) {
  Scenario head = in_tank(kRays, walks);
  head.sonars[0].beam_count = 1;
  head.sonars[0].azimuth_aperture = 3 * kDegree;
  head.sonars[0].type = SonarType::kMechanicallyScanned;
  head.receiver.azimuth_pattern = pattern;
  return head;
}

// A scanning head receives as much reverberation as a fan's beam of its width, but for the pattern of its beam: it
// sends and receives with the integral of sinc^2, 1.1287 of its width at half power, each way.
TEST(ReverberationScanTest, HeadHasTheLevelOfAFan) {
  const Scenario head = head_in_tank(100'000);
  Scenario fan = head;
  fan.sonars[0].type = SonarType::kForwardLooking;
  fan.receiver.azimuth_pattern = BeamPattern::kTopHat;
  const Scene scene = scene_of(make_box({2.4, 1.6, 1.1}), diffuse(-8), {});
  const double of_fan = mean_between(ping_of(fan, scene), fan.sonars[0], 3, 5),
               of_head = mean_between(ping_of(head, scene), fan.sonars[0], 3, 5);
  EXPECT_NEAR(10 * std::log10(of_head / of_fan), 20 * std::log10(1.1287), 0.5);
}

// Intensities of a head between 2.6 and 4.6 m, [direction][bin], relative to the mean over directions. Walls are
// diffuse, so that all of it are walks.
std::vector<std::vector<double>> haze(Scenario scenario, int directions, double step) {
  scenario.receiver.speckle = false;
  const Scene scene = scene_of(make_box({2.4, 1.6, 1.1}), diffuse(-8), {});
  Simulator simulator(scenario, scene, 1);
  std::vector<std::vector<double>> rows;
  std::vector<double> mean(100);
  for (int i = 0; i < directions; ++i) {
    PingRequest request;
    request.head_angle = i * step;
    const Ping ping = simulator.ping(0, request);
    std::vector<double>& row = rows.emplace_back();
    for (int bin = 0; bin < 100; ++bin) {
      row.push_back(ping.intensity[ping.index(120 + bin, 0)]);
      mean[bin] += row.back() / directions;
    }
  }
  for (std::vector<double>& row : rows) {
    std::ranges::transform(row, mean, row.begin(), std::divides());
  }
  return rows;
}

// Correlation of rows some directions apart.
double correlation(const std::vector<std::vector<double>>& rows, std::size_t apart) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i + apart < rows.size(); ++i) {
    for (std::size_t bin = 0; bin < rows[i].size(); ++bin) {
      product += (rows[i][bin] - 1) * (rows[i + apart][bin] - 1);
      square += 0.5 * (std::pow(rows[i][bin] - 1, 2) + std::pow(rows[i + apart][bin] - 1, 2));
    }
  }
  return product / square;
}

// What differs between the seeds of few walks is chance; few strong echoes are limited to the mean. An echo is weighted
// with the beam's gain where it left and where it arrives: with Gaussian beams of the width b at half power, those of
// two directions d apart correlate by e^(-2 ln 2 d^2/b^2) each way: both ways .84 for d = b/4, .50 for b/2. Walks of a
// ping's own would not correlate.
TEST(ReverberationScanTest, NeighbouringDirectionsShareTheirWalks) {
  Scenario scenario = head_in_tank(500, BeamPattern::kHann);
  auto rows = haze(scenario, 240, 0.75 * kDegree);
  scenario.seed = 77;
  const auto other = haze(scenario, 240, 0.75 * kDegree);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::ranges::transform(rows[i], other[i], rows[i].begin(),
                           [](double a, double b) { return 1 + std::clamp(a - b, -1.0, 1.0); });
  }
  EXPECT_GT(correlation(rows, 1), 0.55);
  EXPECT_GT(correlation(rows, 2), 0.25);
  EXPECT_LT(correlation(rows, 1), correlation(rows, 0));
  EXPECT_LT(correlation(rows, 2), correlation(rows, 1) - 0.1);
  EXPECT_LT(std::abs(correlation(rows, 12)), 0.25);
}

// Walks return over surfaces in the beam, so that few of them make a haze rather than spots: what differs from the mean
// over directions is below it.
TEST(ReverberationScanTest, FewWalksMakeAHaze) {
  const auto rows = haze(head_in_tank(1500), 60, 6 * kDegree);
  double square = 0;
  for (const std::vector<double>& row : rows) {
    for (const double value : row) {
      square += std::pow(value - 1, 2) / (60 * 100);
    }
  }
  EXPECT_LT(std::sqrt(square), 1);
}

// Few walks have the mean of many, wherever the head points: over 60 seeds.
TEST(ReverberationScanTest, LevelsDoNotDependOnTheNumberOfWalks) {
  for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
    double sum = 0, square = 0;
    const auto level = [&](int walks, std::uint64_t seed) {
      Scenario scenario = head_in_tank(walks);
      scenario.receiver.beam_shape = shape;
      scenario.seed = seed;
      scenario.trajectory.waypoints = {{.time = 0, .orientation = {0.1, 0.2, 2.9}}};
      return mean_between(ping_of(scenario, scene_of(make_box({2.4, 1.6, 1.1}), diffuse(-8), {})), scenario.sonars[0],
                          2.5, 5);
    };
    const double expected = level(400'000, 3);
    constexpr int kSeeds = 60;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const double ratio = level(2000, seed) / expected;
      sum += ratio, square += ratio * ratio;
    }
    const double mean = sum / kSeeds, error = std::sqrt((square / kSeeds - mean * mean) / (kSeeds - 1));
    EXPECT_NEAR(mean, 1, 4 * error + 0.02);
    EXPECT_LT(error, 0.04);  // So the test can fail.
  }
}

std::string fault_of(const Scenario& scenario) {
  try {
    scenario.validate();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ReverberationScenarioTest, WalksNeedTheEchoesThatTheyAddTo) {
  Scenario scenario = in_tank(kRays, 500);
  EXPECT_EQ(fault_of(scenario), "");
  scenario.max_surfaces = 2;
  EXPECT_THAT(
      fault_of(scenario),
      testing::HasSubstr("random_walks = 500 needs max_surfaces = 3, not 2: the paths meet three surfaces and more"));
  scenario.max_surfaces = 3;
  scenario.secondary = SecondaryEchoes::kNone;
  EXPECT_THAT(
      fault_of(scenario),
      testing::HasSubstr(
          "random_walks = 500 needs secondary = selective or all, since it adds to these echoes; or 0 for none"));
  scenario.secondary = SecondaryEchoes::kSelective;
  scenario.random_walks = -1;
  EXPECT_THAT(fault_of(scenario), testing::HasSubstr("random_walks"));
  scenario.random_walks = 500;
  scenario.model = EchoModel::kPaper;
  scenario.ground_truth = GroundTruth::kLabels;
  EXPECT_THAT(fault_of(scenario), testing::HasSubstr("random_walks needs model = calibrated"));
}

}  // namespace
}  // namespace insonify::validation::reverberation_test
