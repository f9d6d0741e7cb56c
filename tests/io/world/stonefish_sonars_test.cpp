// stonefish_sonars_test.cpp -- sonars of our scenarios from the sensors of Stonefish's.

#include <fstream>
#include <sstream>

#include "insonify/simulator.h"
#include "io/stonefish_files.h"

namespace insonify::stonefish_sonars_test {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

// Numbers pass through degrees and text: a few units in the last place of some metres or radians.
constexpr double kTextError = 1e-9;
constexpr double kQuarter = 1.5707963267948966;

void expect_near(const Vec3& value, const Vec3& expected, double error = kTextError) {
  EXPECT_LT((value - expected).norm(), error) << value.transpose() << " is not " << expected.transpose();
}

std::string text_of(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// Acoustic axis and up of a sonar without a trajectory, in the world.
Vec3 axis_of(const SonarConfig& sonar) {
  return sonar.vehicle_from_sonar().orientation * Vec3::UnitX();
}
Vec3 up_of(const SonarConfig& sonar) {
  return sonar.vehicle_from_sonar().orientation * Vec3::UnitZ();
}

// Sensors look along their z. Turned so on a vehicle they look ahead, with y down: the usual mounting.
const std::string kAhead = fmt::format("rpy='{0} 0 {0}'", kQuarter);

std::string sensor(const std::string& name, const std::string& type, const std::string& inside,
                   const std::string& origin = "<origin xyz='0 0 0' " + kAhead + "/>") {
  return fmt::format("<sensor name='{}' type='{}'>{}{}<link name='base'/></sensor>\n", name, type, inside, origin);
}
const std::string kFls = "<specs beams='64' bins='300' horizontal_fov='90' vertical_fov='20'/>";
const std::string kMsis = "<specs step='1.8' bins='400' horizontal_beam_width='3' vertical_beam_width='35'/>";
const std::string kSss =
    "<specs bins='501' lines='400' horizontal_beam_width='2' vertical_beam_width='50' vertical_tilt='60'/>";

class StonefishSonarsTest : public StonefishTest {
 protected:
  static std::string robot(const std::string& sensors, const std::string& xyz = "0 0 0",
                           const std::string& rpy = "0 0 0") {
    return "<robot name='rov' fixed='false'>\n<base_link name='base' type='empty'/>\n" + sensors +
           transform("world_transform", xyz, rpy) + "</robot>\n";
  }

  // Our scenario for a world of these elements.
  Scenario sonars(const std::string& elements, const std::string& more = "",
                  const std::vector<std::string>& settings = {}) {
    write("pool.scn", scenario(elements));
    return parse("world: pool.scn\n" + more, settings);
  }
};

TEST_F(StonefishSonarsTest, AForwardLookingSonarHasItsBeamsBinsAndRanges) {
  const Scenario scenario = sonars(robot(sensor("fls", "fls", kFls + "<settings range_min='0.75' range_max='12'/>")));
  ASSERT_EQ(scenario.sonars.size(), 1U);
  const SonarConfig& fls = scenario.sonars[0];
  EXPECT_EQ(fls.name, "fls");
  EXPECT_EQ(fls.type, SonarType::kForwardLooking);
  EXPECT_EQ(fls.beam_count, 64);
  EXPECT_EQ(fls.bin_count, 300);
  EXPECT_NEAR(fls.azimuth_aperture, kQuarter, kTextError);
  EXPECT_NEAR(fls.elevation_aperture, radians_from_degrees(20), kTextError);
  EXPECT_EQ(fls.min_range, 0.75);
  EXPECT_EQ(fls.max_range, 12);
  EXPECT_THAT(said, Contains("pool.scn: sonars after its sensors: fls; insonify's own receiver makes their noise"));
}

TEST_F(StonefishSonarsTest, WithoutSettingsRangesAreStonefishs) {
  const SonarConfig fls = sonars(robot(sensor("fls", "fls", kFls))).sonars.at(0);
  EXPECT_EQ(fls.min_range, 0.5);
  EXPECT_EQ(fls.max_range, 10);
}

// A vehicle at 3 m depth that looks east, which is -y here, with a sonar 1 m ahead and 2 m to the right (south).
TEST_F(StonefishSonarsTest, ASensorLooksAlongItsZ) {
  const SonarConfig fls = sonars(robot(sensor("fls", "fls", kFls, "<origin xyz='1 2 0' " + kAhead + "/>"), "10 20 3",
                                       fmt::format("0 0 {}", kQuarter)))
                              .sonars.at(0);
  expect_near(fls.position, {8, -21, -3});
  expect_near(axis_of(fls), {0, -1, 0});
  expect_near(up_of(fls), {0, 0, 1});
  const SonarConfig down = sonars(robot(sensor("down", "fls", kFls, "<origin xyz='0 0 0' rpy='0 0 0'/>"))).sonars.at(0);
  expect_near(axis_of(down), {0, 0, -1});
  expect_near(up_of(down), {0, 1, 0});  // The sensor's -y: west.
}

// What the whole chain comes to: a ball to the right of the axis, which is where azimuths are negative.
TEST_F(StonefishSonarsTest, AnEchoIsOnTheSideOfTheObject) {
  const Scenario scenario = sonars(robot(sensor("fls", "fls", kFls), "0 0 2") + ball("ball", "6 3 2"), "seed: 3\n");
  const Ping ping = Simulator(scenario, load_scene(scenario), 1).make_ping(0, 0);
  std::size_t strongest = 0;
  for (std::size_t i = 0; i < ping.intensity.size(); ++i) {
    strongest = ping.intensity[i] > ping.intensity[strongest] ? i : strongest;
  }
  const SonarConfig& fls = scenario.sonars[0];
  const auto beam = static_cast<int>(strongest % static_cast<std::size_t>(fls.beam_count));
  const auto bin = static_cast<int>(strongest / static_cast<std::size_t>(fls.beam_count));
  EXPECT_NEAR(fls.beam_azimuth(beam), -std::atan2(3, 6), radians_from_degrees(6));  // The ball is 17 deg wide.
  EXPECT_NEAR(fls.bin_range(bin), std::sqrt(45.0) - 1, 0.4);
}

TEST_F(StonefishSonarsTest, AScanningSonarSweepsFromPortToStarboard) {
  const SonarConfig msis =
      sonars(robot(sensor("msis", "msis", kMsis + "<settings rotation_min='-30' rotation_max='90'/>"))).sonars.at(0);
  EXPECT_EQ(msis.type, SonarType::kMechanicallyScanned);
  EXPECT_EQ(msis.beam_count, 1);
  EXPECT_EQ(msis.bin_count, 400);
  EXPECT_NEAR(msis.azimuth_aperture, radians_from_degrees(3), kTextError);
  EXPECT_NEAR(msis.elevation_aperture, radians_from_degrees(35), kTextError);
  EXPECT_NEAR(msis.head.step, radians_from_degrees(-1.8), kTextError);
  EXPECT_NEAR(msis.head_angle(0), radians_from_degrees(30), kTextError);  // -30 deg in Stonefish is to port.
  EXPECT_LT(msis.head_angle(1), msis.head_angle(0));
  EXPECT_NEAR(msis.head.sector_width, radians_from_degrees(120), kTextError);
  expect_near(axis_of(msis), {1, 0, 0});
}

// 360 / 7 is 51.4: Stonefish makes 52 steps of it.
TEST_F(StonefishSonarsTest, StepsDivideTheCircle) {
  const std::string specs = "<specs step='7' bins='9' horizontal_beam_width='3' vertical_beam_width='35'/>";
  const SonarConfig msis = sonars(robot(sensor("msis", "msis", specs))).sonars.at(0);
  EXPECT_NEAR(msis.head.step, radians_from_degrees(-360.0 / 52), kTextError);
  EXPECT_NEAR(msis.head.sector_width, radians_from_degrees(360), kTextError);
}

// The sensor's x is to starboard and its z down, so its y is aft. The axes are 60 deg below the horizontal.
TEST_F(StonefishSonarsTest, ASideScanSonarIsTwoSonars) {
  const std::string origin = fmt::format("<origin xyz='0 0 1' rpy='0 0 {}'/>", kQuarter);
  const Scenario scenario = sonars(robot(sensor("sss", "sss", kSss, origin)));
  ASSERT_EQ(scenario.sonars.size(), 2U);
  const SonarConfig &port = scenario.sonars[0], &starboard = scenario.sonars[1];
  EXPECT_EQ(port.name, "sss_port");
  EXPECT_EQ(starboard.name, "sss_starboard");
  const double half = std::sqrt(0.75);
  expect_near(axis_of(port), {0, 0.5, -half});
  expect_near(axis_of(starboard), {0, -0.5, -half});
  expect_near(up_of(port), {0, half, 0.5});
  expect_near(up_of(starboard), {0, -half, 0.5});
  for (const SonarConfig& side : scenario.sonars) {
    EXPECT_EQ(side.beam_count, 1);
    EXPECT_EQ(side.bin_count, 251);  // Stonefish makes an even number of them.
    EXPECT_NEAR(side.azimuth_aperture, radians_from_degrees(2), kTextError);
    EXPECT_NEAR(side.elevation_aperture, radians_from_degrees(50), kTextError);
    expect_near(side.position, {0, 0, -1});
  }
}

TEST_F(StonefishSonarsTest, SensorsAreOnLinksBodiesAndTheWorld) {
  const std::string at_world =
      "<sensor name='fixed' type='fls'>" + kFls + "<world_transform xyz='1 2 3' " + kAhead + "/></sensor>";
  const std::string on_body = "<static name='pier' type='empty'>" + transform("world_transform", "10 0 0") +
                              "<sensor name='pier' type='fls'>" + kFls + "<origin xyz='0 0 4' " + kAhead +
                              "/></sensor></static>";
  const Scenario scenario = sonars(robot(sensor("fls", "fls", kFls)) + on_body + at_world);
  ASSERT_EQ(scenario.sonars.size(), 3U);
  expect_near(scenario.sonars[1].position, {10, 0, -4});
  expect_near(scenario.sonars[2].position, {1, -2, -3});
}

TEST_F(StonefishSonarsTest, EqualNamesAreTold) {
  const Scenario scenario =
      sonars(robot(sensor("fls", "fls", kFls) + sensor("fls", "fls", kFls) + sensor("a/b", "fls", kFls)));
  EXPECT_EQ(scenario.sonars.at(0).name, "fls");
  EXPECT_EQ(scenario.sonars.at(1).name, "rov_fls");
  EXPECT_EQ(scenario.sonars.at(2).name, "a_b");
}

// On a vehicle that moves by our scenario's trajectory: z up, y to port.
TEST_F(StonefishSonarsTest, WithATrajectoryPosesAreThoseOnTheVehicle) {
  const std::string elements =
      robot(sensor("fls", "fls", kFls, "<origin xyz='1 2 -3' " + kAhead + "/>"), "50 60 7", "0 0 2");
  const SonarConfig fls = sonars(elements, "trajectory: [{time: 0, position: [0, 0, -1]}]\n").sonars.at(0);
  expect_near(fls.position, {1, -2, 3});
  expect_near(axis_of(fls), {1, 0, 0});
}

TEST_F(StonefishSonarsTest, SettingsChangeThem) {
  const Scenario scenario = sonars(robot(sensor("fls", "fls", kFls)), "", {"sonars.fls.max_range=25", "beam_count=32"});
  EXPECT_EQ(scenario.sonars.at(0).max_range, 25);
  EXPECT_EQ(scenario.sonars.at(0).beam_count, 32);
  EXPECT_EQ(scenario.sonars.at(0).bin_count, 300);
}

TEST_F(StonefishSonarsTest, AWorldOfASettingHasItsSonarsToo) {
  write("pool.scn", scenario(robot(sensor("fls", "fls", kFls))));
  EXPECT_EQ(parse("pings: 2\n", {"world=pool.scn"}).sonars.size(), 1U);
}

TEST_F(StonefishSonarsTest, SonarsOfTheScenarioComeFirst) {
  const Scenario scenario = sonars(robot(sensor("fls", "fls", kFls)), "sonars: [{name: own}]\n");
  ASSERT_EQ(scenario.sonars.size(), 1U);
  EXPECT_EQ(scenario.sonars[0].name, "own");
}

TEST_F(StonefishSonarsTest, GainsActInThePaperModel) {
  const std::string elements = robot(sensor("fls", "fls", kFls + "<settings gain='1.5'/>"));
  EXPECT_EQ(sonars(elements).sonars.at(0).gain, 1);
  EXPECT_EQ(sonars(elements, "model: paper\n").sonars.at(0).gain, 1.5);
  EXPECT_EQ(sonars(elements, "", {"model=paper"}).sonars.at(0).gain, 1.5);
}

TEST_F(StonefishSonarsTest, AStonefishScenarioIsOneOfOurs) {
  const std::string path = write("sub/my pool.scn", scenario(robot(sensor("fls", "fls", kFls)) + ball("b", "5 0 0")));
  const Scenario scenario = load_scenario(path, std::vector<std::string>{"pings=4"});
  EXPECT_EQ(scenario.world, path);
  EXPECT_EQ(scenario.pings, 4);
  EXPECT_EQ(scenario.sonars.size(), 1U);
  EXPECT_EQ(load_scene(scenario).instances.size(), 1U);
  // As a program does that reads the file itself, to change the scenario later.
  EXPECT_EQ(to_yaml(load_scenario_text(text_of(path), path)), to_yaml(load_scenario(path)));
  // What a recording holds is read back as the same.
  const Scenario again = load_scenario_text(scenario.text, path);
  EXPECT_EQ(to_yaml(again), to_yaml(scenario));
  EXPECT_EQ(message_of([] { (void)load_scenario("/nowhere/a.scn"); }), "/nowhere/a.scn: no such file");
}

TEST_F(StonefishSonarsTest, AScenarioWithoutSonarsIsTold) {
  EXPECT_EQ(without_folder(message_of([&] { sonars(ball("a", "0 0 0")); })),
            "pool.scn: has no sensor of a sonar; list sonars in a scenario that says world: pool.scn");
  EXPECT_THAT(without_folder(message_of([&] { sonars("<include file='gone.scn'/>"); })),
              HasSubstr("; missing parts may be the cause: pool.scn:2:1: <include> 'gone.scn' not found in the "
                        "scenario's folder"));
}

struct BadSensor {
  const char* type;
  std::string inside, message;
};

TEST_F(StonefishSonarsTest, TellsWhatIsWrongWithASensor) {
  const auto specs = [](const char* beams) {
    return fmt::format("<specs beams='{}' bins='300' horizontal_fov='90' vertical_fov='20'/>", beams);
  };
  const std::vector<BadSensor> cases = {
      {"fls", "", ": <specs> is missing"},
      {"fls", "<specs beams='64'/>", ": <specs> bins is missing"},
      {"fls", specs("many"), ": <specs> beams = 'many' must be a number"},
      {"fls", specs("0"), ": <specs> beams = 0 must be a whole number of at least 1"},
      {"fls", specs("2.5"), ": <specs> beams = 2.5 must be a whole number of at least 1"},
      {"fls", specs("99999"), ".beam_count = 99999 must be from 1 to 4096"},
      {"fls", kFls + "<settings range_max='0.1'/>", ".max_range = 0.1 m must be greater than min_range = 0.5 m"},
      {"msis", "<specs step='0' bins='4' horizontal_beam_width='3' vertical_beam_width='35'/>",
       ": <specs> step = 0 deg must be above 0 and at most 180 deg"},
      {"msis", kMsis + "<settings rotation_min='50' rotation_max='-50'/>",
       ": <settings> rotation_min = 50 and rotation_max = -50 deg must rise within -180 to 180"},
      {"sss", "<specs bins='4' horizontal_beam_width='2' vertical_beam_width='50' vertical_tilt='91'/>",
       ": <specs> vertical_tilt = 91 deg must be from 0 to 90 deg"},
  };
  for (const BadSensor& bad : cases) {
    EXPECT_EQ(without_folder(message_of([&] { sonars(robot(sensor("s", bad.type, bad.inside))); })),
              "pool.scn:4:1: sensor 's'" + bad.message);
  }
}

}  // namespace
}  // namespace insonify::stonefish_sonars_test
