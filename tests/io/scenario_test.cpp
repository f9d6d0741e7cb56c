// scenario_test.cpp -- a scenario file is read into the values it contains.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/scenario_file.h"
#include "support/message_of.h"

namespace insonify::scenario_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kEverything = R"(# Every key there is.
world: worlds/floor.obj
collisions: true
model: paper
engine: reference
secondary: all
seed: 18446744073709551615
pings: 7
default_material: mud
water: {temperature_c: 4.5, salinity: 0, ph: 7.8, depth: 12, sound_speed: 1480, absorption: false}
materials:
  hull: {like: steel, reflectivity: 0.9}
  deck: wood
  tar: {density: 1200, sound_speed: 1400}
sonars:
  - name: ahead
    model: Own
    type: fls
    frequency: 900e3
    beam_count: 3
    beam_azimuths_deg: [40, 0.5, -41]
    elevation_aperture_deg: 15
    elevation_center_deg: -12
    bin_count: 321
    min_range: 0.5
    max_range: 31
    blanking_range: 1.5
    gain: 2.5
    assumed_sound_speed: 1500
    ping_period: 0.25
    position: [1, 2, -3]
    orientation_deg: [10, 20, 30]
    sampling: {columns_per_beam: 6, rows: 77}
  - name: around
    type: msis
    beam_count: 1
    azimuth_aperture_deg: 3
    step_deg: -1.8
    sector_center_deg: 45
    sector_width_deg: 90
    mounting: vertical
receiver: {noise: false}
paper: {sigmoid: authors, sigmoid_midpoint: 0.4, sigmoid_slope: 9, multiplicative_mean: 0.8,
        multiplicative_deviation: 0.1, additive_deviation: 0.02}
trajectory:
  - {time: 0, position: [0, 0, -2]}
  - {time: 4, position: [2, 0, -2], orientation_deg: [0, 0, 90]}
motions:
  - object: ship::hull
    trajectory: [{time: 1, position: [5, 0, 0]}]
view: {position: [-4, 0, 3], look_at: [9, 0, 0], field_of_view_deg: 45}
)";

TEST_F(ScenarioTest, TakesPlainValues) {
  const Scenario scenario = load(kEverything);
  EXPECT_EQ(scenario.file, "scenes/scenario.yaml");
  EXPECT_EQ(scenario.text, kEverything);
  EXPECT_TRUE(scenario.collisions);
  EXPECT_EQ(scenario.model, EchoModel::kPaper);
  EXPECT_EQ(scenario.engine, "reference");
  EXPECT_EQ(scenario.secondary, SecondaryEchoes::kAll);
  EXPECT_EQ(scenario.seed, 18446744073709551615U);
  EXPECT_EQ(scenario.pings, 7);
  EXPECT_FALSE(scenario.receiver.noise);
}

TEST_F(ScenarioTest, FindsTheWorldFromItsOwnFolder) {
  const Scenario scenario = load(kEverything);
  EXPECT_EQ(scenario.world, folder.path() / "scenes/worlds/floor.obj");
  EXPECT_EQ(scenario.places.at("world"), (Place{"scenes/scenario.yaml", 2, 1}));
}

TEST_F(ScenarioTest, NeedsNoWorldForPointsOrUnderASurface) {
  for (const char* part : {"points: [{position: [5, 0, 0]}]\n", "surface: {level: 3}\n"}) {
    EXPECT_TRUE(load(std::string("sonars: [{}]\n") + part).world.empty()) << part;
  }
}

TEST_F(ScenarioTest, NullTakesPartsAway) {
  const std::string given =
      "world: worlds/floor.obj\nsonars: [{}]\nsurface: {level: 3}\npoints: [{position: [5, 0, 0]}]\n"
      "interferers: [{position: [9, 0, 0]}]\nthrusters: [{position: [1, 0, 0]}]\ntrajectory: [{time: 0}]\nview: {}\n";
  EXPECT_TRUE(load(given).surface.has_value());
  const Scenario scenario = load(given, {"surface=null", "points=null", "interferers=null", "thrusters=null",
                                         "trajectory=null", "motions=null", "view=null"});
  EXPECT_FALSE(scenario.surface.has_value());
  EXPECT_TRUE(scenario.points.empty());
  EXPECT_TRUE(scenario.interferers.empty());
  EXPECT_TRUE(scenario.thrusters.empty());
  EXPECT_TRUE(scenario.trajectory.waypoints.empty());
  EXPECT_FALSE(scenario.view.has_value());
}

