// simulator_test.cpp -- whole pings: determinism, time, motion and sound speed. T numbers are those of
// docs/concepts/physics-tests.md.

#include "insonify/simulator.h"

#include <gmock/gmock.h>

#include "engines/test_scenes.h"
#include "insonify/acoustics/sound_speed.h"
#include "insonify/error.h"
#include "insonify/scenario_requests.h"

namespace insonify::simulator_test {
namespace {

using namespace testing_scenes;
using testing::ThrowsMessage;

SonarConfig small_fan() {
  SonarConfig sonar;
  sonar.beam_count = 48;
  sonar.azimuth_aperture = 100 * kDegree;
  sonar.elevation_aperture = 24 * kDegree;
  sonar.max_range = 16;
  sonar.bin_count = 240;
  sonar.sampling = {.columns_per_beam = 4, .rows = 60};
  return sonar;
}

SceneMaker busy_scene() {
  return SceneMaker()
      .add_floor(-2.4, 0.5)
      .add_wall(12, 0.9, 8)
      .add_sphere({6, 1, -1.5}, 0.7)
      .add("box", make_box({1, 2, 1.4}), {.position = {7, -2, -1.4}});
}

class SimulatorTest : public testing::TestWithParam<EngineAndModel> {};

INSTANTIATE_TEST_SUITE_P(Engines, SimulatorTest, testing::ValuesIn(engines_and_models()),
                         [](const auto& test) { return test.param.name; });

// T13. The same bytes whatever the number of threads.
TEST_P(SimulatorTest, PingsDoNotDependOnThreads) {
  Scenario scenario = quiet_scenario(small_fan(), GetParam());
  scenario.receiver.noise = true;
  scenario.secondary = SecondaryEchoes::kSelective;
  const Scene scene = busy_scene().scene();
  std::vector<Ping> pings;
  for (const int threads : {1, 2, 16}) {
    pings.push_back(Simulator(scenario, scene, threads).make_ping(0, 3));
  }
  for (const Ping& ping : pings) {
    EXPECT_EQ(ping.intensity, pings[0].intensity);
    EXPECT_EQ(ping.instance, pings[0].instance);
    EXPECT_EQ(ping.material, pings[0].material);
  }
  EXPECT_GT(*std::ranges::max_element(pings[0].intensity),
            GetParam().model == EchoModel::kPaper ? 0.5F : 1e-6F);  // 60 dB below the source.
}

TEST_P(SimulatorTest, NoiseIsDrawnAnewForEachPingAndSeedButRepeats) {
  Scenario scenario = quiet_scenario(small_fan(), GetParam());
  scenario.receiver.noise = true;
  const Scene scene = busy_scene().scene();
  Simulator simulator(scenario, scene, 2);
  const Ping first = simulator.make_ping(0, 0);
  EXPECT_NE(simulator.make_ping(0, 1).intensity, first.intensity);
  EXPECT_EQ(simulator.make_ping(0, 0).intensity, first.intensity);
  scenario.seed = 2;
  EXPECT_NE(Simulator(scenario, scene, 2).make_ping(0, 0).intensity, first.intensity);
}

// T12 without speckle: a still sonar in a still scene gives the same ping twice when there is no noise.
TEST_P(SimulatorTest, StillSceneGivesTheSamePingTwice) {
  Scenario scenario = quiet_scenario(small_fan(), GetParam());
  scenario.secondary = SecondaryEchoes::kSelective;
  Simulator simulator(scenario, busy_scene().scene(), 2);
  EXPECT_EQ(simulator.make_ping(0, 0).intensity, simulator.make_ping(0, 1).intensity);
}

// T20. A sonar that assumes 1500 m/s in fresh water of 20 degC, where sound travels at 1482.441 m/s, shows a plate at
// 10 m at 10 * 1500 / 1482.441 = 10.118 m.
TEST_P(SimulatorTest, WrongSoundSpeedShiftsRange) {
  SonarConfig sonar;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 2 * kDegree;
  sonar.elevation_aperture = 2 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 20;
  sonar.bin_count = 400;
  sonar.sampling = {.columns_per_beam = 4, .rows = 16};
  sonar.assumed_sound_speed = 1500;
  Scenario scenario = quiet_scenario(sonar, GetParam());
  scenario.water.temperature_c = 20;
  scenario.water.salinity = 0;
  scenario.water.depth = 5;
  const double expected = 10 * 1500 / scenario.water.true_sound_speed();
  EXPECT_NEAR(expected, 10.1184, 0.001);
  Simulator simulator(scenario, SceneMaker().add_wall(10).scene(), 1);
  const Ping ping = simulator.make_ping(0, 0);
  EXPECT_NEAR(centroid_bin(ping.intensity) * sonar.bin_length(), expected, 0.5 * sonar.bin_length());
}

// T22. Rotating and shifting sonar and world together changes nothing.
TEST_P(SimulatorTest, PingsDoNotDependOnTheWorldFrame) {
  const Pose moved{{120, -40, 7}, orientation_from_rpy(0.4, -0.7, 2.1)};
  Scene scene = busy_scene().scene();
  Scenario scenario = quiet_scenario(small_fan(), GetParam());
  const Ping here = Simulator(scenario, scene, 2).make_ping(0, 0);
  for (Instance& instance : scene.instances) {
    instance.world_from_mesh = moved * instance.world_from_mesh;
  }
  scenario.trajectory.waypoints = {{.time = 0, .position = moved.position, .orientation = {0.4, -0.7, 2.1}}};
  const Ping there = Simulator(scenario, scene, 2).make_ping(0, 0);
  double sum = 0, apart = 0;
  for (std::size_t i = 0; i < here.intensity.size(); ++i) {
    sum += here.intensity[i];
    apart += std::abs(here.intensity[i] - there.intensity[i]);
  }
  EXPECT_LE(apart, 1e-4 * sum);
}

// T22. A mirrored scene gives a mirrored ping.
TEST_P(SimulatorTest, MirroredSceneGivesMirroredPing) {
  Scenario scenario = quiet_scenario(small_fan(), GetParam());
  const auto scene = [](double side) {
    return SceneMaker()
        .add_floor(-2.4, 0.5)
        .add_sphere({6, side * 1, -1.5}, 0.7)
        .add("box", make_box({1, 2, 1.4}), {.position = {7, side * -2, -1.4}})
        .scene();
  };
  const Ping port = Simulator(scenario, scene(1), 2).make_ping(0, 0);
  const Ping starboard = Simulator(scenario, scene(-1), 2).make_ping(0, 0);
  double sum = 0, apart = 0;
  for (int bin = 0; bin < port.bin_count; ++bin) {
    for (int beam = 0; beam < port.beam_count; ++beam) {
      const float a = port.intensity[port.index(bin, beam)];
      sum += a;
      apart += std::abs(a - starboard.intensity[port.index(bin, port.beam_count - 1 - beam)]);
    }
  }
  EXPECT_LE(apart, 1e-4 * sum);
}

// T23. Without surfaces and noise, a ping is all zeros.
TEST_P(SimulatorTest, EmptyWaterIsSilent) {
  Scenario scenario = quiet_scenario(small_fan(), GetParam());
  scenario.secondary = SecondaryEchoes::kAll;
  const Ping ping = Simulator(scenario, Scene{}, 2).make_ping(0, 0);
  EXPECT_THAT(ping.intensity, testing::Each(0.0F));
  EXPECT_THAT(ping.instance, testing::Each(kNoLabel));
}

// T15. One pose per ping, head angle ping x step; v = 0.5 m/s along +x, step 0.9 degrees, period 2 x 30 / 1500 = 0.04
// s. A target abeam at (0, 10) is received when the head points at it: ping 114 (102.6 degrees) at 10.257 m; the one
// astern at (-10, 0) at ping 200 (180.0 degrees) at 14.000 m; that at (0, -10) at ping 269 (242.1 degrees) at 11.355 m.
TEST_P(SimulatorTest, MovingScanningSonarShearsItsPicture) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 0.9 * kDegree;
  sonar.elevation_aperture = 10 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 30;
  sonar.bin_count = 600;
  sonar.head.step = 0.9 * kDegree;
  sonar.sampling = {.columns_per_beam = 16, .rows = 200};
  sonar.assumed_sound_speed = 1500;
  Scenario scenario = quiet_scenario(sonar, GetParam());
  scenario.water.sound_speed = 1500;
  scenario.trajectory.waypoints = {{.time = 0}, {.time = 16, .position = {8, 0, 0}}};
  constexpr double kRadius = 0.05;
  struct Expected {
    Vec3 target;
    int ping;
    double range;
  };
  for (const Expected& expected :
       {Expected{{0, 10, 0}, 114, 10.2566}, Expected{{-10, 0, 0}, 200, 14.0}, Expected{{0, -10, 0}, 269, 11.3554}}) {
    Simulator simulator(scenario, SceneMaker().add_sphere(expected.target, kRadius).scene(), 2);
    const ScenarioRequests requests(scenario);
    PingRequest request;
    double best = 0, moment = 0, sum = 0;
    Ping loudest;
    Ping ping;
    for (int number = expected.ping - 3; number <= expected.ping + 3; ++number) {
      requests.fill(0, number, request);
      simulator.ping(0, request, ping);
      EXPECT_NEAR(ping.time, 0.04 * number, 1e-9);
      EXPECT_NEAR(ping.head_angle, number * sonar.head.step, 1e-9);
      double heard = 0;
      for (const float value : ping.intensity) {
        heard += value;
      }
      sum += heard;
      moment += heard * number;
      if (heard > best) {
        best = heard;
        loudest = ping;
      }
    }
    ASSERT_GT(best, 0) << expected.ping;
    EXPECT_NEAR(moment / sum, expected.ping, 0.75) << expected.ping;  // Half a step, and the width of the sphere.
    EXPECT_NEAR(centroid_bin(loudest.intensity) * sonar.bin_length(), expected.range - kRadius, sonar.bin_length());
  }
}

// T28. A ping period shorter than the two-way travel time to max_range is refused: 2 x 50 / 1500 = 0.0667 s.
TEST_P(SimulatorTest, RefusesToPingBeforeSoundIsBack) {
  SonarConfig sonar = small_fan();
  sonar.max_range = 50;
  sonar.ping_period = 0.05;
  Scenario scenario = quiet_scenario(sonar, GetParam());
  scenario.water.sound_speed = 1500;
  EXPECT_THAT([&] { Simulator(scenario, Scene{}, 1); },
              ThrowsMessage<Error>("sonars[0].ping_period = 0.05 s must be at least 0.0667 s, the time sound takes to "
                                   "max_range = 50 m and back"));
}

TEST(SimulatorPeriodTest, PingPeriodIsTheTimeSoundTakesWhenNoneIsGiven) {
  Scenario scenario = quiet_scenario(small_fan());
  scenario.water.sound_speed = 1600;
  const Simulator simulator(scenario, Scene{}, 1);
  EXPECT_DOUBLE_EQ(*simulator.sonar(0).ping_period, 2 * 16 / 1600.0);
}

TEST(SimulatorMotionTest, ObjectsMoveBetweenPings) {
  Scenario scenario = quiet_scenario(small_fan());
  scenario.sonars[0].ping_period = 1;
  scenario.motions = {{.object = "ball", .trajectory = {{{.time = 0}, {.time = 10, .position = {5, 0, 0}}}}}};
  const Scene scene = SceneMaker().add("ball", make_sphere(0.3), {.position = {5, 0, 0}}).scene();
  Simulator simulator(scenario, scene, 1);
  const auto nearest_range = [&](int number) {
    const Ping ping = simulator.make_ping(0, number);
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      for (int beam = 0; beam < ping.beam_count; ++beam) {
        if (ping.intensity[ping.index(bin, beam)] > 0) {
          return scenario.sonars[0].bin_range(bin);
        }
      }
    }
    return 0.0;
  };
  EXPECT_NEAR(nearest_range(0), 4.7, 0.1);
  EXPECT_NEAR(nearest_range(4), 6.7, 0.1);
  EXPECT_NEAR(nearest_range(0), 4.7, 0.1);
}

TEST(SimulatorMotionTest, NamesTheObjectsThereAreWhenOneIsMissing) {
  Scenario scenario = quiet_scenario(small_fan());
  scenario.motions = {{.object = "whale", .trajectory = {{{.time = 0}}}}};
  scenario.places["motions[0].object"] = {"s.yaml", 3, 5};
  EXPECT_THAT([&] { Simulator(scenario, busy_scene().scene(), 1); },
              ThrowsMessage<Error>(
                  "s.yaml:3:5: motions[0].object = whale is not in the world; there are box, floor, sphere2, wall"));
}

}  // namespace
}  // namespace insonify::simulator_test
