// bad_input_test.cpp -- one-line errors for invalid texts, keys and settings of a scenario, with what would be valid.

#include <gmock/gmock.h>

#include "io/bad_scenario.h"

namespace insonify::bad_input_test {
namespace {

class BadInputTest : public BadScenarioTest {};

TEST_P(BadInputTest, IsToldInOneLine) {
  expect_told_in_one_line();
}

const BadScenario kCases[] = {
    // Text.
    {"EmptyFile", "", "scenario.yaml: the file is empty"},
    {"OnlyComments", "# nothing yet\n",
     "scenario.yaml:1:1: the file is empty; a scenario names a world and its sonars"},
    {"NotAMap", "- world\n- sonars\n",
     "scenario.yaml:1:1: scenario.yaml = [\"world\", \"sonars\"] must be a map of keys such as world and sonars"},
    {"AWord", "wreck\n", "scenario.yaml:1:1: scenario.yaml = \"wreck\" must be a map of keys such as world and sonars"},
    {"UnfinishedList", "world: floor.obj\nsonars: [\n",
     "scenario.yaml:3:1: not valid YAML: end of sequence flow not found"},
    {"Tab", "world: floor.obj\nwater:\n\tdepth: 3\n",
     "scenario.yaml:3:7: not valid YAML: indent with spaces, not with tabs"},
    {"SecondDocument", "world: floor.obj\n---\nworld: floor.obj\n",
     "scenario.yaml:3:1: a second document starts here; one file holds one"},
    {"CommaFirst", ", world: floor.obj\n", "scenario.yaml:1:1: not valid YAML: nothing can start here"},
    {"CommaAfterAList", "[1] , 2\n", "scenario.yaml:1:5: not valid YAML: nothing can start here"},
    {"KeyTwice", "world: floor.obj\nwater:\n  depth: 3\n  depth: 4\n", "scenario.yaml:4:3: water.depth is given twice"},
    {"KeyIsAList", "world: floor.obj\n[a, b]: 3\n", "scenario.yaml:2:1: a key must be a word"},
    {"MergeOfAWord", "world: floor.obj\nwater:\n  <<: sea\n",
     "scenario.yaml:3:3: << must be a map of keys to take over, such as *name, or a list of such maps"},
    {"MergeTwice", "world: floor.obj\nwater:\n  <<: {depth: 3}\n  <<: {depth: 4}\n",
     "scenario.yaml:4:3: water.<< is given twice"},
    {"EndlessNesting", "world: floor.obj\nwater: &sea\n  depth: *sea\n",
     "scenario.yaml:2:8: nested too deeply, or unfolds into too many values"},

    // Keys.
    {"UnknownKey", "wrold: floor.obj\n", "scenario.yaml:1:1: wrold is not a known key; did you mean world?"},
    {"UnknownKeyInWater", "world: floor.obj\nwater: {salinty: 3}\n",
     "scenario.yaml:2:9: water.salinty is not a known key; did you mean salinity?"},
    {"UnknownKeyInSonar", "world: floor.obj\nsonars:\n  - name: fls\n    max_rnage: 30\n",
     "scenario.yaml:4:5: sonars[0].max_rnage is not a known key; did you mean max_range?"},
    {"UnknownKeyInSampling", "world: floor.obj\nsonars:\n  - sampling: {row: 30}\n",
     "scenario.yaml:3:16: sonars[0].sampling.row is not a known key; did you mean rows?"},
    {"UnknownKeyWithALineBreak", "world: floor.obj\n\"a\\nb\": 3\n", "scenario.yaml:2:1: a\\nb is not a known key"},
    {"UnknownKeyLikeNoOther", "world: floor.obj\nbanana: 3\n", "scenario.yaml:2:1: banana is not a known key"},
    {"KeyOfTheReceiver", "world: floor.obj\nnoise: false\n",
     "scenario.yaml:2:1: noise is not a known key; did you mean receiver.noise?"},
    {"KeyOfTheWater", "world: floor.obj\nsonars:\n  - depth: 3\n",
     "scenario.yaml:3:5: sonars[0].depth is not a known key; did you mean water.depth?"},
    {"KeyOfTheSampling", "world: floor.obj\nrows: 3\n",
     "scenario.yaml:2:1: rows is not a known key; did you mean sonars[0].sampling.rows?"},
    {"KeyOfTheSamplingInASonar", "world: floor.obj\nsonars:\n  - rows: 3\n",
     "scenario.yaml:3:5: sonars[0].rows is not a known key; did you mean sampling.rows?"},
    {"AngleWithoutItsUnit", "world: floor.obj\nsonars:\n  - azimuth_aperture: 120\n",
     "scenario.yaml:3:5: sonars[0].azimuth_aperture must be written azimuth_aperture_deg, in degrees"},
    {"AngleInRadians", "world: floor.obj\nsonars:\n  - step_rad: 0.01\n",
     "scenario.yaml:3:5: sonars[0].step_rad must be written step_deg, in degrees"},
    {"SonarKeyOutsideSonars", "world: floor.obj\nmax_range: 30\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: max_range is a key of a sonar, not of the scenario; write it under sonars"},
    {"Points", "world: floor.obj\nmodel: paper\npoints: [{position: [9, 0, -5]}]\nsonars: [{name: fls}]\n",
     "scenario.yaml:3:1: points need model = calibrated"},
    {"Interferers", "world: floor.obj\nmodel: paper\ninterferers: [{position: [9, 0, -5]}]\nsonars: [{name: fls}]\n",
     "scenario.yaml:3:1: interferers need model = calibrated"},
    {"Thrusters", "world: floor.obj\nmodel: paper\nthrusters: [{position: [-1, 0, 0]}]\nsonars: [{name: fls}]\n",
     "scenario.yaml:3:1: thrusters need model = calibrated"},
    {"ThrusterInASonar", "world: floor.obj\nthrusters:\n  - position: [2, 0, 0]\nsonars: [{position: [2, 0.005, 0]}]\n",
     "scenario.yaml:3:5: thrusters[0].position is 0.005 m from that of sonars[0]; must be at least 0.01 m"},
    {"ModulationWithoutBlades",
     "world: floor.obj\nthrusters:\n  - {position: [2, 0, 0], modulation: 0.5}\nsonars: [{}]\n",
     "scenario.yaml:3:27: thrusters[0].modulation = 0.5 needs a blade_rate"},
    {"BladesWithoutModulation",
     "world: floor.obj\nthrusters:\n  - {position: [2, 0, 0], blade_rate: 60}\nsonars: [{}]\n",
     "scenario.yaml:3:27: thrusters[0].blade_rate = 60 Hz needs a modulation above 0"},
    {"ThrusterTooLoud", "world: floor.obj\nthrusters:\n  - {position: [2, 0, 0], level_db: 300}\nsonars: [{}]\n",
     "scenario.yaml:3:27: thrusters[0].level_db = 300 dB must be from -100 to 260 dB"},
    {"InterfererWithoutAPeriod", "world: floor.obj\ninterferers:\n  - period: 0\nsonars: [{name: fls}]\n",
     "scenario.yaml:3:5: interferers[0].period = 0 s must be from 0.001 to 1000000 s"},
    {"Counts", "world: floor.obj\nreceiver:\n  counts: true\nsonars: [{name: fls}]\n",
     "scenario.yaml:3:3: receiver.counts needs receiver.full_scale_db, the recorded level of the greatest count, or "
     "receiver.full_scale_share, the share of bins that have it"},
    {"TwoFullScales",
     "world: floor.obj\nreceiver: {full_scale_db: -40}\nsonars:\n  - receiver: {full_scale_share: 0.01}\n",
     "scenario.yaml:4:16: sonars[0].receiver.full_scale_share = 0.01 cannot go with sonars[0].receiver.full_scale_db = "
     "-40 dB; a sonar's receiver starts from the scenario's: write none for one of them"},
    {"DeadElementBeyondTheArray",
     "world: floor.obj\nreceiver: {elements: 64, dead_elements: [3, 64]}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:26: receiver.dead_elements[1] = 64 must be less than receiver.elements = 64"},
    {"HeadKeyOfAFan", "world: floor.obj\nsonars:\n  - type: fls\n    step_deg: 0.9\n",
     "scenario.yaml:4:5: sonars[0].step_deg belongs to a scanning sonar; this one's type is fls"},

    {"VehicleTooFastForMotionInPing",
     "world: floor.obj\nmotion_in_ping: true\ntrajectory:\n  - {time: 0}\n  - {time: 1, position: [50, 0, 0]}\n  - "
     "{time: "
     "2, position: [200, 0, 0]}\nsonars: [{name: fls}]\n",
     "scenario.yaml:6:5: trajectory[2] comes to 150 m/s from the one before; with motion_in_ping at most 100 m/s"},

    // Required values.
    {"NoWorld", "seed: 3\nsonars: [{name: fls}]\n",
     "scenario.yaml:1:1: world is missing: the SDF file or mesh to insonify"},
    {"NoWorldAndNoPoints", "points: []\nsurface: null\nsonars: [{name: fls}]\n",
     "scenario.yaml:1:1: world is missing: the SDF file or mesh to insonify"},
    {"WrongValueWithoutAWorld", "sonars:\n  - max_range: -3\n",
     "scenario.yaml:2:5: sonars[0].max_range = -3 m must be greater than 0, at most 100000 m"},
    {"WorldIsNotThere", "world: wreck.sdf\nsonars: [{name: fls}]\n",
     "scenario.yaml:1:1: world = \"wreck.sdf\" does not exist: no file FOLDER/wreck.sdf"},
    {"WorldWithoutAName", "world:\nsonars: [{name: fls}]\n",
     "scenario.yaml:1:1: world has no value; it must be a file"},
    {"WorldIsEmptyText", "world: \"\"\nsonars: [{name: fls}]\n", "scenario.yaml:1:1: world = \"\" must be a file"},
    {"NoSonars", "world: floor.obj\n", "scenario.yaml:1:1: sonars must have at least one entry"},
    {"EmptySonars", "world: floor.obj\nsonars: []\n", "scenario.yaml:2:1: sonars must have at least one entry"},
    {"SonarsIsAMap", "world: floor.obj\nsonars: {name: fls}\n",
     "scenario.yaml:2:1: sonars = {...} must be a list of sonars"},
    {"SonarIsAWord", "world: floor.obj\nsonars: [tritech-gemini-720i]\n",
     "scenario.yaml:2:10: sonars[0] = \"tritech-gemini-720i\" must be a map of keys such as preset and max_range"},

    // Settings on the command line.
    {"SettingOfAnElement",
     "world: floor.obj\nsonars:\n  - {name: fls, beam_count: 16}\n",
     "--set sonars.fls.missing_beams=[3, 16]: sonars[0].missing_beams[1] = 16 must be less than beam_count = 16",
     {"sonars.fls.missing_beams=[3, 16]"}},
    {"SettingWithoutValue", kGoodScenario, "--set pings: must be key=value, such as pings=3", {"pings"}},
    {"SettingWithoutKey", kGoodScenario, "--set =3: must be key=value, such as pings=3", {"=3"}},
    {"SettingOfNothing",
     kGoodScenario,
     "--set pings=: pings has no value; it must be a whole number, from 1 to 1000000000",
     {"pings="}},
    {"SettingOfAnUnknownKey",
     kGoodScenario,
     "--set pigns=3: pigns is not a known key; did you mean pings?",
     {"pigns=3"}},
    {"SettingOfAKeyOfTheWater",
     kGoodScenario,
     "--set depth=3: depth is not a known key; did you mean water.depth?",
     {"depth=3"}},
    {"SettingOfAnAngle",
     kGoodScenario,
     "--set azimuth_aperture=90: azimuth_aperture must be written azimuth_aperture_deg, in degrees",
     {"azimuth_aperture=90"}},
    {"SettingOutOfLimits",
     kGoodScenario,
     "--set sonars[0].max_range=-3: sonars[0].max_range = -3 m must be greater than 0, at most 100000 m",
     {"sonars[0].max_range=-3"}},
    {"SettingOfEverySonar",
     kGoodScenario,
     "--set max_range=-3: sonars[0].max_range = -3 m must be greater than 0, at most 100000 m",
     {"max_range=-3"}},
    {"SettingOfASonarThatIsNotThere",
     kGoodScenario,
     "--set sonars[2].max_range=3: there is no sonars[2]; sonars has 2",
     {"sonars[2].max_range=3"}},
    {"SettingOfANameThatIsNotThere",
     kGoodScenario,
     "--set sonars.gemini.max_range=3: sonars has no entry called gemini; it has fls, dst",
     {"sonars.gemini.max_range=3"}},
    {"SettingOfAnUnknownPart",
     kGoodScenario,
     "--set water.dept=3: water.dept is not a known key; did you mean depth?",
     {"water.dept=3"}},
    {"SettingInsideANumber",
     kGoodScenario,
     "--set seed.depth=3: seed = {...} must be a whole number, from 0 to 18446744073709551615",
     {"seed.depth=3"}},
    {"SettingInsideAText", kGoodScenario, "--set world.depth=3: world is not a map of keys", {"world.depth=3"}},
    {"SettingWithABadKey",
     kGoodScenario,
     "--set sonars[x].max_range=3: \"sonars[x].max_range\" is not a key such as water.depth or sonars[0].max_range",
     {"sonars[x].max_range=3"}},
    {"SettingThatIsNotYaml",
     kGoodScenario,
     "--set water={depth: 3: not valid YAML: end of map flow not found",
     {"water={depth: 3"}},
    {"SettingThatBreaksARule",
     kGoodScenario,
     "--set sonars.fls.min_range=60: sonars[0].max_range = 50 m must be greater than min_range = 60 m",
     {"sonars.fls.min_range=60"}},
    {"SettingOfAWorldThatIsNotThere",
     kGoodScenario,
     "--set world=wreck.sdf: world = \"wreck.sdf\" does not exist: no file FOLDER/wreck.sdf",
     {"world=wreck.sdf"}},
};

INSTANTIATE_TEST_SUITE_P(Scenario, BadInputTest, testing::ValuesIn(kCases),
                         [](const auto& bad) { return std::string(bad.param.name); });

class WrongFileTest : public testing::Test {
 protected:
  WorkingFolder folder;
};

TEST_F(WrongFileTest, MissingScenario) {
  EXPECT_EQ(message_of([] { (void)load_scenario("wreck.yaml"); }), "wreck.yaml: no such file");
}

TEST_F(WrongFileTest, UnknownAnchor) {
  folder.write("scenario.yaml", "world: floor.obj\nwater: *sea\n");
  const std::string told = "scenario.yaml:2:8: not valid YAML: the referenced anchor is not defined";
  EXPECT_THAT(message_of([] { (void)load_scenario("scenario.yaml"); }), testing::AnyOf(told, told + ": sea"));
}

TEST_F(WrongFileTest, Folder) {
  folder.write("scenes/floor.obj", "");
  EXPECT_EQ(message_of([] { (void)load_scenario("scenes"); }), "scenes: is a folder, not a file");
}

TEST_F(WrongFileTest, MeshInsteadOfAScenario) {
  EXPECT_EQ(
      message_of([] { (void)load_scenario("scenes/Wreck.OBJ"); }),
      "scenes/Wreck.OBJ: is a mesh, not a scenario; write a YAML file that says world: Wreck.OBJ and lists sonars");
}

TEST_F(WrongFileTest, WorldInsteadOfAScenario) {
  folder.write("tank.sdf", "<sdf version='1.9'><world name='tank'/></sdf>");
  EXPECT_EQ(
      message_of([] { (void)load_scenario("tank.sdf"); }),
      "tank.sdf: is an SDF world, not a scenario; write a YAML file that says world: tank.sdf and lists sonars, or put "
      "<insonify:sonar> into a link");
}

}  // namespace
}  // namespace insonify::bad_input_test