TEST_F(ScenarioTest, NullTakesOptionalValuesAway) {
  const std::string given =
      "world: worlds/floor.obj\nwater: {sound_speed: 1500}\nsonars: [{name: a, ping_period: 2}]\n";
  EXPECT_TRUE(load(given).sonars[0].ping_period.has_value());
  const Scenario scenario = load(given, {"water.sound_speed=null", "sonars.a.ping_period=null"});
  EXPECT_FALSE(scenario.water.sound_speed.has_value());
  EXPECT_FALSE(scenario.sonars[0].ping_period.has_value());
}

TEST_F(ScenarioTest, TakesTheWater) {
  const Water water = load(kEverything).water;
  EXPECT_EQ(water.temperature_c, 4.5);
  EXPECT_EQ(water.salinity, 0);
  EXPECT_EQ(water.ph, 7.8);
  EXPECT_EQ(water.depth, 12);
  EXPECT_EQ(water.sound_speed, 1480);
  EXPECT_FALSE(water.absorption);
}

TEST_F(ScenarioTest, TakesMaterialsByNameOrByTheirProperties) {
  const MaterialRules rules = load(kEverything).materials;
  EXPECT_EQ(rules.default_material, "mud");
  EXPECT_EQ(rules.overrides.at("hull").like, "steel");
  EXPECT_EQ(rules.overrides.at("hull").reflectivity, 0.9);
  EXPECT_EQ(rules.overrides.at("deck").like, "wood");
  EXPECT_EQ(rules.overrides.at("tar").like, "");
  EXPECT_EQ(rules.overrides.at("tar").density, 1200);
  EXPECT_EQ(rules.overrides.at("tar").sound_speed, 1400);
  EXPECT_FALSE(rules.overrides.at("tar").reflectivity.has_value());
}

TEST_F(ScenarioTest, KnowsWhereEachSettingStands) {
  const Places places = load(kEverything, {"pings=3"}).places;
  EXPECT_EQ(places.at("default_material"), (Place{"scenes/scenario.yaml", 9, 1}));
  EXPECT_EQ(places.at("materials.hull"), (Place{"scenes/scenario.yaml", 12, 3}));
  EXPECT_EQ(places.at("materials.hull.like"), (Place{"scenes/scenario.yaml", 12, 10}));
  EXPECT_EQ(places.at("sonars[0].sampling.rows"), (Place{"scenes/scenario.yaml", 33, 37}));
  EXPECT_EQ(places.at("pings"), (Place{"--set pings=3"}));
  EXPECT_FALSE(places.contains("engines"));
}

// An error found long after reading still has its position in the file.
TEST_F(ScenarioTest, ErrorsOfMaterialsHaveTheirPlace) {
  const Scenario scenario = load("world: worlds/floor.obj\nmaterials:\n  floor:\n    like: steal\nsonars: [{}]\n");
  try {
    (void)load_scene(scenario);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "scenes/scenario.yaml:4:5: materials.floor.like = steal is not a known material; did you "
                 "mean steel?");
    EXPECT_EQ(error.object(), "materials.floor");
    EXPECT_EQ(error.field(), "like");
    EXPECT_EQ(error.place(), (Place{"scenes/scenario.yaml", 4, 5}));
  }
}

