// sea_plane_test.cpp -- the sea surface follows the vehicle without any change in the pings.

#include "insonify/simulator.h"
#include "simulator/small_world.h"

namespace insonify::sea_plane_test {
namespace {

using namespace testing_scenes;

class SeaPlaneTest : public testing::TestWithParam<PingCase> {
 protected:
  // Three metres below a sea, looking up at it.
  static Scenario below_the_sea() {
    Scenario scenario = small_scenario(GetParam());
    scenario.surface = SeaSurface{.level = 0, .wind_speed = 5};
    scenario.sonars[0].orientation = {0, -20 * kDegree, 0};
    scenario.receiver.noise = false;
    scenario.receiver.speckle = false;
    return scenario;
  }
  static PingRequest at(double x, double y) { return {.world_from_vehicle = {.position = {x, y, -3}}}; }
};

// Those of other tests, and on a device.
std::vector<PingCase> ping_cases() {
  std::vector<PingCase> cases(std::begin(kPingCases), std::end(kPingCases));
  if (std::ranges::find(usable_engines(), "gpu") != usable_engines().end()) {
    cases.push_back({"gpuCalibrated", "gpu", EchoModel::kCalibrated, PrimaryEchoes::kRays});
  }
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Cases, SeaPlaneTest, testing::ValuesIn(ping_cases()), kPingCaseName);

TEST_P(SeaPlaneTest, IsHeardAlikeWhereverTheVehicleGoes) {
  Simulator simulator(below_the_sea(), {}, 2);
  const Ping here = simulator.ping(0, at(0, 0));
  EXPECT_GT(*std::ranges::max_element(here.intensity), 1e-9F);
  for (const double far : {10.0, 32.0, 70.0, 5e3, 2e5, -3e6}) {
    SCOPED_TRACE(far);
    const Ping there = simulator.ping(0, at(far, -0.7 * far));
    EXPECT_LT(apart(here, there), 1e-2);  // Rounding may send one of some hundred reflected rays by another facet.
    EXPECT_EQ(there.instance, here.instance);
    EXPECT_EQ(*std::ranges::min_element(there.instance), simulator.scene().find_instance("sea_surface"));
  }
}

TEST_P(SeaPlaneTest, PingsDoNotDependOnWhereTheVehicleWasBefore) {
  Scenario scenario = below_the_sea();
  scenario.receiver.noise = true;
  scenario.receiver.speckle = GetParam().model == EchoModel::kCalibrated;
  Simulator simulator(scenario, small_world(), 2);
  const Ping first = simulator.ping(0, at(0.3, 0));
  (void)simulator.ping(0, at(400, 90));
  expect_same(simulator.ping(0, at(0.3, 0)), first);
  (void)simulator.ping(0, at(-90, 400));
  Simulator other(scenario, small_world(), 1);
  (void)other.ping(0, at(7e4, 0));
  expect_same(other.ping(0, at(0.3, 0)), first);
}

// The plane moves when the vehicle crosses a line of its lattice, every 32 m; pings change there as little as
// elsewhere.
TEST_P(SeaPlaneTest, StepsUnheard) {
  Scenario scenario = below_the_sea();
  scenario.receiver.speckle = GetParam().model == EchoModel::kCalibrated;
  Simulator simulator(scenario, {}, 2);
  constexpr double kStep = 1e-4;
  const auto change = [&](std::initializer_list<double> places) {
    double sum = 0;
    for (const double x : places) {
      sum += apart(simulator.ping(0, at(x - kStep, 0)), simulator.ping(0, at(x + kStep, 0)));
    }
    return sum / static_cast<double>(places.size());
  };
  const double elsewhere = change({11, 17, 23.9, 27.1, 36}), across = change({-32, 32, 64, 96, 128});
  EXPECT_LT(across, 2 * elsewhere + 1e-4);
}

// With wind, the surface loss is larger at high frequencies.
TEST(SeaPlaneFrequencyTest, EverySonarMeetsTheSurfaceAtItsOwnFrequency) {
  Scenario both = small_scenario(kPingCases[3]);
  both.surface = SeaSurface{.level = 2, .wind_speed = 6};
  both.sonars.push_back(small_sonar());
  both.sonars[1].name = "low";
  both.sonars[1].frequency = 100e3;
  Simulator simulator(both, small_world(), 2);
  for (int i = 0; i < 2; ++i) {
    Scenario alone = both;
    alone.sonars = {both.sonars[i]};
    expect_same(simulator.ping(i, {}), Simulator(alone, small_world(), 2).ping(0, {}));
  }
}

// A point at (6, 0, -4), and its image in the surface at (6, 0, 4).
TEST(SeaPlaneGhostTest, PointsHaveTheirGhostsFarAway) {
  Scenario scenario = small_scenario(kPingCases[3]);
  scenario.surface = SeaSurface{.level = 0};
  scenario.receiver.noise = false;
  scenario.sonars[0].elevation_aperture = 120 * kDegree;
  scenario.sonars[0].bin_count = 640;
  constexpr double kEast = 3e4;
  scenario.points = {{.position = {kEast + 6, 0, -4}, .target_strength_db = -10}};
  Simulator simulator(scenario, {}, 1);
  const Ping ping = simulator.ping(0, {.world_from_vehicle = {.position = {kEast, 0, -3}}});
  const SonarConfig& sonar = simulator.sonar(0);
  const double straight = std::hypot(6, 1), by_surface = std::hypot(6, 7);
  for (const double range : {straight, 0.5 * (straight + by_surface), by_surface}) {
    const int bin = static_cast<int>((range - sonar.min_range) / sonar.bin_length());
    double heard = 0;
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      heard += ping.intensity[ping.index(bin, beam)];
    }
    EXPECT_GT(heard, 1e-7) << range;
  }
}

TEST(SeaPlaneErrorTest, SonarsMustBeBelowIt) {
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.surface = SeaSurface{.level = 2};
  scenario.sonars[0].position = {0, 0, 0.5};
  Simulator simulator(scenario, small_world(), 1);
  const Ping before = simulator.ping(0, {});
  EXPECT_EQ(message_of([&] {
              (void)simulator.ping(0, {.number = 9, .world_from_vehicle = {.position = {0, 0, 1.5}}});
            }),
            "ping 9 of fls: the sonar is at a height of 2 m, must be below surface.level = 2 m");
  expect_same(simulator.ping(0, {}), before);
}

TEST(SeaPlaneErrorTest, ScenariosThatRiseAboveItAreRefused) {
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.surface = SeaSurface{.level = 2};
  scenario.trajectory.waypoints = {{.time = 0}, {.time = 3, .position = {0, 0, 5}}};
  EXPECT_EQ(message_of([&] { (void)ScenarioRequests(scenario); }),
            "surface.level = 2 m must be above the sonars; sonars[0] is at a height of 5 m at time 3 s");
}

TEST(SeaPlaneErrorTest, CannotBeMovedOrRemoved) {
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.surface = SeaSurface{.level = 2};
  Simulator simulator(scenario, small_world(), 1);
  EXPECT_EQ(message_of([&] { (void)simulator.ping(0, {.moved = {{.name = "sea_surface"}}}); }),
            "ping 0 of fls: moved[0].name = sea_surface is not movable; nothing is");
  EXPECT_EQ(message_of([&] { simulator.remove_object("sea_surface"); }),
            "sea_surface cannot be removed: it is the scenario's surface");
}

}  // namespace
}  // namespace insonify::sea_plane_test
