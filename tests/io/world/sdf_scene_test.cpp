// sdf_scene_test.cpp -- poses and names from SDF: frames, nesting, includes, versions.

#include "io/sdf_files.h"

namespace insonify::sdf_scene_test {
namespace {

using SdfSceneTest = SdfTest;

// A model of one link with one small box, at a pose in its link; the link has a pose in its model.
std::string model_sdf(const std::string& name, const std::string& inside = "", const std::string& version = "1.9") {
  return fmt::format(R"(<sdf version="{}"><model name="{}"><static>true</static>
<link name="body"><pose>0 0 1 0 0 0</pose>
<visual name="box"><pose>0.5 0 0 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry></visual></link>
{}</model></sdf>)",
                     version, name, inside);
}

// A quarter turn to port about z, as SDF writes it: roll, pitch, yaw.
constexpr const char* kQuarterTurn = "0 0 1.5707963267948966";

TEST_F(SdfSceneTest, PutsAVisualAtModelTimesLinkTimesVisual) {
  const Scene scene = load(fmt::format(R"(<sdf version="1.9"><world name="sea"><model name="ship">
<pose>10 20 30 {0}</pose>
<link name="hull"><pose>1 0 0 {0}</pose>
<visual name="plate"><pose>1 0 0 0.1 0.2 0.3</pose><geometry><box><size>1 2 3</size></box></geometry></visual>
</link></model></world></sdf>)",
                                       kQuarterTurn));
  ASSERT_EQ(scene.instances.size(), 1);
  EXPECT_EQ(scene.instances[0].name, "ship::hull::plate");
  EXPECT_TRUE(scene.instances[0].user_material.empty());
  EXPECT_TRUE(scene.instances[0].materials.empty());
  // The link's x is the world's y, so the link stands at (10, 21, 30); its own x is the world's -x.
  const Pose& pose = scene.instances[0].world_from_mesh;
  EXPECT_THAT(pose.position, Near3(Vec3(9, 21, 30), kPoseError));
  const Eigen::Quaterniond expected =
      Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()) * orientation_from_rpy(0.1, 0.2, 0.3);
  EXPECT_LT(pose.orientation.angularDistance(expected), 1e-7);  // acos near 1 loses half the digits
  EXPECT_TRUE(said.empty());
}

// As saved by Gazebo: initial poses of the models, and in <state> their current poses in the world.
TEST_F(SdfSceneTest, TakesModelsToWhereASavedStateHasThem) {
  const Scene scene = load(fmt::format(R"(<sdf version="1.6"><world name="sea">
<model name="wreck"><static>1</static><pose frame="">1 2 3 0 0 0</pose><link name="hull"><pose>1 0 0 0 0 0</pose>
<visual name="plate"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model>
<model name="buoy"><static>1</static><pose frame="">5 6 7 0 0 0</pose><link name="hull">
<visual name="plate"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model>
<state world_name="sea"><sim_time>360 764000000</sim_time>
<model name="wreck"><pose frame="">10 20 -90 {0}</pose><scale>1 1 1</scale>
<link name="hull"><pose frame="">10 21 -90 {0}</pose></link></model>
<model name="gone"><pose frame="">0 0 0 0 0 0</pose></model></state>
<state world_name="sea"><model name="wreck"><pose frame="">7 7 7 0 0 0</pose></model></state>
</world></sdf>)",
                                       kQuarterTurn));
  ASSERT_EQ(scene.instances.size(), 2);
  // The link's (1, 0, 0) in the turned model.
  EXPECT_THAT(scene.instances[0].world_from_mesh.position, Near3(Vec3(10, 21, -90), kPoseError));
  EXPECT_THAT(scene.instances[0].world_from_mesh.orientation * Vec3::UnitX(), Near3(Vec3::UnitY(), kPoseError));
  EXPECT_THAT(scene.instances[1].world_from_mesh.position, Near3(Vec3(5, 6, 7), kPoseError));
  EXPECT_TRUE(said.empty());
}

