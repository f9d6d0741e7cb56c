// to_yaml_test.cpp -- a scenario written and read again is unchanged.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "support/same_settings.h"
#include "support/working_folder.h"

namespace insonify::to_yaml_test {
namespace {

class ToYamlTest : public testing::Test {
 protected:
  Scenario reread(const Scenario& scenario) const {
    folder.write("again/scenario.yaml", to_yaml(scenario));
    return load_scenario("again/scenario.yaml");
  }

  WorkingFolder folder;
};

// No value is the default. Angles are whole degrees, which are converted back exactly.
Scenario made_in_code() {
  Scenario scenario;
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.primary = PrimaryEchoes::kRays;
  scenario.max_surfaces = 2;
  scenario.rough_mirrors = true;
  scenario.motion_in_ping = true;
  scenario.ground_truth = GroundTruth::kFull;
  scenario.seed = 18'446'744'073'709'551'615U;
  scenario.pings = 12;
  scenario.water.temperature_c = 0.1;  // Not exact in binary.
  scenario.water.sound_speed = 1499.75;
  scenario.water.volume_backscatter_db = -70;
  scenario.receiver.elevation_pattern = BeamPattern::kHann;
  scenario.receiver.elements = 32;
  scenario.receiver.dead_elements = {3, 7};
  scenario.receiver.element_error = radians_from_degrees(7);
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_bandwidth = 300e3;
  scenario.receiver.ambient_noise_db = 35;
  scenario.materials.default_material = "mud";
  scenario.materials.overrides["hull: <<"] = {.like = "steel", .thickness = 0.012};  // A name that YAML must quote.
  scenario.materials.overrides["<<"] = {.like = "rock"};
  scenario.materials.overrides["bed"].relief_config = {
      .ripple_wavelength = 0.3, .ripple_height = 0.02, .ripple_direction = radians_from_degrees(33)};
  scenario.points = {{.position = {5, -1, 0.5}, .target_strength_db = -25}, {}};
  scenario.interferers = {{.position = {30, 4, 1}, .first_pulse = 0.03}};
  scenario.thrusters = {{.position = {-0.4, 0.2, 0.1}, .slope = -18, .blade_rate = 75, .modulation = 0.6}};
  scenario.surface = SeaSurface{};
  SonarConfig fan;
  fan.name = "null";  // A string that YAML would read as null.
  fan.model = "7 \"seas\"\t#1";
  fan.beam_count = 3;
  fan.beam_azimuths = {radians_from_degrees(20), radians_from_degrees(1), radians_from_degrees(-20)};
  fan.azimuth_aperture = fan.bearings().extent();
  fan.position = {0, 0, -3};
  fan.orientation = {0, radians_from_degrees(12), radians_from_degrees(-170)};
  fan.sampling.rows = 77;
  SonarConfig head;
  head.name = "head";
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.azimuth_aperture = radians_from_degrees(3);
  head.head.step = radians_from_degrees(-1.8);
  head.head.sector_width = radians_from_degrees(90);
  head.head.mounting = Mounting::kVertical;
  head.position = {0, 0, -4};
  head.assumed_sound_speed = 1510;
  head.ping_period = 0.4;
  head.receiver = scenario.receiver;  // Written as the difference from the scenario's.
  head.receiver->noise = false;
  head.receiver->ambient_noise_db.reset();
  head.receiver->dead_elements.clear();
  head.receiver->pulse = PulseKind::kCw;
  scenario.sonars = {fan, head};
  scenario.trajectory.waypoints = {{}, {.time = 2.5, .position = {1, 2, -3}, .orientation = {0, 0, 1}}};
  scenario.motions = {{.object = "ship::hull", .trajectory = {{{.time = 1, .position = {9, 9, 9}}}}}};
  scenario.view = ViewConfig{.position = {1, 2, 3}};
  return scenario;
}

TEST_F(ToYamlTest, AScenarioMadeInCodeComesBackTheSame) {
  const Scenario scenario = made_in_code();
  const Scenario again = reread(scenario);
  EXPECT_EQ(settings_of("", again), settings_of("", scenario)) << to_yaml(scenario);
}

TEST_F(ToYamlTest, EveryShippedSceneComesBackTheSame) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(INSONIFY_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() == ".yaml") {
      ++count;
      const Scenario scenario = load_scenario(entry.path());
      const ActsIn idle = scenario.model == EchoModel::kPaper ? ActsIn::kCalibrated : ActsIn::kPaper;
      EXPECT_EQ(settings_of("", reread(scenario), idle), settings_of("", scenario, idle)) << entry.path();
    }
  }
  EXPECT_GE(count, 15);
}

TEST_F(ToYamlTest, SaysWhatDiffersFromTheDefaults) {
  Scenario scenario;
  scenario.sonars.emplace_back().max_range = 20;
  scenario.sonars.back().azimuth_aperture = radians_from_degrees(90);
  scenario.surface = SeaSurface{.level = 5};
  EXPECT_EQ(to_yaml(scenario), "sonars:\n  - azimuth_aperture_deg: 90\n    max_range: 20\nsurface:\n  level: 5\n");
}

TEST_F(ToYamlTest, SaysNoneForTheWorldThatAProgramGives) {
  Scenario scenario;
  scenario.sonars.emplace_back();
  EXPECT_EQ(to_yaml(scenario), "world: none\nsonars:\n  - {}\n");
  EXPECT_TRUE(reread(scenario).world.empty());
}

// Values that reading refuses.
TEST_F(ToYamlTest, LeavesOutWhatHasNoEffect) {
  Scenario scenario;
  scenario.sonars.emplace_back().gain = 2;
  scenario.paper.sigmoid_slope = 5;
  scenario.materials.overrides["hull"] = {.like = "steel", .reflectivity = 0.9};
  scenario.sonars.back().head.step = 1;
  EXPECT_EQ(to_yaml(scenario), "world: none\nmaterials:\n  hull:\n    like: \"steel\"\nsonars:\n  - {}\n");
  scenario.model = EchoModel::kPaper;
  EXPECT_EQ(reread(scenario).sonars[0].gain, 2);
}

TEST_F(ToYamlTest, FindsFilesFromAnyFolder) {
  folder.write("here/floor.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("here/scenario.yaml", "world: floor.obj\nmaterials: {sand: {normal_map: maps/bed.png}}\nsonars: [{}]\n");
  const Scenario again = reread(load_scenario("here/scenario.yaml"));
  EXPECT_EQ(again.world, folder.path() / "here/floor.obj");
  EXPECT_EQ(again.materials.overrides.at("sand").relief_config.normal_map, folder.path() / "here/maps/bed.png");
}

// Doubles in degrees may be spaced more coarsely than in radians: then some radians have no exact value in degrees.
TEST_F(ToYamlTest, AnAngleInRadiansComesBackToItsLastBit) {
  Scenario scenario;
  scenario.sonars.emplace_back();
  for (int i = 1; i < 200; ++i) {
    const double angle = 0.0137 * i;
    scenario.sonars[0].azimuth_aperture = angle;
    EXPECT_NEAR(reread(scenario).sonars[0].azimuth_aperture, angle, 2.3e-16 * angle);
  }
}

}  // namespace
}  // namespace insonify::to_yaml_test
