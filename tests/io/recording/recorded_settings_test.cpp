// recorded_settings_test.cpp -- a recording has every setting that a scenario file can have.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "insonify/describe.h"
#include "insonify/files.h"
#include "io/h5_read.h"
#include "support/test_files.h"

namespace insonify::recorded_settings_test {
namespace {

using testing::ElementsAre;

// All optional settings are given, so that all are recorded.
Scenario everything() {
  Scenario scenario;
  scenario.world = "/no/such/world.sdf";
  scenario.strict = true;
  scenario.ignore = {"water_surface*", "tank::walls"};
  scenario.arguments = {"px=8"};
  scenario.max_surfaces = 2;
  scenario.duration = 3;
  scenario.turns = 2;
  scenario.rough_mirrors = true;
  scenario.water.sound_speed = 1480;
  scenario.water.absorption_db_per_m = 0.1;
  scenario.water.volume_backscatter_db = -70;
  scenario.water.profile = {{.depth = 0, .sound_speed = 1500, .temperature_c = 9, .salinity = 34},
                            {.depth = 7, .sound_speed = 1490}};
  scenario.receiver.ambient_noise_db = 30;
  scenario.receiver.time_varied_gain = 40;
  scenario.receiver.gain_ranges = {1, 2};
  scenario.receiver.gains_db = {0, 6};
  scenario.receiver.saturation_db = -10;
  scenario.receiver.full_scale_db = -40;
  scenario.receiver.full_scale_share = 0.01;
  scenario.receiver.wind_noise = 5;
  scenario.receiver.rain_noise = 2;
  scenario.receiver.ship_noise = 0.5;
  scenario.receiver.dead_elements = {2};
  scenario.materials.overrides["hull"] = {.like = "steel", .thickness = 0.012, .open_share = 0.25};
  scenario.materials.overrides["mast"] = {.density = 1000};
  scenario.points = {{.position = {1, 2, 3}, .target_strength_db = -20}, {.position = {4, 5, 6}}};
  scenario.interferers.emplace_back();
  scenario.thrusters.emplace_back();
  scenario.surface = SeaSurface{.level = 4};
  SonarConfig sonar;
  sonar.beam_azimuths = {0.1, 0};
  sonar.beam_count = 2;
  sonar.azimuth_resolution = 0.01;
  sonar.assumed_sound_speed = 1500;
  sonar.ping_period = 1;
  sonar.leak_db = -20;
  sonar.transmit_width = 2;
  sonar.element_width = 2;
  sonar.beam_widths = {0.05};
  sonar.transmit_elevation_aperture = 0.3;
  sonar.focus_range = 5;
  sonar.self_noise_db = 40;
  sonar.sampling = {8, 100};
  sonar.group_gains_db = {0, 1};
  sonar.missing_beams = {1};
  sonar.crosstalk_db = -40;
  scenario.sonars = {sonar};
  scenario.trajectory.waypoints = {{.time = 1}, {.time = 2, .position = {7, 8, 9}}};
  scenario.ping_spans = {{.begin = 1, .end = 2}};
  scenario.motions = {{.object = "ship", .trajectory = {{{.time = 3}}}}};
  scenario.view = ViewConfig{};
  return scenario;
}

Scene scene() {
  Scene scene;
  scene.instances.emplace_back().name = "hull";
  scene.instances.back().mesh = std::make_shared<const Mesh>();
  scene.materials = {{.name = "hull", .thickness = 0.012, .open_share = 0.25}, {.name = "sand"}};
  return scene;
}

std::filesystem::path recorded(const Scenario& scenario) {
  const auto path = process_folder() / "recorded_settings_test.h5";
  Recording(path, scenario, scene(), scenario.sonars.at(0), {.replace = true}).close();
  return path;
}

TEST(RecordedSettingsTest, HaveEveryKeyThatDescribeLists) {
  const H5Reader file(recorded(everything()));
  std::map<std::string, std::string> groups{{"scenario", ""},          {"materials", "material_rules/"},
                                            {"sonars", "sonar/"},      {"sampling", "sonar/sampling/"},
                                            {"motions", "motions/0/"}, {"profile", "water/profile/"}};
  const std::vector<SectionDescription> sections = describe_scenario();
  for (const SectionDescription& section : sections) {
    groups.emplace(section.name, section.name + "/");
  }
  int count = 0;
  for (const SectionDescription& section : sections) {
    for (const KeyDescription& key : section.keys) {
      // Presets and quaternions are only other notations for values that are recorded.
      const bool is_part = groups.contains(key.key);  // Its keys have a section of their own.
      // A simulator's scenario has the trajectory that was made from a pattern.
      const bool is_flown = section.name == "pattern" || section.name == "lines" || section.name == "motion_noise";
      if (is_part || is_flown || key.key == "preset" || key.key == "mode" || key.key.ends_with("_wxyz")) {
        continue;
      }
      const std::string name = key.key.ends_with("_deg") ? key.key.substr(0, key.key.size() - 4) : key.key;
      EXPECT_TRUE(file.has("settings/" + groups.at(section.name) + name)) << section.name << " " << key.key;
      ++count;
    }
  }
  EXPECT_GT(count, 100);
}

TEST(RecordedSettingsTest, HaveWhatIsLeftOutOfTheWorld) {
  const H5Reader file(recorded(everything()));
  EXPECT_THAT(file.texts("settings/ignore"), ElementsAre("water_surface*", "tank::walls"));
}

TEST(RecordedSettingsTest, HaveARowForEachEntryOfAList) {
  const H5Reader file(recorded(everything()));
  EXPECT_EQ(file.shape("settings/points/position"), (std::vector<hsize_t>{2, 3}));
  EXPECT_THAT(file.values<double>("settings/points/position"), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(file.values<double>("settings/points/target_strength_db"), ElementsAre(-20, 0));
  EXPECT_EQ(file.attribute<std::string>("settings/points/target_strength_db", "units"), "dB");
  EXPECT_THAT(file.values<double>("settings/trajectory/time"), ElementsAre(1, 2));
  EXPECT_THAT(file.values<double>("settings/water/profile/depth"), ElementsAre(0, 7));
  EXPECT_THAT(file.texts("settings/motions/0/object"), ElementsAre("ship"));
  EXPECT_THAT(file.values<double>("settings/motions/0/trajectory/time"), ElementsAre(3));
}

TEST(RecordedSettingsTest, HaveTheRulesForMaterialsAndWhatTheyCameTo) {
  const H5Reader file(recorded(everything()));
  EXPECT_THAT(file.texts("settings/material_rules/name"), ElementsAre("hull", "mast"));
  EXPECT_THAT(file.texts("settings/material_rules/like"), ElementsAre("steel", ""));
  EXPECT_THAT(file.values<double>("settings/material_rules/density"), ElementsAre(testing::IsNan(), 1000));
  EXPECT_THAT(file.values<double>("settings/materials/thickness"),
              ElementsAre(0.012, std::numeric_limits<double>::infinity()));
  EXPECT_THAT(file.values<double>("settings/material_rules/open_share"), ElementsAre(0.25, testing::IsNan()));
  EXPECT_THAT(file.values<double>("settings/materials/open_share"), ElementsAre(0.25, 0));
  // At 720 kHz m = 4.8733, q = (m - 1/m)^2 sin^2 18.096 = 10.22, |R|^2 = q/(4 + q) = 0.7187; Lambert's law at -20 dB
  // takes 0.0314 and leaves 0.2499. A solid lets nothing through.
  EXPECT_THAT(file.values<double>("settings/materials/transmission"),
              ElementsAre(testing::DoubleNear(std::sqrt(0.2499), 1e-3), 0));
}

TEST(RecordedSettingsTest, HaveTheDepthThatTheSonarHasUnderTheSurface) {
  EXPECT_THAT(H5Reader(recorded(everything())).values<double>("settings/water/depth"), ElementsAre(4));
}

TEST(RecordedSettingsTest, HaveTheReceiverOfTheSonar) {
  Scenario scenario = everything();
  scenario.sonars[0].receiver = scenario.receiver;
  scenario.sonars[0].receiver->saturation_db = -3;
  const H5Reader file(recorded(scenario));
  EXPECT_THAT(file.values<double>("settings/receiver/saturation_db"), ElementsAre(-3));
  EXPECT_FALSE(file.has("settings/sonar/receiver"));
}

TEST(RecordedSettingsTest, HaveTheYamlOfAScenarioMadeInCode) {
  Scenario scenario = everything();
  EXPECT_EQ(H5Reader(recorded(scenario)).attribute<std::string>("/", "scenario"), to_yaml(scenario));
  scenario.text = "as read";
  EXPECT_EQ(H5Reader(recorded(scenario)).attribute<std::string>("/", "scenario"), "as read");
}

}  // namespace
}  // namespace insonify::recorded_settings_test