TEST_F(SdfSceneTest, FollowsFramesAndChainsOfRelativeTo) {
  const Scene scene = load(fmt::format(R"(<sdf version="1.9"><world name="sea">
<frame name="harbour"><pose>100 0 0 {0}</pose></frame>
<model name="ship"><static>true</static><pose relative_to="harbour">5 0 0 0 0 0</pose>
<frame name="deck" attached_to="hull"><pose>0 0 2 0 0 0</pose></frame>
<frame name="mast"><pose relative_to="deck">1 0 0 {0}</pose></frame>
<link name="hull"><pose>0 3 0 0 0 0</pose></link>
<link name="crane"><pose relative_to="mast">0 0 4 0 0 0</pose>
<visual name="hook"><pose relative_to="hull">0 0 -1 0 0 0</pose>
<geometry><box><size>1 2 3</size></box></geometry></visual>
<visual name="arm"><pose>2 0 0 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry></visual>
</link></model></world></sdf>)",
                                       kQuarterTurn));
  ASSERT_EQ(scene.instances.size(), 2);
  // World from model: (100, 5, 0), turned by 90 deg. In the model: hull (0, 3, 0), deck (0, 3, 2), mast (1, 3, 2)
  // turned, crane (1, 3, 6) turned. The hook is at the hull's (0, 0, -1): model (0, 3, -1), world (100 - 3, 5, -1).
  EXPECT_EQ(scene.instances[0].name, "ship::crane::hook");
  EXPECT_THAT(scene.instances[0].world_from_mesh.position, Near3(Vec3(97, 5, -1), kPoseError));
  // The arm at the crane's (2, 0, 0): model (1, 3 + 2, 6), world (100 - 5, 5 + 1, 6).
  EXPECT_EQ(scene.instances[1].name, "ship::crane::arm");
  EXPECT_THAT(scene.instances[1].world_from_mesh.position, Near3(Vec3(95, 6, 6), kPoseError));
}

TEST_F(SdfSceneTest, PlacesAModelByItsPlacementFrame) {
  const Scene scene = load(R"(<sdf version="1.9"><world name="sea">
<model name="ship" placement_frame="hull"><pose>10 0 0 0 0 0</pose>
<link name="hull"><pose>1 2 3 0 0 0</pose>
<visual name="plate"><pose>0 0 0.5 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry></visual>
</link></model></world></sdf>)");
  EXPECT_THAT(scene.instances.at(0).world_from_mesh.position, Near3(Vec3(10, 0, 0.5), kPoseError));
}

TEST_F(SdfSceneTest, ReadsPosesInDegreesAndQuaternions) {
  const Scene scene = load(R"(<sdf version="1.9"><model name="ship"><pose degrees="true">10 0 0 0 0 90</pose>
<link name="hull"><pose rotation_format="quat_xyzw">1 0 0 0 0 0.70710678118654757 0.70710678118654757</pose>
<visual name="plate"><pose>1 0 0 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry></visual>
</link></model></sdf>)");
  EXPECT_THAT(scene.instances.at(0).world_from_mesh.position, Near3(Vec3(9, 1, 0), kPoseError));
}

TEST_F(SdfSceneTest, ScopesNestedModels) {
  const Scene scene = load(fmt::format(R"(<sdf version="1.9"><world name="sea"><model name="ship"><pose>1 0 0 {0}</pose>
<model name="boat"><pose>2 5 0 {0}</pose><model name="oar"><pose>3 0 1 0 0 0</pose><link name="blade">
<visual name="v"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model></model></model></world></sdf>)",
                                       kQuarterTurn));
  ASSERT_EQ(scene.instances.size(), 1);
  EXPECT_EQ(scene.instances[0].name, "ship::boat::oar::blade::v");
  // The boat's (2, 5) in the turned ship is (1 - 5, 2) in the world; the oar's 3 m are along the world's -x.
  EXPECT_THAT(scene.instances[0].world_from_mesh.position, Near3(Vec3(-7, 2, 1), kPoseError));
}

