// determinism_test.cpp -- pings are the same bytes for any number of threads, with all that each model has (T13 of
// PHYSICS 11).

#include "validation/calibrated_scene.h"

namespace insonify::validation {
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
  scenario.trajectory.waypoints = {{.time = 0}, {.time = 1, .position = {1, 0.4, 0}, .orientation = {0.05, 0, 0.3}}};
  return scenario;
}

// Many small things, some of them mirrors, over a bed: cells hold many surfaces and echoes arrive from all around.
Scene cluttered() {
  std::vector<Scene> scenes = {seabed_at(-5, diffuse(-22)), plane(-Vec3::UnitX(), {16, 0, 0}, glinting(0.9, 0.15))};
  for (int i = 0; i < 24; ++i) {
    const Vec3 centre(5 + 0.35 * i, 4 * std::sin(2.4 * i), -4.2 + 0.8 * std::cos(1.7 * i));
    scenes.push_back(sphere_at(centre, 0.35, i % 2 == 0 ? glinting(0.8, 0.2) : diffuse(-12), 0.5));
  }
  return scene_of_all(std::move(scenes));
}

template <typename Value>
std::string bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

TEST_P(DeterminismTest, PingsAreTheSameBytesForAnyNumberOfThreads) {
  const Scenario scenario = everything(GetParam());
  const Scene scene = cluttered();
  const Ping one = Simulator(scenario, scene, 1).make_ping(0, 3);
  ASSERT_TRUE(std::ranges::any_of(one.path_order, [](int order) { return order > 1; }));
  for (const int threads : {2, 4, 16}) {
    const Ping ping = Simulator(scenario, scene, threads).make_ping(0, 3);
    const auto same = [&](auto table) { return bytes_of(ping.*table) == bytes_of(one.*table); };
    EXPECT_TRUE(same(&Ping::intensity)) << threads;
    EXPECT_TRUE(same(&Ping::instance)) << threads;
    EXPECT_TRUE(same(&Ping::material)) << threads;
    EXPECT_TRUE(same(&Ping::elevation)) << threads;
    EXPECT_TRUE(same(&Ping::strongest_instance)) << threads;
    EXPECT_TRUE(same(&Ping::strongest_share)) << threads;
    EXPECT_TRUE(same(&Ping::elevation_spread)) << threads;
    EXPECT_TRUE(same(&Ping::path_order)) << threads;
    EXPECT_TRUE(same(&Ping::shadow)) << threads;
    EXPECT_TRUE(same(&Ping::direct_intensity)) << threads;
  }
}

// What `labels` has.
void expect_same_for_any_number_of_threads(const Scenario& scenario) {
  const Scene scene = cluttered();
  const Ping one = Simulator(scenario, scene, 1).make_ping(0, 3);
  for (const int threads : {2, 4, 16}) {
    const Ping ping = Simulator(scenario, scene, threads).make_ping(0, 3);
    EXPECT_TRUE(bytes_of(ping.intensity) == bytes_of(one.intensity)) << threads;
    EXPECT_TRUE(ping.instance == one.instance) << threads;
    EXPECT_TRUE(bytes_of(ping.elevation) == bytes_of(one.elevation)) << threads;
  }
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
  scenario.points.clear();
  expect_same_for_any_number_of_threads(scenario);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, DeterminismTest, testing::Values(kReference, kRays, kRaster), kName);

}  // namespace
}  // namespace insonify::validation
