// sdf_sonars_test.cpp -- sonars that stand in an SDF world.

#include <gmock/gmock.h>

#include "insonify/files.h"
#include "insonify/world_parts.h"
#include "support/working_folder.h"

namespace insonify::sdf_sonars_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SdfSonarsTest : public testing::Test {
 protected:
  // A wall, and a vehicle with `in_model` and a link with `in_link`.
  void write(const std::string& in_link, const std::string& in_model = "") {
    folder_.write("tank.sdf", R"(<sdf version="1.9" xmlns:insonify="https://insonify.org/sdf"><world name="tank">
<model name="wall"><static>true</static><pose>8 0 0 0 0 0</pose><link name="l">
<visual name="v"><geometry><box><size>1 9 9</size></box></geometry></visual></link></model>
<model name="rov"><pose>2 1 -3 0 0 0</pose>
<link name="hull"><pose>0.5 0 0 0 0 1.5707963267948966</pose><visual name="v"><geometry><sphere><radius>0.2</radius></sphere></geometry></visual>
)" + in_link + "</link><link name=\"mast\"><pose>0 0 2 0 0 0</pose></link>\n" +
                                  in_model + "</model></world></sdf>");
  }
  std::string refusal() {
    try {
      (void)load_scenario("tank.sdf");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  WorkingFolder folder_;
};

constexpr const char* kFls = R"(<insonify:sonar name="fls"><pose>0.3 0 0.1 0 0.2 0</pose>
<max_range>15</max_range><sampling>{rows: 30}</sampling><beam_count>40</beam_count></insonify:sonar>)";

TEST_F(SdfSonarsTest, TheFileIsAScenario) {
  write(kFls);
  std::vector<std::string> said;
  const Scenario scenario =
      load_scenario("tank.sdf", {}, [&](Severity, const std::string& text) { said.push_back(text); });
  ASSERT_EQ(scenario.sonars.size(), 1U);
  const SonarConfig& sonar = scenario.sonars[0];
  EXPECT_EQ(sonar.name, "fls");
  EXPECT_EQ(sonar.max_range, 15);
  EXPECT_EQ(sonar.sampling.rows, 30);
  EXPECT_EQ(sonar.beam_count, 40);
  EXPECT_LT((sonar.position - Vec3(0.3, 0, 0.1)).norm(), 1e-12);
  EXPECT_LT((sonar.orientation - Vec3(0, 0.2, 0)).norm(), 1e-12);
  const Pose vehicle = scenario.trajectory.at(0);
  EXPECT_LT((vehicle.position - Vec3(2.5, 1, -3)).norm(), 1e-12);
  EXPECT_LT(vehicle.orientation.angularDistance(orientation_from_rpy(0, 0, radians_from_degrees(90))), 1e-9);
  EXPECT_THAT(scenario.ignore, ElementsAre("rov::hull"));
  EXPECT_THAT(said, ElementsAre("tank.sdf: sonars in it: fls on rov::hull; their carriers are not insonified"));
  EXPECT_EQ(load_scene(scenario).instances.size(), 1U);
  EXPECT_EQ(load_scenario_text(scenario.text, "tank.sdf").sonars[0].max_range, 15);  // As recordings hold it.
}

TEST_F(SdfSonarsTest, SonarsOnSeveralLinksKeepTheirPlaces) {
  write(kFls,
        R"(<plugin name="insonify" filename="none"><sonar name="up"><link>mast</link><pose>0 0 0.5 0 0 0</pose></sonar>
<sonar name="own"/></plugin>)");
  const Scenario scenario = load_scenario("tank.sdf");
  ASSERT_EQ(scenario.sonars.size(), 3U);
  const Pose vehicle = scenario.trajectory.at(0);
  EXPECT_LT((vehicle * scenario.sonars[1].position - Vec3(2, 1, -0.5)).norm(), 1e-9);
  EXPECT_LT((vehicle * scenario.sonars[2].position - Vec3(2, 1, -3)).norm(), 1e-9);
  const std::vector<SonarCarrier> carriers = load_sonar_carriers(scenario);
  ASSERT_EQ(carriers.size(), 3U);
  EXPECT_EQ(carriers[1].carrier, "rov::mast");
  EXPECT_EQ(carriers[2].carrier, "rov");
  // Where the mast is at (7, 0, 0) unturned, the sonar is half a metre above it.
  const Pose mast{Vec3(7, 0, 0)};
  EXPECT_LT((mast * carriers[1].carrier_from_vehicle * scenario.sonars[1].position - Vec3(7, 0, 0.5)).norm(), 1e-9);
}

TEST_F(SdfSonarsTest, AScenarioMayTakeThemAndAddToThem) {
  write(kFls);
  folder_.write("dive.yaml",
                "world: tank.sdf\nignore: [wall]\nwater: {salinity: 3}\n"
                "trajectory: [{time: 0, position: [1, 1, 1]}]\n");
  const Scenario scenario = load_scenario("dive.yaml", std::vector<std::string>{"sonars.fls.max_range=9"});
  EXPECT_EQ(scenario.sonars[0].max_range, 9);
  EXPECT_EQ(scenario.trajectory.at(0).position, Vec3(1, 1, 1));
  EXPECT_THAT(scenario.ignore, ElementsAre("wall", "rov::hull"));
  folder_.write("own.yaml", "world: tank.sdf\nsonars: [{name: mine}]\n");
  const Scenario own = load_scenario("own.yaml");
  EXPECT_EQ(own.sonars.size(), 1U);
  EXPECT_TRUE(own.ignore.empty());
  EXPECT_TRUE(load_sonar_carriers(own).empty());
}

TEST_F(SdfSonarsTest, FaultsAreToldWithTheirPlaces) {
  write("");
  EXPECT_EQ(refusal(),
            "tank.sdf: is an SDF world, not a scenario; write a YAML file that says world: tank.sdf and lists "
            "sonars, or put <insonify:sonar> into a link");
  write("<insonify:sonar name='fls'><max_rnage>3</max_rnage></insonify:sonar>");
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("tank.sdf:6:1: "), HasSubstr("max_rnage"), HasSubstr("max_range")));
  write("<insonify:sonar name='fls'><max_range>-3</max_range></insonify:sonar>");
  EXPECT_THAT(refusal(), HasSubstr("tank.sdf:6:1: sonars[0].max_range = -3"));
  write("<insonify:sonar name='fls'><position>1 2 3</position></insonify:sonar>");
  EXPECT_EQ(refusal(), "tank.sdf:6:1: sonar 'fls': <position> is written as <pose>");
  write("<insonify:sonar name='fls'><range>3</range><range>4</range></insonify:sonar>");
  EXPECT_EQ(refusal(), "tank.sdf:6:1: sonar fls: <range> appears twice");
  write("", "<plugin name='insonify' filename='none'><sonar name='fls'><link>boom</link></sonar></plugin>");
  EXPECT_THAT(refusal(), HasSubstr("sonar 'fls': <link> = 'boom' is not a link of the model rov"));
}

TEST_F(SdfSonarsTest, OtherElementsOfOursAreStillErrors) {
  write("<insonify:sonnar name='fls'/>");
  folder_.write("own.yaml", "world: tank.sdf\nsonars: [{name: mine}]\n");
  const Scenario own = load_scenario("own.yaml");
  try {
    (void)load_scene(own);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("<insonify:sonnar> is unknown"));
  }
}

}  // namespace
}  // namespace insonify::sdf_sonars_test