TEST_F(ScenarioTest, TakesAFan) {
  const SonarConfig sonar = load(kEverything).sonars.at(0);
  EXPECT_EQ(sonar.name, "ahead");
  EXPECT_EQ(sonar.model, "Own");
  EXPECT_EQ(sonar.type, SonarType::kForwardLooking);
  EXPECT_EQ(sonar.frequency, 900e3);
  EXPECT_EQ(sonar.beam_count, 3);
  EXPECT_THAT(sonar.beam_azimuths,
              ElementsAre(radians_from_degrees(40), radians_from_degrees(0.5), radians_from_degrees(-41)));
  EXPECT_NEAR(sonar.elevation_aperture, std::numbers::pi / 12, kAngleTolerance);
  EXPECT_NEAR(sonar.elevation_center, -std::numbers::pi / 15, kAngleTolerance);
  EXPECT_EQ(sonar.bin_count, 321);
  EXPECT_EQ(sonar.min_range, 0.5);
  EXPECT_EQ(sonar.max_range, 31);
  EXPECT_EQ(sonar.blanking_range, 1.5);
  EXPECT_EQ(sonar.gain, 2.5);
  EXPECT_EQ(sonar.assumed_sound_speed, 1500);
  EXPECT_EQ(sonar.ping_period, 0.25);
  EXPECT_EQ(sonar.position, Vec3(1, 2, -3));
  EXPECT_NEAR(sonar.orientation.y(), std::numbers::pi / 9, kAngleTolerance);
  EXPECT_EQ(sonar.sampling.columns_per_beam, 6);
  EXPECT_EQ(sonar.sampling.rows, 77);
}

TEST_F(ScenarioTest, ASonarsReceiverStartsFromTheScenarios) {
  const Scenario scenario = load(
      "world: worlds/floor.obj\nreceiver: {noise: false, time_varied_gain: 30}\n"
      "sonars:\n  - name: a\n    receiver: {speckle: false, time_varied_gain: none}\n  - name: b\n");
  const ReceiverConfig& own = scenario.receiver_of(scenario.sonars[0]);
  EXPECT_FALSE(own.noise);
  EXPECT_FALSE(own.speckle);
  EXPECT_FALSE(own.time_varied_gain.has_value());
  EXPECT_EQ(&scenario.receiver_of(scenario.sonars[1]), &scenario.receiver);
  EXPECT_EQ(load("world: worlds/floor.obj\nsonars: [{name: a}, {name: b}]\n",
                 {"sonars.b.receiver.counts=true", "sonars.b.receiver.full_scale_db=-40"})
                .sonars[1]
                .receiver->full_scale_db,
            -40);
}