// world -> fleet (by model://, in another folder) -> ship (by a relative path, beside fleet) -> bell (SDF 1.6,
// model.config)
TEST_F(SdfSceneTest, FollowsIncludesThreeDeepWhereverTheyAre) {
  write("models/fleet/model.config", "<model><name>fleet</name><sdf version='1.9'>fleet.sdf</sdf></model>");
  write("models/fleet/fleet.sdf", model_sdf("fleet",
                                            "<include><uri>parts/ship.sdf</uri><name>flagship</name>"
                                            "<pose>0 10 0 0 0 0</pose></include>"));
  write("models/fleet/parts/ship.sdf",
        model_sdf("ship", "<include><uri>\nfile://../bell\n</uri><pose>0 0 100 0 0 0</pose></include>"));
  write("models/fleet/bell/model.config", "<model><name>bell</name><sdf version='1.6'>bell.sdf</sdf></model>");
  write("models/fleet/bell/bell.sdf", model_sdf("bell", "", "1.6"));
  // Decoys: files of the same names where libsdformat or a simple search would look.
  write("parts/ship.sdf", model_sdf("wrong"));
  write("worlds/parts/ship.sdf", model_sdf("wrong"));
  const std::string world = write("worlds/harbour.world", R"(<sdf version="1.9"><world name="harbour">
<include><uri>model://fleet</uri><pose>1000 0 0 0 0 0</pose></include>
<include><uri>model://fleet</uri><name>enemy</name><pose>2000 0 0 0 0 0</pose></include>
</world></sdf>)");
  const Scene scene = load_file(world);
  std::vector<std::string> names;
  for (const Instance& instance : scene.instances) {
    names.push_back(instance.name);
  }
  EXPECT_THAT(names, testing::ElementsAre("fleet::body::box", "fleet::flagship::body::box",
                                          "fleet::flagship::bell::body::box", "enemy::body::box",
                                          "enemy::flagship::body::box", "enemy::flagship::bell::body::box"));
  EXPECT_THAT(scene.instances[2].world_from_mesh.position, Near3(Vec3(1000.5, 10, 101), kPoseError));
  EXPECT_THAT(scene.instances[5].world_from_mesh.position, Near3(Vec3(2000.5, 10, 101), kPoseError));
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[5].mesh);
  EXPECT_TRUE(said.empty());
}

TEST_F(SdfSceneTest, PrefersFilesBesideTheIncludingFileToTheCurrentFolder) {
  const std::filesystem::path before = std::filesystem::current_path();
  write("current/part.sdf", model_sdf("wrong"));
  write("world/part.sdf", model_sdf("right"));
  const std::string world = write("world/sea.sdf",
                                  "<sdf version='1.9'><world name='sea'><include><uri>part.sdf</uri>"
                                  "</include></world></sdf>");
  std::filesystem::current_path(folder / "current");
  const Scene scene = load_file(world);
  std::filesystem::current_path(before);
  EXPECT_EQ(scene.instances.at(0).name, "right::body::box");
}

TEST_F(SdfSceneTest, MergesIncludesThatAskForIt) {
  write("ship.sdf", model_sdf("ship"));
  const Scene scene = load(R"(<sdf version="1.9"><model name="fleet"><include merge="true"><uri>ship.sdf</uri></include>
</model></sdf>)");
  EXPECT_EQ(scene.instances.at(0).name, "fleet::body::box");
  EXPECT_THAT(scene.instances[0].world_from_mesh.position, Near3(Vec3(0.5, 0, 1), kPoseError));
}

TEST_F(SdfSceneTest, TakesIncludesWrittenInCommentsForComments) {
  const Scene scene = load(R"(<sdf version="1.9"><!-- <include><uri>model://nothing</uri></include> --><model name="a">
<link name="l"><visual name="v"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model></sdf>)");
  EXPECT_EQ(scene.instances.size(), 1);
}

