// odd_world_test.cpp -- mistakes that make a valid scenario useless are told in one line each.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "support/working_folder.h"

namespace insonify::odd_world_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class OddWorldTest : public testing::Test {
 protected:
  // What is said about a scenario and its world.
  std::vector<std::string> said(const std::string& yaml) const {
    std::vector<std::string> lines;
    const Log log = [&](Severity severity, const std::string& line) {
      if (severity == Severity::kWarning) {
        lines.push_back(line);
      }
    };
    folder.write("a.yaml", yaml);
    (void)load_scene(load_scenario("a.yaml", {}, log), log);
    return lines;
  }

  WorkingFolder folder;
};

const std::string kBed = "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n";  // Faces up.

TEST_F(OddWorldTest, ASonarUnderTheBedIsTold) {
  folder.write("bed.obj", kBed);
  EXPECT_THAT(said("world: bed.obj\nsonars: [{name: fls, position: [1, 1, -5]}]\n"),
              ElementsAre("sonar fls is 5 m under bed and nothing is below it"));
  EXPECT_THAT(said("world: bed.obj\nsonars: [{position: [1, 1, -5]}]\ntrajectory: [{position: [0, 0, 6]}]\n"),
              IsEmpty());
  EXPECT_THAT(said("world: bed.obj\nsonars: [{position: [10, 1, -5]}]\n"), IsEmpty()) << "beside it";
}

TEST_F(OddWorldTest, AWorldOfAFewCentimetresIsTold) {
  folder.write("wreck.obj", "v 0 0 0\nv .035 0 0\nv 0 .01 0\nf 1 2 3\n");
  EXPECT_THAT(said("world: wreck.obj\nsonars: [{}]\n"),
              ElementsAre((std::filesystem::current_path() / "wreck.obj").string() +
                          ": the whole world is 0.035 m long; is its unit the metre?"));
}

TEST_F(OddWorldTest, ACadFileWithYUpIsTold) {
  folder.write("up.dae", R"(<COLLADA><asset><up_axis>Y_UP</up_axis></asset></COLLADA>)");
  std::vector<std::string> lines;
  try {
    (void)load_scene("up.dae", {}, [&](Severity, const std::string& line) { lines.push_back(line); });
  } catch (const Error&) {
    // It has no shapes.
  }
  EXPECT_THAT(lines, ElementsAre("up.dae: says Y_UP, which is not applied, as in Gazebo: z is up"));
}

TEST_F(OddWorldTest, AnglesLikelyInRadiansAreTold) {
  folder.write("bed.obj", kBed);
  EXPECT_THAT(said("world: bed.obj\nsonars:\n  - orientation_deg: [0, 0.26, 0]\n    position: [0, 0, 5]\n"),
              ElementsAre("a.yaml:3:5: sonars[0].orientation_deg has angles of at most 0.26 degrees; as radians 0.26 "
                          "would be 14.9 degrees"));
  EXPECT_THAT(said("world: bed.obj\nsonars:\n  - orientation_deg: [0, 0.5, 90.3]\n    position: [0, 0, 5]\n"),
              IsEmpty());
}

TEST_F(OddWorldTest, OnlyTheFirstWaypointIsLikelyInRadians) {
  folder.write("bed.obj", kBed);
  const std::string start = "world: bed.obj\nsonars: [{position: [0, 0, 5]}]\ntrajectory:\n";
  EXPECT_THAT(
      said(start + "  - {time: 0, orientation_deg: [0, 0, 0]}\n  - {time: 1, orientation_deg: [0.6, -0.3, 0.8]}\n"),
      IsEmpty());
  EXPECT_THAT(
      said(start + "  - {time: 0, orientation_deg: [0, 0.26, 1.3]}\n  - {time: 1, orientation_deg: [0, 0.26, 1.4]}\n"),
      ElementsAre("a.yaml:4:15: trajectory[0].orientation_deg has angles of at most 1.3 degrees; as radians 1.3 "
                  "would be 74.5 degrees"));
}

TEST_F(OddWorldTest, AQuaternionWithItsScalarLastIsTold) {
  folder.write("bed.obj", kBed);
  EXPECT_THAT(
      said("world: bed.obj\nsonars:\n  - orientation_wxyz: [0, 0, 0, 1]\n    position: [0, 0, 5]\n"),
      ElementsAre("a.yaml:3:5: sonars[0].orientation_wxyz turns by 180 degrees about z; w comes first, not last"));
}

TEST_F(OddWorldTest, SaltInKilogrammesIsTold) {
  folder.write("bed.obj", kBed);
  EXPECT_THAT(said("world: bed.obj\nwater: {salinity: 0.035}\nsonars: [{position: [0, 0, 5]}]\n"),
              ElementsAre("a.yaml:2:9: water.salinity = 0.035 PSU is almost fresh water; the sea has 35"));
}

TEST_F(OddWorldTest, AnApertureOfNothingIsTold) {
  folder.write("bed.obj", kBed);
  EXPECT_THAT(
      said("world: bed.obj\nsonars:\n  - azimuth_aperture_deg: 1e-6\n    position: [0, 0, 5]\n"),
      testing::Contains("a.yaml:3:5: sonars[0].azimuth_aperture_deg = 1e-06 degrees is narrower than any sonar's"));
}

TEST_F(OddWorldTest, AMotionOfOneWaypointIsTold) {
  folder.write("bed.obj", kBed);
  EXPECT_THAT(
      said("world: bed.obj\nsonars: [{position: [0, 0, 5]}]\nmotions:\n  - object: bed\n    trajectory: [{position: "
           "[0, 0, 1]}]\n"),
      ElementsAre("a.yaml:4:5: motions[0]: a trajectory of one waypoint does not move bed"));
}

TEST_F(OddWorldTest, NothingIsToldOfTheShippedScenarios) {
  std::vector<std::string> lines;
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(INSONIFY_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() == ".yaml") {
      (void)load_scenario(entry.path(), {}, [&](Severity, const std::string& line) { lines.push_back(line); });
      ++count;
    }
  }
  EXPECT_GT(count, 10);
  EXPECT_THAT(lines, IsEmpty());
}

}  // namespace
}  // namespace insonify::odd_world_test