TEST_F(ScenarioTest, TakesOrientationsAsQuaternions) {
  // Half of a quarter turn about z; and of one about y, where roll and yaw are about the same axis.
  const Scenario scenario = load(
      "world: worlds/floor.obj\n"
      "sonars: [{orientation_wxyz: [0.70710678, 0, 0, 0.70710678]}]\n"
      "trajectory: [{orientation_wxyz: [0.7071067811865476, 0, 0.7071067811865476, 0]}]\n");
  EXPECT_NEAR(scenario.sonars[0].orientation.z(), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(scenario.sonars[0].orientation.head<2>().norm(), 0, 1e-12);
  const Eigen::Quaterniond down(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
  EXPECT_NEAR(scenario.trajectory.at(0).orientation.angularDistance(down), 0, 1e-7);
}

TEST_F(ScenarioTest, TakesATrajectoryFromAFileBesideIt) {
  folder.write("scenes/logs/track.csv", "time,x,y,z\n100,0,0,-1\n102,4,0,-1\n");
  const std::string rest = "world: worlds/floor.obj\nsonars: [{}]\n";
  EXPECT_EQ(load(rest + "trajectory: logs/track.csv\n").trajectory.at(101).position, Vec3(2, 0, -1));
  const Scenario scenario = load(rest +
                                 "trajectory: {file: logs/track.csv, start: 100}\n"
                                 "motions: [{object: floor, trajectory: logs/track.csv}]\n");
  EXPECT_EQ(scenario.trajectory.at(1).position, Vec3(2, 0, -1));
  EXPECT_EQ(scenario.motions[0].trajectory.at(101).position, Vec3(2, 0, -1));
}

// The file is written for the paper model.
TEST_F(ScenarioTest, SetModelTakesAFileOfTheOtherModel) {
  const Scenario scenario = load(kEverything, {"model=calibrated"});
  EXPECT_EQ(scenario.model, EchoModel::kCalibrated);
  EXPECT_EQ(scenario.sonars[0].gain, 2.5);
  EXPECT_EQ(load(scenario.text).model, EchoModel::kCalibrated);  // The text leaves out keys without effect.
}

TEST_F(ScenarioTest, TakesAScanningHead) {
  const SonarConfig sonar = load(kEverything).sonars.at(1);
  EXPECT_EQ(sonar.type, SonarType::kMechanicallyScanned);
  EXPECT_NEAR(sonar.azimuth_aperture, std::numbers::pi / 60, kAngleTolerance);
  EXPECT_NEAR(sonar.head.step, -std::numbers::pi / 100, kAngleTolerance);
  EXPECT_NEAR(sonar.head.sector_center, std::numbers::pi / 4, kAngleTolerance);
  EXPECT_NEAR(sonar.head.sector_width, std::numbers::pi / 2, kAngleTolerance);
  EXPECT_EQ(sonar.head.mounting, Mounting::kVertical);
}

TEST_F(ScenarioTest, TakesThePaperModel) {
  const PaperModel paper = load(kEverything).paper;
  EXPECT_EQ(paper.sigmoid, Sigmoid::kAuthors);
  EXPECT_EQ(paper.sigmoid_midpoint, 0.4);
  EXPECT_EQ(paper.sigmoid_slope, 9);
  EXPECT_EQ(paper.multiplicative_mean, 0.8);
  EXPECT_EQ(paper.multiplicative_deviation, 0.1);
  EXPECT_EQ(paper.additive_deviation, 0.02);
}

TEST_F(ScenarioTest, TakesMotionsAndView) {
  const Scenario scenario = load(kEverything);
  ASSERT_EQ(scenario.trajectory.waypoints.size(), 2U);
  EXPECT_EQ(scenario.trajectory.waypoints[1].time, 4);
  ASSERT_EQ(scenario.motions.size(), 1U);
  EXPECT_EQ(scenario.motions[0].object, "ship::hull");
  EXPECT_EQ(scenario.motions[0].trajectory.at(0).position, Vec3(5, 0, 0));
  EXPECT_EQ(scenario.places.at("motions[0]"), (Place{"scenes/scenario.yaml", 49, 5}));
  ASSERT_TRUE(scenario.view.has_value());
  EXPECT_EQ(scenario.view->position, Vec3(-4, 0, 3));
  EXPECT_EQ(scenario.view->look_at, Vec3(9, 0, 0));
  EXPECT_NEAR(scenario.view->field_of_view, std::numbers::pi / 4, kAngleTolerance);
}

TEST_F(ScenarioTest, LeavesWhatIsNotThereAtItsDefault) {
  const Scenario scenario = load("world: worlds/floor.obj\nsonars: [{}]\n");
  EXPECT_EQ(scenario.pings, Scenario().pings);
  EXPECT_EQ(scenario.water.temperature_c, Water().temperature_c);
  EXPECT_EQ(scenario.sonars.at(0).max_range, SonarConfig().max_range);
  EXPECT_FALSE(scenario.view.has_value());
}

// Midway between 40, 0.5 and -41 lie 20.25 and -20.25; the outer beams reach as far out as in: to 59.75 and -61.75.
TEST_F(ScenarioTest, ATableOfBeamsSaysHowManyThereAreAndHowWideTheFanIs) {
  for (const char* base : {"", "preset: tritech-gemini-720i, "}) {
    const SonarConfig sonar =
        load("world: worlds/floor.obj\nsonars: [{" + std::string(base) + "beam_azimuths_deg: [40, 0.5, -41]}]\n")
            .sonars.at(0);
    EXPECT_EQ(sonar.beam_count, 3);
    EXPECT_NEAR(sonar.azimuth_aperture, radians_from_degrees(121.5), 4 * kAngleTolerance);
  }
  // A single azimuth does not determine the width.
  const SonarConfig sonar =
      load("world: worlds/floor.obj\nsonars: [{azimuth_aperture_deg: 3, beam_azimuths_deg: [10]}]\n").sonars.at(0);
  EXPECT_EQ(sonar.beam_count, 1);
  EXPECT_NEAR(sonar.azimuth_aperture, radians_from_degrees(3), kAngleTolerance);
}

TEST_F(ScenarioTest, TakesOverTheKeysOfAnAnchor) {
  const Scenario scenario = load(
      "world: worlds/floor.obj\nmodel: paper\nsonars:\n  - &port {name: port, max_range: 20, gain: 2, orientation_deg: "
      "[0, 0, 40]}\n"
      "  - {<<: *port, name: starboard, orientation_deg: [0, 0, -40]}\n"
      "  - <<: [{name: down, gain: 5}, *port]\n    max_range: 9\n");
  EXPECT_EQ(scenario.sonars.at(1).name, "starboard");
  EXPECT_EQ(scenario.sonars.at(1).max_range, 20);
  EXPECT_LT(scenario.sonars.at(1).orientation.z(), 0);
  EXPECT_EQ(scenario.sonars.at(2).name, "down");
  EXPECT_EQ(scenario.sonars.at(2).max_range, 9);
  EXPECT_EQ(scenario.sonars.at(2).gain, 5);  // If several maps have a key, the first one applies.
  EXPECT_GT(scenario.sonars.at(2).orientation.z(), 0);
}

TEST_F(ScenarioTest, StartsASonarFromItsPreset) {
  const SonarConfig sonar =
      load("world: worlds/floor.obj\nsonars: [{preset: blueprint-oculus-m750d, mode: high}]\n").sonars.at(0);
  EXPECT_EQ(sonar.name, "sonar");
  EXPECT_EQ(sonar.model, "Blueprint Oculus M750d");  // Titles of pictures have the frequency from the model.
  EXPECT_EQ(sonar.frequency, 1200e3);
  EXPECT_EQ(sonar.beam_count, 512);
}

TEST_F(ScenarioTest, PutsItsOwnFieldsOverThePreset) {
  const SonarConfig sonar =
      load("world: worlds/floor.obj\nmodel: paper\nsonars: [{beam_count: 64, preset: tritech-gemini-720i, gain: 3}]\n")
          .sonars.at(0);
  EXPECT_EQ(sonar.beam_count, 64);
  EXPECT_EQ(sonar.gain, 3);
  EXPECT_EQ(sonar.frequency, 720e3);
}

// The Gemini 720i: bins of 8 mm, at most 1000 of them, at most 30 pings a second.
TEST_F(ScenarioTest, FitsBinsAndPeriodOfAPresetToTheRange) {
  const auto sonar = [&](const std::string& fields) {
    return load("world: worlds/floor.obj\nwater: {sound_speed: 1500}\nsonars: [{preset: tritech-gemini-720i, " +
                fields + "}]\n")
        .sonars.at(0);
  };
  // 4.2 - 0.2 m in 8 mm: 500 bins. There and back in 5.6 ms: the limit of 30 Hz rules.
  EXPECT_EQ(sonar("max_range: 4.2").bin_count, 500);
  EXPECT_EQ(sonar("max_range: 4.2").ping_period, 1 / 30.0);
  // 39.8 m in 8 mm would be 4975 bins. There and back in 53 ms: the range rules.
  EXPECT_EQ(sonar("max_range: 40").bin_count, 1000);
  EXPECT_FALSE(sonar("max_range: 40").ping_period.has_value());
  EXPECT_EQ(sonar("max_range: 40, bin_count: 77").bin_count, 77);
  EXPECT_EQ(sonar("max_range: 40, ping_period: 0.5").ping_period, 0.5);
}

}  // namespace
}  // namespace insonify::scenario_test