TEST_F(SdfSceneTest, ReadsAllModelsOfAFileWithoutWorld) {
  write("ship.sdf", model_sdf("ship"));
  const Scene scene = load(R"(<sdf version="1.9">
<model name="a"><pose>1 0 0 0 0 0</pose><link name="l"><visual name="v"><geometry><box><size>1 2 3</size></box></geometry>
</visual></link></model>
<model name="b"><pose>2 0 0 0 0 0</pose><link name="l"><visual name="v"><geometry><box><size>1 2 3</size></box></geometry>
</visual></link></model>
<include><uri>ship.sdf</uri></include></sdf>)");
  ASSERT_EQ(scene.instances.size(), 3);
  EXPECT_EQ(scene.instances[0].name, "a::l::v");
  EXPECT_EQ(scene.instances[1].name, "b::l::v");
  EXPECT_THAT(scene.instances[1].world_from_mesh.position, Near3(Vec3(2, 0, 0), kPoseError));
  EXPECT_EQ(scene.instances[2].name, "ship::body::box");
}

TEST_F(SdfSceneTest, ReadsAllWorldsOfAFile) {
  const std::string model =
      "<model name='{}'><link name='l'><visual name='v'><geometry><box><size>1 2 3</size></box>"
      "</geometry></visual></link></model>";
  const Scene scene = load("<sdf version='1.9'><world name='one'>" + fmt::format(fmt::runtime(model), "a") +
                           "</world><world name='two'>" + fmt::format(fmt::runtime(model), "b") + "</world></sdf>");
  ASSERT_EQ(scene.instances.size(), 2);
  EXPECT_EQ(scene.instances[1].name, "b::l::v");
}

TEST_F(SdfSceneTest, TakesVisualsUnlessAskedForCollisions) {
  const std::string text = R"(<sdf version="1.9"><model name="ship"><link name="hull">
<collision name="shell"><pose>0 0 1 0 0 0</pose><geometry><box><size>4 5 6</size></box></geometry></collision>
<visual name="plate"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model></sdf>)";
  EXPECT_EQ(load(text).instances.at(0).name, "ship::hull::plate");
  const Scene scene = load(text, true);
  ASSERT_EQ(scene.instances.size(), 1);
  EXPECT_EQ(scene.instances[0].name, "ship::hull::shell");
  EXPECT_THAT(world_bounds(scene.instances[0]).high, Near3(Vec3(2, 2.5, 4), kVertexError));
}

TEST_F(SdfSceneTest, TakesWhatIsTransparentOrHiddenFromCameras) {
  const Scene scene = load(sdf_of("<box><size>1 2 3</size></box>",
                                  "<transparency>1</transparency><visibility_flags>0</visibility_flags>"
                                  "<material><script><name>Gazebo/Steel</name></script></material>"));
  EXPECT_EQ(scene.instances.size(), 1);
  EXPECT_EQ(scene.instances[0].user_material, "");
}

TEST_F(SdfSceneTest, DoesNotMindFaultsInWhatHasNoShape) {
  const Scene scene = load(R"(<sdf version="1.9"><world name="sea">
<light name="sun" type="no such type"/>
<physics><real_time_factor>fast</real_time_factor></physics>
<gui><camera/></gui><state world_name="other"><model name="ship"><pose>1 1 1 0 0 0</pose></model>
<insertions><model name="odd"/></insertions></state>
<model name="ship"><link name="hull">
<inertial><mass>heavy</mass></inertial><sensor name="eye"><camera/></sensor>
<visual name="plate"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model></world></sdf>)");
  EXPECT_EQ(scene.instances.size(), 1);
}

TEST_F(SdfSceneTest, ReadsOldVersionsAsTheyWereMeant) {
  for (const char* version : {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9"}) {
    const Scene scene = load(fmt::format(R"(<?xml version="1.0" ?>
<sdf version="{}"><world name="sea"><light name="sun" type="directional"/>
<model name="ship"><pose>1 2 3 0 0 0</pose><link name="hull"><pose>0 0 1 0 0 0</pose>
<visual name="plate"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model></world></sdf>)",
                                         version));
    EXPECT_THAT(scene.instances.at(0).world_from_mesh.position, Near3(Vec3(1, 2, 4), kPoseError)) << version;
    EXPECT_TRUE(said.empty()) << version << ": " << said[0];
  }
}

