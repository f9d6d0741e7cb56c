// change_simulator_test.cpp -- changed sonars and objects give the same pings as if they had been there from the start.

#include "insonify/simulator.h"
#include "simulator/small_world.h"

namespace insonify::change_simulator_test {
namespace {

using namespace testing_scenes;

class ChangeSimulatorTest : public testing::TestWithParam<PingCase> {};
INSTANTIATE_TEST_SUITE_P(Cases, ChangeSimulatorTest, testing::ValuesIn(kPingCases), kPingCaseName);

// ---- Sonars ---------------------------------------------------------------------------------------------------------

TEST_P(ChangeSimulatorTest, ChangedSonarHearsAsOneThatWasAlwaysSo) {
  Scenario scenario = small_scenario(GetParam());
  scenario.surface = SeaSurface{.level = 3, .wind_speed = 2};
  Simulator simulator(scenario, small_world(), 2);
  Ping ping;
  simulator.ping(0, {.number = 1}, ping);
  const auto change = [&](const auto& act) {
    SonarConfig sonar = simulator.scenario().sonars[0];
    act(sonar);
    simulator.set_sonar(0, sonar);
    scenario.sonars[0] = sonar;
    simulator.ping(0, {.number = 1}, ping);
    Simulator other(scenario, small_world(), 2);
    expect_same(ping, other.ping(0, {.number = 1}));
    EXPECT_EQ(*simulator.sonar(0).ping_period, *other.sonar(0).ping_period);
  };
  const auto trace = [](const char* what) { return what; };
  {
    SCOPED_TRACE(trace("range"));
    change([](SonarConfig& sonar) { sonar.max_range = 10; });
  }
  {
    SCOPED_TRACE(trace("a longer range than any before"));
    change([](SonarConfig& sonar) { sonar.max_range = 24; });
  }
  {
    SCOPED_TRACE(trace("gain"));
    change([](SonarConfig& sonar) { sonar.gain = 0.5; });
  }
  {
    SCOPED_TRACE(trace("beams and bins"));
    change([](SonarConfig& sonar) {
      sonar.beam_count = 20;
      sonar.bin_count = 333;
    });
  }
  {
    SCOPED_TRACE(trace("frequency, and place on the vehicle"));
    change([](SonarConfig& sonar) {
      sonar.frequency = 300e3;
      sonar.position = {0.2, 0, -0.5};
    });
  }
}

TEST_P(ChangeSimulatorTest, OtherSonarsDoNotChange) {
  Scenario scenario = small_scenario(GetParam());
  scenario.sonars.push_back(small_sonar());
  scenario.sonars[1].name = "stern";
  Simulator simulator(scenario, small_world(), 2);
  const Ping before = simulator.ping(1, {});
  SonarConfig sonar = simulator.scenario().sonars[0];
  sonar.max_range = 8;
  simulator.set_sonar(0, sonar);
  expect_same(simulator.ping(1, {}), before);
}

TEST(SetSonarTest, RefusesWhatAScenarioWouldAndLeavesTheSonarAsItWas) {
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.sonars.push_back(small_sonar());
  scenario.sonars[1].name = "stern";
  Simulator simulator(scenario, small_world(), 1);
  const Ping before = simulator.ping(1, {});
  SonarConfig sonar = scenario.sonars[1];
  sonar.max_range = 0.1;
  EXPECT_EQ(message_of([&] { simulator.set_sonar(1, sonar); }),
            "sonars[1].max_range = 0.1 m must be greater than min_range = 0.2 m");
  expect_same(simulator.ping(1, {}), before);
}

TEST(SetSonarTest, ASonarKeepsItsName) {
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.sonars.push_back(small_sonar());
  scenario.sonars[1].name = "stern";
  Simulator simulator(scenario, small_world(), 1);
  simulator.set_sonar(1, scenario.sonars[0]);
  EXPECT_EQ(simulator.scenario().sonars[1].name, "stern");
  EXPECT_EQ(simulator.sonar(1).name, "stern");
}

// ---- Objects --------------------------------------------------------------------------------------------------------

// One instance of the small world, with its material.
Scene only(int instance) {
  const Scene world = small_world();
  Scene scene;
  scene.instances = {world.instances[instance]};
  scene.materials = {world.materials[world.instances[instance].materials[0]]};
  std::ranges::fill(scene.instances[0].materials, std::uint16_t{0});
  return scene;
}

// The small world without its last instance.
Scene world_without_ball() {
  Scene scene = small_world();
  scene.instances.pop_back();
  scene.materials.pop_back();
  return scene;
}

TEST_P(ChangeSimulatorTest, AddedObjectIsHeardAsOneThatWasAlwaysThere) {
  const Scenario scenario = small_scenario(GetParam());
  Simulator simulator(scenario, world_without_ball(), 2);
  const Ping before = simulator.ping(0, {});
  EXPECT_EQ(simulator.add_objects(only(kBall)), kBall);
  const Ping after = simulator.ping(0, {});
  EXPECT_GT(apart(before, after), 0.02);
  expect_same(after, Simulator(scenario, small_world(), 2).ping(0, {}));
}

TEST_P(ChangeSimulatorTest, RemovedObjectIsHeardNoMore) {
  const Scenario scenario = small_scenario(GetParam());
  Simulator simulator(scenario, small_world(), 2);
  (void)simulator.ping(0, {});
  simulator.remove_object("ball");
  expect_same(simulator.ping(0, {}), Simulator(scenario, world_without_ball(), 2).ping(0, {}));
}

TEST_P(ChangeSimulatorTest, LabelsKeepTheirMeaning) {
  Scenario scenario = small_scenario(GetParam());
  scenario.receiver.noise = false;
  scenario.surface = SeaSurface{.level = 5};
  Simulator simulator(scenario, small_world(), 2);
  // Nearest labelled bin in the middle beam.
  const auto nearest_label = [&](double height) {
    const Ping ping = simulator.ping(0, {.world_from_vehicle = {.position = {2, 0.5, height}}});
    int bin = 0;
    while (ping.instance[ping.index(bin, 16)] == kNoLabel) {
      ++bin;
    }
    return static_cast<int>(ping.instance[ping.index(bin, 16)]);
  };
  EXPECT_EQ(nearest_label(-1.2), kBall);
  simulator.remove_object("box");
  EXPECT_EQ(nearest_label(-1.2), kBall);
  simulator.remove_object("ball");
  EXPECT_EQ(nearest_label(-1.2), kFloor);
  EXPECT_EQ(simulator.add_objects(only(kBall)), kBox) << "the lowest that is free";
  EXPECT_EQ(nearest_label(-1.2), kBox);
  EXPECT_EQ(simulator.scene().instances[kBox].name, "ball");
  EXPECT_FALSE(simulator.scene().instances[kBall].present);
  EXPECT_EQ(simulator.scene().instances.size(), 6U) << "the five of the world and the sea's surface";
  EXPECT_EQ(simulator.scene().materials.size(), small_world().materials.size() + 1) << "the ball's exists already";
}

TEST_P(ChangeSimulatorTest, AddedObjectsCanMove) {
  const Scenario scenario = small_scenario(GetParam());
  Simulator simulator(scenario, world_without_ball(), 2);
  simulator.add_objects(only(kBall), std::vector<MovableObject>{{"ball"}});
  Simulator expected(scenario, small_world(), 2, std::vector<MovableObject>{{"ball"}});
  const PingRequest request{.moved = {{.name = "ball", .world_from_object = {.position = {4, 0, -1}}}}};
  expect_same(simulator.ping(0, request), expected.ping(0, request));
  simulator.remove_object("ball");
  expect_same(simulator.ping(0, {}), Simulator(scenario, world_without_ball(), 2).ping(0, {}));
  EXPECT_EQ(message_of([&] { (void)simulator.ping(0, request); }),
            "ping 0 of fls: moved[0].name = ball is not in the world; there are box, floor, ship");
  EXPECT_EQ(message_of([&] { (void)simulator.ping(0, {.moved = {{.instance = kBall}}}); }),
            "ping 0 of fls: moved[0].instance = 4 (ball) has been removed");
}

// The ball beside its place as an object of this name, with a material of its own.
Scene buoy(const std::string& name, double reflectivity) {
  Scene scene = only(kBall);
  scene.instances[0].name = name;
  scene.instances[0].world_from_mesh.position = {5, -0.8, -1.2};
  scene.materials[0].name = name;
  scene.materials[0].reflectivity = reflectivity;
  return scene;
}

TEST_P(ChangeSimulatorTest, WhatHasTheIndexOfARemovedObjectIsHeardAsIfItAlwaysHad) {
  const Scenario scenario = small_scenario(GetParam());
  Simulator simulator(scenario, small_world(), 2, std::vector<MovableObject>{{"box"}});
  (void)simulator.ping(0, {.moved = {{.name = "box", .world_from_object = {.position = {6, -2, -1.4}}}}});
  simulator.remove_object("box");
  EXPECT_EQ(simulator.add_objects(buoy("buoy", 0.3)), kBox);
  Scene world = small_world();
  const Scene expected = buoy("buoy", 0.3);
  world.instances[kBox].name = "buoy";
  world.instances[kBox].mesh = expected.instances[0].mesh;
  world.instances[kBox].world_from_mesh = expected.instances[0].world_from_mesh;
  world.instances[kBox].reliefs.clear();
  world.materials[world.instances[kBox].materials[0]] = expected.materials[0];
  expect_same(simulator.ping(0, {}), Simulator(scenario, world, 2).ping(0, {}));
  EXPECT_EQ(message_of([&] { (void)simulator.ping(0, {.moved = {{.instance = kBox}}}); }),
            "ping 0 of fls: moved[0].instance = 1 (buoy) is not movable; nothing is");
  EXPECT_EQ(simulator.scene().materials, world.materials) << "the box's material is that of no instance";
}

TEST(AddObjectsTest, IndicesOfWhatIsGoneAreFreeAgain) {
  Simulator simulator(quiet_scenario(small_sonar()), small_world(), 1);
  const Scene added = buoy("buoy", 0.3);
  constexpr int kMoreThanLabels = 70000;
  for (int i = 0; i < kMoreThanLabels; ++i) {
    ASSERT_EQ(simulator.add_objects(added), kBall + 1);
    simulator.remove_object("buoy");
  }
  EXPECT_EQ(simulator.scene().instances.size(), small_world().instances.size() + 1);
  EXPECT_EQ(simulator.scene().materials.size(), small_world().materials.size() + 1);
}

TEST(AddObjectsTest, PartsOfAnObjectHaveIndicesInARow) {
  Simulator simulator(quiet_scenario(small_sonar()), small_world(), 1);
  Scene pair = buoy("pair::left", 0.3);
  pair.instances.push_back(pair.instances[0]);
  pair.instances[1].name = "pair::right";
  simulator.remove_object("box");
  EXPECT_EQ(simulator.add_objects(pair), kBall + 1) << "only one is free before";
  simulator.remove_object("ship");
  EXPECT_EQ(simulator.add_objects(buoy("buoy", 0.3)), kBox);
  simulator.remove_object("pair");
  EXPECT_EQ(simulator.add_objects(pair), kHull);
  simulator.remove_object("ball");
  pair.instances[0].name = "pair::top";
  pair.instances[1].name = "pair::bottom";
  EXPECT_EQ(simulator.add_objects(pair), kBall) << "the ball's and the one after it";
  EXPECT_EQ(simulator.scene().instances.size(), small_world().instances.size() + 2);
}

TEST(AddObjectsTest, AMovableObjectCanComeBackBeforeTheNextPing) {
  const std::vector<MovableObject> movable = {{"ball"}};
  Simulator simulator(quiet_scenario(small_sonar()), small_world(), 1, movable);
  const PingRequest request{.moved = {{.name = "ball", .world_from_object = {.position = {4, 0, -1}}}}};
  const Ping before = simulator.ping(0, request);
  simulator.remove_object("ball");
  simulator.add_objects(only(kBall), movable);
  expect_same(simulator.ping(0, request), before);
}

TEST(AddObjectsTest, ASonarPreparedForOtherMaterialsIsMadeAgain) {
  const Scenario scenario = quiet_scenario(small_sonar());
  Simulator simulator(scenario, small_world(), 1);
  PreparedSonar prepared = Simulator::prepare_sonar(scenario, 0, simulator.scene());
  simulator.remove_object("ball");
  simulator.add_objects(buoy("buoy", 0.1));  // Its material has the index of the ball's.
  const Ping before = simulator.ping(0, {});
  simulator.set_sonar(0, std::move(prepared));
  expect_same(simulator.ping(0, {}), before);
}

TEST(AddObjectsTest, RefusesNamesThatAreThereAndMaterialsThatAreNot) {
  Simulator simulator(quiet_scenario(small_sonar()), small_world(), 1);
  const Ping before = simulator.ping(0, {});
  EXPECT_EQ(message_of([&] { simulator.add_objects(only(kBall)); }),
            "an object ball exists already; remove it first, or choose another name");
  Scene bare = only(kBall);
  bare.instances[0].name = "buoy";
  bare.instances[0].materials.clear();
  EXPECT_EQ(message_of([&] { simulator.add_objects(bare); }), "buoy has no materials: assign_materials() comes first");
  Scene nameless = only(kBall);
  nameless.instances[0].name.clear();
  EXPECT_EQ(message_of([&] { simulator.add_objects(nameless); }), "an object to be added has no name");
  const Scene added = buoy("buoy", 0.7);
  EXPECT_EQ(message_of([&] { simulator.add_objects(added, std::vector<MovableObject>{{"boy"}}); }),
            "movable[0].name = boy is not in the world; there are ball, box, buoy, floor, ship");
  EXPECT_EQ(simulator.scene().instances.size(), small_world().instances.size());
  expect_same(simulator.ping(0, {}), before);
  simulator.remove_object("ball");
  EXPECT_EQ(message_of([&] { simulator.add_objects(added, std::vector<MovableObject>{{"boy"}}); }),
            "movable[0].name = boy is not in the world; there are box, buoy, floor, ship");
  EXPECT_EQ(simulator.scene().instances.at(kBall).name, "ball");
  EXPECT_FALSE(simulator.scene().instances.at(kBall).present);
  EXPECT_EQ(simulator.scene().materials, small_world().materials);
}

TEST(RemoveObjectTest, RefusesWhatIsNotThere) {
  Simulator simulator(quiet_scenario(small_sonar()), small_world(), 1);
  EXPECT_EQ(message_of([&] { simulator.remove_object("whale"); }),
            "whale is not in the world; there are ball, box, floor, ship");
  simulator.remove_object("ship");
  EXPECT_EQ(message_of([&] { simulator.remove_object("ship"); }),
            "ship is not in the world; there are ball, box, floor");
}

// What would be read out of bounds, or place nothing anywhere.
TEST(WrongSceneTest, IsRefused) {
  const auto message_with = [](auto&& change) {
    Scene scene = small_world();
    change(scene.instances.at(kBall));
    return message_of([&] { Simulator(quiet_scenario(small_sonar()), scene, 1); });
  };
  EXPECT_EQ(message_with([](Instance& ball) { ball.mesh = nullptr; }), "ball has no mesh");
  EXPECT_EQ(message_with([](Instance& ball) { ball.materials.clear(); }),
            "ball has no materials: assign_materials() comes first");
  EXPECT_EQ(message_with([](Instance& ball) { ball.materials.push_back(0); }),
            "ball has 2 materials, its mesh names 1");
  EXPECT_THAT(message_with([](Instance& ball) { ball.materials = {999}; }),
              testing::HasSubstr("ball has the material 999, must be less than "));
  EXPECT_EQ(message_with([](Instance& ball) { ball.world_from_mesh.orientation.coeffs().setZero(); }),
            "ball.world_from_mesh.orientation must be a unit quaternion; the norm of this one is 0");
}

TEST(WrongSonarTest, IsRefused) {
  Simulator simulator(quiet_scenario(small_sonar()), small_world(), 1);
  EXPECT_EQ(message_of([&] { (void)simulator.ping(1, PingRequest{}); }), "sonar = 1 must be from 0 to 0, the last");
  EXPECT_EQ(message_of([&] { (void)simulator.ping(-1, PingRequest{}); }), "sonar = -1 must be from 0 to 0, the last");
  EXPECT_EQ(message_of([&] { (void)simulator.make_ping(3, 0); }), "sonar = 3 must be from 0 to 0, the last");
  EXPECT_EQ(message_of([&] { (void)simulator.sonar(5); }), "sonar = 5 must be from 0 to 0, the last");
  EXPECT_EQ(message_of([&] { (void)simulator.world_from_head(9, {}); }), "sonar = 9 must be from 0 to 0, the last");
  EXPECT_EQ(message_of([&] { simulator.set_sonar(4, small_sonar()); }), "sonar = 4 must be from 0 to 0, the last");
}

}  // namespace
}  // namespace insonify::change_simulator_test
