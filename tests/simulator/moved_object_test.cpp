// moved_object_test.cpp -- objects moved by ping requests.

#include "insonify/simulator.h"
#include "simulator/small_world.h"

namespace insonify::moved_object_test {
namespace {

using namespace testing_scenes;

class MovedObjectTest : public testing::TestWithParam<PingCase> {};
INSTANTIATE_TEST_SUITE_P(Cases, MovedObjectTest, testing::ValuesIn(kPingCases), kPingCaseName);

const Pose kAside{{5, -1.5, -1.8}, orientation_from_rpy(0.3, -0.2, 0.8)};

// Rounding differs, since moving instances are kept in their own frame.
constexpr double kSame = 2e-3;

std::vector<MovableObject> movable(std::initializer_list<const char*> names) {
  std::vector<MovableObject> objects;
  for (const char* name : names) {
    objects.push_back({name});
  }
  return objects;
}

// Without speckle, which objects carry with them: one that was moved has that of its place in the scene.
Scenario without_speckle(const PingCase& of_case) {
  Scenario scenario = small_scenario(of_case);
  scenario.receiver.speckle = false;
  return scenario;
}

// The small world with one instance at another pose.
Scene world_with(int instance, const Pose& pose) {
  Scene scene = small_world();
  scene.instances[instance].world_from_mesh = pose;
  return scene;
}

TEST_P(MovedObjectTest, GivesThePingOfASceneThatHasItThere) {
  const Scenario scenario = without_speckle(GetParam());
  Simulator simulator(scenario, small_world(), 2, movable({"box", "ball"}));
  for (const auto& [name, instance] : {std::pair("box", kBox), std::pair("ball", kBall)}) {
    SCOPED_TRACE(name);
    const Ping expected = Simulator(scenario, world_with(instance, kAside), 2).ping(0, {});
    const Ping by_name = simulator.ping(0, {.moved = {{.name = name, .world_from_object = kAside}}});
    EXPECT_LT(apart(expected, by_name), kSame);
    EXPECT_GT(apart(expected, simulator.ping(0, {})), 0.02);
    expect_same(simulator.ping(0, {.moved = {{.instance = instance, .world_from_object = kAside}}}), by_name);
  }
}

TEST_P(MovedObjectTest, IsBackWhereTheSceneHasItWhenARequestDoesNotNameIt) {
  Simulator simulator(small_scenario(GetParam()), small_world(), 2, movable({"box"}));
  const Ping home = simulator.ping(0, {});
  EXPECT_NE(simulator.ping(0, {.moved = {{.name = "box", .world_from_object = kAside}}}).intensity, home.intensity);
  expect_same(simulator.ping(0, {}), home);
}

TEST_P(MovedObjectTest, TakesItsPartsAlong) {
  const Scenario scenario = without_speckle(GetParam());
  const Pose frame{{9, 2, -1}, orientation_from_rpy(0, 0, 0.5)}, there{{6, 1, -1.2}, orientation_from_rpy(0, 0.3, -1)};
  Scene expected = small_world();
  for (const int part : {kHull, kMast}) {
    Pose& pose = expected.instances[part].world_from_mesh;
    pose = there * frame.inverse() * pose;
  }
  const Ping ping = Simulator(scenario, expected, 2).ping(0, {});
  Simulator framed(scenario, small_world(), 2, std::vector<MovableObject>{{"ship", frame}});
  EXPECT_LT(apart(ping, framed.ping(0, {.moved = {{.name = "ship", .world_from_object = there}}})), kSame);
  // Without a given frame an object has that of its first part's mesh, which is the same here.
  Simulator unframed(scenario, small_world(), 2, movable({"ship"}));
  EXPECT_LT(apart(ping, unframed.ping(0, {.moved = {{.name = "ship", .world_from_object = there}}})), kSame);
}

TEST_P(MovedObjectTest, LaterEntriesCountAndPartsCanMoveByThemselves) {
  const Scenario scenario = small_scenario(GetParam());
  Simulator simulator(scenario, small_world(), 2, movable({"ship"}));
  const MovedObject ship{.name = "ship", .world_from_object = {.position = {6, 1, -1.2}}};
  const MovedObject mast{.name = "ship::mast", .world_from_object = kAside};
  const Ping both = simulator.ping(0, {.moved = {ship, mast}});
  const Ping overruled = simulator.ping(0, {.moved = {mast, ship}});
  EXPECT_NE(both.intensity, overruled.intensity);
  expect_same(simulator.ping(0, {.moved = {ship}}), overruled);
}

// A request moves objects as a scenario's motions do.
TEST_P(MovedObjectTest, MovesAsAMotionOfTheScenarioDoes) {
  Scenario scenario = small_scenario(GetParam());
  scenario.sonars[0].ping_period = 1;
  const Waypoint from{.time = 0, .position = {9, 2, -1}, .orientation = {0, 0, 0.5}};
  const Waypoint to{.time = 4, .position = {5, -1, -1.5}, .orientation = {0, 0, -0.5}};
  Simulator outside(scenario, small_world(), 2,
                    std::vector<MovableObject>{{"ship", Pose{from.position, orientation_from_rpy(0, 0, 0.5)}}});
  scenario.motions = {{.object = "ship", .trajectory = {{from, to}}}};
  Simulator own(scenario, small_world(), 2);
  const Pose there = scenario.motions[0].trajectory.at(3);
  expect_same(outside.ping(0, {.number = 3, .time = 3, .moved = {{.name = "ship", .world_from_object = there}}}),
              own.make_ping(0, 3));
}

TEST_P(MovedObjectTest, LabelsTellItWhereverItIs) {
  Scenario scenario = small_scenario(GetParam());
  scenario.receiver.noise = false;
  Simulator simulator(scenario, small_world(), 2, movable({"ball"}));
  // Straight ahead and nearer than everything else.
  const Ping ping = simulator.ping(0, {.moved = {{.name = "ball", .world_from_object = {.position = {2, 0, -0.2}}}}});
  int first = 0;
  while (ping.instance[ping.index(first, 16)] == kNoLabel) {
    ++first;
  }
  EXPECT_EQ(ping.instance[ping.index(first, 16)], kBall);
  EXPECT_NEAR(simulator.sonar(0).bin_range(first), 1.6, 0.1);
}

// ---- Errors ---------------------------------------------------------------------------------------------------------

class ImmovableTest : public testing::Test {
 protected:
  std::string message_of_moving(const MovedObject& moved) {
    return message_of([&] { (void)simulator_.ping(0, {.number = 7, .moved = {{.name = "ball"}, moved}}); });
  }
  Simulator simulator_{quiet_scenario(small_sonar()), small_world(), 1, movable({"ball", "ship"})};
};

TEST_F(ImmovableTest, IsWhatWasNotNamedWhenTheSimulatorWasBuilt) {
  EXPECT_EQ(message_of_moving({.name = "box"}),
            "ping 7 of fls: moved[1].name = box is not movable; there are ball, "
            "ship");
  EXPECT_EQ(message_of_moving({.instance = kFloor}),
            "ping 7 of fls: moved[1].instance = 0 (floor) is not movable; there "
            "are ball, ship");
  Simulator nothing(quiet_scenario(small_sonar()), small_world(), 1);
  EXPECT_EQ(message_of([&] { (void)nothing.ping(0, {.moved = {{.name = "ship"}}}); }),
            "ping 0 of fls: moved[0].name = ship is not movable; nothing is");
}

TEST_F(ImmovableTest, IsWhatIsNotThere) {
  EXPECT_EQ(message_of_moving({.name = "whale"}),
            "ping 7 of fls: moved[1].name = whale is not in the world; there are ball, box, floor, ship");
  EXPECT_EQ(message_of_moving({.instance = 5}),
            "ping 7 of fls: moved[1].instance = 5 must be less than 5, the number of instances");
  EXPECT_EQ(message_of([] {
              Simulator(quiet_scenario(small_sonar()), small_world(), 1, movable({"ball", "whale"}));
            }),
            "movable[1].name = whale is not in the world; there are ball, box, floor, ship");
}

TEST_F(ImmovableTest, IsWhereItWasInTheSceneAtARequest) {
  Simulator simulator(quiet_scenario(small_sonar()), small_world(), 1, movable({"ship"}));
  const Scene& still = simulator.scene();
  const Pose away{.position = {5, 6, 7}};
  const Scene moved = simulator.scene_at({.moved = {{.name = "ship", .world_from_object = away}}});
  for (std::size_t i = 0; i < still.instances.size(); ++i) {
    const bool is_ship = still.instances[i].name.starts_with("ship");
    EXPECT_EQ(is_ship, moved.instances[i].world_from_mesh.position != still.instances[i].world_from_mesh.position) << i;
    EXPECT_EQ(moved.instances[i].mesh, still.instances[i].mesh);
  }
  EXPECT_EQ(message_of([&] { (void)simulator.scene_at({.moved = {{.name = "box"}}}); }),
            "moved[0].name = box is not movable; there are ship");
}

TEST_F(ImmovableTest, IsWhatHasAFrameThatIsNone) {
  const auto message_with = [](const Pose& frame) {
    return message_of([&] {
      const MovableObject ball{.name = "ball", .world_from_object = frame};
      Simulator(quiet_scenario(small_sonar()), small_world(), 1, std::span(&ball, 1));
    });
  };
  EXPECT_EQ(message_with({.orientation = Eigen::Quaterniond(5, 0, 0, 0)}),
            "movable[0].world_from_object.orientation must be a unit quaternion; the norm of this one is 5");
  EXPECT_THAT(message_with({.position = Vec3(0, std::nan(""), 0)}),
              testing::HasSubstr("movable[0].world_from_object.position[1] = nan"));
  EXPECT_EQ(message_of([] { Simulator(quiet_scenario(small_sonar()), small_world(), 1, movable({""})); }),
            "movable[0].name must not be empty");
}

TEST_F(ImmovableTest, IsWhatHasNoNameOrTwo) {
  EXPECT_EQ(message_of_moving({}), "ping 7 of fls: moved[1] must have a name or an instance");
  EXPECT_EQ(message_of_moving({.name = "ball", .instance = kBall}),
            "ping 7 of fls: moved[1] must have a name or an instance, not both");
}

TEST_F(ImmovableTest, IsWhatWouldBeNowhere) {
  EXPECT_EQ(message_of_moving({.name = "ball", .world_from_object = {.position = {0, 0, -INFINITY}}}),
            "ping 7 of fls: moved[1].world_from_object.position[2] = -inf m must be finite and from -10000000 to "
            "10000000 m");
  EXPECT_EQ(message_of_moving({.name = "ball", .world_from_object = {.orientation = Eigen::Quaterniond(0, 0, 0, 0)}}),
            "ping 7 of fls: moved[1].world_from_object.orientation must be a unit quaternion; the norm of this one is "
            "0");
}

TEST_F(ImmovableTest, LeavesEverythingWhereItWas) {
  const Ping before = simulator_.ping(0, {.number = 7});
  EXPECT_NE(message_of_moving({.name = "whale"}), "no error");
  expect_same(simulator_.ping(0, {.number = 7}), before);
}

TEST_F(ImmovableTest, IsTheSameObjectASecondTime) {
  EXPECT_EQ(message_of([] {
              Simulator(quiet_scenario(small_sonar()), small_world(), 1, movable({"ball", "ball"}));
            }),
            "movable[1].name = ball is movable already");
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.motions = {{.object = "ball", .trajectory = {{{.time = 0}}}}};
  EXPECT_EQ(message_of([&] { Simulator(scenario, small_world(), 1, movable({"ball"})); }),
            "movable[0].name = ball is movable already");
}

}  // namespace
}  // namespace insonify::moved_object_test