TEST_F(SdfSceneTest, ReadsNewerVersionsWithAWarning) {
  write("new.sdf", model_sdf("new", "", "1.12"));
  const Scene scene = load(R"(<sdf version="1.11"><world name="sea">
<include><uri>new.sdf</uri></include></world></sdf>)");
  EXPECT_EQ(scene.instances.at(0).name, "new::body::box");
  EXPECT_THAT(said, testing::ElementsAre(
                        "scene.sdf:1:1: SDF version 1.11 is newer than 1.9 and read as that; new features are ignored",
                        "new.sdf:1:1: SDF version 1.12 is newer than 1.9 and read as that; new features are ignored"));
}

TEST_F(SdfSceneTest, WarnsOfVersionsThatAreTooOld) {
  for (const char* version : {"1.3", "0.1"}) {
    const Scene scene = load(model_sdf("old", "", version));
    EXPECT_EQ(scene.instances.at(0).name, "old::body::box");
    EXPECT_THAT(said,
                testing::Contains(fmt::format("scene.sdf:1:1: SDF version {} is older than 1.4, the oldest that is "
                                              "known to be read right",
                                              version)));
  }
}

TEST_F(SdfSceneTest, WarnsOfActors) {
  load(R"(<sdf version="1.9"><world name="sea"><model name="a"><link name="l"><visual name="v"><geometry><box>
<size>1 2 3</size></box></geometry></visual></link></model><actor name="diver"><skin><filename>diver.dae</filename></skin>
<animation name="swim"><filename>diver.dae</filename></animation><script><trajectory id="0" type="swim"><waypoint>
<time>0</time><pose>0 0 0 0 0 0</pose></waypoint></trajectory></script></actor></world></sdf>)");
  EXPECT_THAT(said, testing::ElementsAre("scene.sdf:2:60: an actor is skipped"));
}

TEST_F(SdfSceneTest, PrintsNothing) {
  write("ship.sdf", model_sdf("ship", "", "1.11"));
  load(model_sdf("ship"));  // Where SDF cannot be read that is printed, and this test skipped.
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  load(R"(<sdf version="1.9"><world name="w"><include><uri>ship.sdf</uri></include></world></sdf>)");
  error_of(R"(<sdf version="1.9"><model name="ship"><link name="hull"><pose>one</pose></link></model></sdf>)");
  write("ship/model.config",
        "<model><name>ship</name><sdf version='1.11'>new.sdf</sdf><sdf version='1.6'>old.sdf</sdf></model>");
  error_of(R"(<sdf version="1.9"><world name="w"><include><uri>ship</uri></include></world></sdf>)");
  write("ship/model.config", "<model><name>ship</name>");
  error_of(R"(<sdf version="1.9"><world name="w"><include><uri>ship</uri></include></world></sdf>)");
  write("ship.sdf", "<sdf version='1.9'><model name='ship'><link/></model></sdf>");
  error_of(R"(<sdf version="1.9"><world name="w"><include><uri>ship.sdf</uri></include></world></sdf>)");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(SdfSceneTest, CopiesAreInMemoryOnly) {
  setenv("TMPDIR", "/no/such/folder", 1);
  std::string includes;
  for (int i = 0; i < 20; ++i) {  // Names of copies begin as those of others do: "fd/1", "fd/12".
    write(fmt::format("models/ship{}/model.sdf", i), model_sdf(fmt::format("ship{}", i), "", "1.6"));
    includes += fmt::format("<include><uri>model://ship{}</uri></include>\n", i);
  }
  const auto open_files = [] {
    const std::filesystem::directory_iterator files("/proc/self/fd");
    return std::distance(begin(files), end(files));
  };
  const auto before = open_files();
  EXPECT_EQ(load("<sdf version='1.9'><world name='w'>" + includes + "</world></sdf>").instances.size(), 20U);
  EXPECT_EQ(open_files(), before);
  unsetenv("TMPDIR");
}

}  // namespace
}  // namespace insonify::sdf_scene_test
