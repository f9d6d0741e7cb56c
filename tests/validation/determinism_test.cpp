// determinism_test.cpp -- T13: pings are the same bytes for any number of threads, with all features of each model. T
// numbers are those of docs/concepts/physics-tests.md.

#include "insonify/scenario_requests.h"
#include "support/same_pings.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::determinism_test {
namespace {

class DeterminismTest : public testing::TestWithParam<Method> {};

Scenario everything(const Method& method) {
  const bool brute = std::string_view(method.engine) == "reference";
  SonarConfig sonar;
  sonar.beam_count = brute ? 32 : 256;
  sonar.elevation_aperture = 30 * kDegree;
  sonar.elevation_center = -8 * kDegree;
  sonar.min_range = 0.5;
  sonar.max_range = 20;
  sonar.bin_count = 300;
  sonar.sampling = {4, brute ? 40 : 160};
  sonar.position = {0, 0, -3};
  Scenario scenario = calibrated(sonar, method);
  scenario.secondary = SecondaryEchoes::kSelective;
  scenario.ground_truth = GroundTruth::kFull;
  scenario.surface = SeaSurface{.level = 0, .wind_speed = 4};
  scenario.points = {{.position = {7, 1, -3.5}, .target_strength_db = -25}};
  scenario.water.absorption = true;
  scenario.water.volume_backscatter_db = -70;
  scenario.receiver.noise = true;
  scenario.receiver.speckle = true;
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 1e-3;
  scenario.receiver.time_varied_gain = 30;
  scenario.random_walks = 200;
  scenario.trajectory.waypoints = {{.time = 0}, {.time = 1, .position = {1, 0.4, 0}, .orientation = {0.05, 0, 0.3}}};
  return scenario;
}

// Many small spheres, some of them mirrors, over a bed: cells contain many surfaces, and secondary echoes arrive in all
// beams.
Scene cluttered() {
  std::vector<Scene> scenes = {seabed_at(-5, diffuse(-22)), plane(-Vec3::UnitX(), {16, 0, 0}, glinting(0.9, 0.15))};
  for (int i = 0; i < 24; ++i) {
    const Vec3 centre(5 + 0.35 * i, 4 * std::sin(2.4 * i), -4.2 + 0.8 * std::cos(1.7 * i));
    scenes.push_back(sphere_at(centre, 0.35, i % 2 == 0 ? glinting(0.8, 0.2) : diffuse(-12), 0.5));
  }
  return scene_of_all(std::move(scenes));
}

Ping expect_same_for_any_number_of_threads(const Scenario& scenario) {
  const Scene scene = cluttered();
  Ping one = Simulator(scenario, scene, 1).make_ping(0, 3);
  for (const int threads : {2, 4, 16}) {
    SCOPED_TRACE(threads);
    expect_same(Simulator(scenario, scene, threads).make_ping(0, 3), one);
  }
  return one;
}

TEST_P(DeterminismTest, PingsAreTheSameBytesForAnyNumberOfThreads) {
  const Ping ping = expect_same_for_any_number_of_threads(everything(GetParam()));
  EXPECT_TRUE(std::ranges::any_of(ping.path_order, [](int order) { return order > 1; }));
}

TEST_P(DeterminismTest, LabelsAreTheSameBytesForAnyNumberOfThreads) {
  Scenario scenario = everything(GetParam());
  scenario.ground_truth = GroundTruth::kLabels;
  scenario.receiver.speckle = false;
  expect_same_for_any_number_of_threads(scenario);
}

TEST_P(DeterminismTest, PaperPingsAreTheSameBytesForAnyNumberOfThreads) {
  Scenario scenario = everything(GetParam());
  scenario.model = EchoModel::kPaper;
  scenario.ground_truth = GroundTruth::kLabels;
  scenario.random_walks = 0;
  scenario.points.clear();
  expect_same_for_any_number_of_threads(scenario);
}

// Later pings receive less: the vehicle turns aside and up, so that cells that are filled in the first ping are empty
// in later ones.
Scenario turning_away(const Method& method) {
  Scenario scenario = everything(method);
  scenario.sonars[0].beam_count = 32;
  scenario.surface.reset();
  scenario.points[0].position = {7, 1, -5.5};
  scenario.water.volume_backscatter_db.reset();
  scenario.receiver.noise = false;
  scenario.trajectory.waypoints = {{.time = 0}, {.time = 1, .position = {1, 0.4, 0}, .orientation = {0, -0.3, 0.4}}};
  return scenario;
}

TEST_P(DeterminismTest, PingsDoNotDependOnEarlierPings) {
  constexpr std::uint64_t kLate = 1000;  // Where the trajectory has ended.
  const Scene scene = cluttered();
  for (int choices = 0; choices < 16; ++choices) {
    Scenario scenario = turning_away(GetParam());
    if (std::string_view(GetParam().engine) == "reference") {
      scenario.sonars[0].sampling = {2, 20};
    }
    scenario.receiver.speckle = (choices & 1) != 0;
    scenario.receiver.azimuth_pattern = (choices & 2) != 0 ? BeamPattern::kHann : BeamPattern::kTopHat;
    scenario.receiver.pulse = (choices & 4) != 0 ? PulseKind::kLfm : PulseKind::kNone;
    scenario.ground_truth = (choices & 8) != 0 ? GroundTruth::kFull : GroundTruth::kLabels;
    Simulator simulator(scenario, scene, 2);
    const ScenarioRequests requests(scenario);
    Ping ping;
    simulator.ping(0, requests.at(0, 0), ping);
    const auto first_received = std::ranges::count_if(ping.intensity, [](float value) { return value > 0; });
    simulator.ping(0, requests.at(0, kLate), ping);
    const auto received = std::ranges::count_if(ping.intensity, [](float value) { return value > 0; });
    SCOPED_TRACE(choices);
    EXPECT_LT(received, first_received);
    EXPECT_GT(received, 0);
    expect_same(ping, Simulator(scenario, scene, 2).make_ping(0, kLate));
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, DeterminismTest, testing::Values(kReference, kRays, kRaster), kName);

}  // namespace
}  // namespace insonify::validation::determinism_test
