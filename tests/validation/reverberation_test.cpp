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

TEST_P(ReverberationTest, WalksDependOnSeedSonarAndPingAlone) {
  const Scenario scenario = in_tank(GetParam(), 300);
  Simulator simulator(scenario, tank(), 2);
  const Ping third = simulator.make_ping(0, 3);
  EXPECT_NE(simulator.make_ping(0, 4).intensity, third.intensity);
  expect_same(simulator.make_ping(0, 3), third);
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

// A scanning head that stands still in the tank receives as much reverberation as a fan's beam of its width, but for
// the pattern of its beam: the walks start in its own beam only, not in all cells beside it.
TEST(ReverberationScanTest, HeadHasTheLevelOfAFan) {
  Scenario fan = in_tank(kRays, 100'000);
  fan.sonars[0].beam_count = 1;
  fan.sonars[0].azimuth_aperture = 3 * kDegree;
  Scenario head = fan;
  head.sonars[0].type = SonarType::kMechanicallyScanned;
  head.receiver.azimuth_pattern = BeamPattern::kRectangular;
  const double of_fan = mean_between(ping_of(fan, tank()), fan.sonars[0], 3, 5),
               of_head = mean_between(ping_of(head, tank()), fan.sonars[0], 3, 5);
  EXPECT_NEAR(10 * std::log10(of_head / of_fan), 0, 2);
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
