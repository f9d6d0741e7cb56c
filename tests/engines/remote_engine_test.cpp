// remote_engine_test.cpp -- batches on an engine whose memory is elsewhere: its calls do not grow with pings or
// sources.

#include "engines/remote_engine.h"

#include "simulator/small_world.h"

namespace insonify::remote_engine_test {
namespace {

using namespace testing_scenes;

constexpr PingCase kRemote{"remote", "remote", EchoModel::kCalibrated, PrimaryEchoes::kRaster};
constexpr PingCase kCpu{"cpu", "cpu", EchoModel::kCalibrated, PrimaryEchoes::kRaster};

// Two sonars with points, interferers, thrusters and each other's pulses.
Scenario many_sources(const PingCase& on) {
  Scenario scenario = small_scenario(on);
  SonarConfig second = small_sonar();
  second.name = "second";
  second.position = {0, 0.5, 0};
  second.bin_count = 80;
  scenario.sonars.push_back(second);
  scenario.mutual_interference = true;
  scenario.points = {{.position = {6, 1, -0.5}, .target_strength_db = -20}, {.position = {8, -1, -0.2}}};
  scenario.interferers = {{.position = {20, 4, 0}, .source_level_db = 190, .period = 0.11}};
  scenario.thrusters = {{.position = {0.6, 0.3, 0}}};
  return scenario;
}

// Pings of both sonars in turn, from different places, the ball elsewhere in each.
struct Orders {
  Orders() {
    for (int i = 0; i < static_cast<int>(RemoteBatch::kMostViews); ++i) {
      requests[i].number = 3 + static_cast<std::uint64_t>(i);
      requests[i].world_from_vehicle.position = {0.1 * i, 0, 0.05 * i};
      requests[i].moved = {{.name = "ball", .world_from_object = {.position = {6, 0.2 * i, -1}}}};
      orders.push_back({i % 2, &requests[i], &pings[i]});
    }
  }
  std::vector<PingRequest> requests{RemoteBatch::kMostViews};
  std::vector<Ping> pings{RemoteBatch::kMostViews};
  std::vector<PingOrder> orders;
};

TEST(RemoteEngineTest, PingsAreThoseOfTheEngineOnTheHost) {
  const std::vector<MovableObject> movable = {{"ball"}};
  Simulator remote(many_sources(kRemote), small_world(), 2, movable),
      host(many_sources(kCpu), small_world(), 2, movable);
  Orders made, expected;
  remote.ping(made.orders);
  host.ping(expected.orders);
  for (std::size_t i = 0; i < made.pings.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(made.pings[i], expected.pings[i]);
  }
}

// First the probes by which the engine chooses its sampling, which are its own; then a round for each step of the
// slowest source, edges after the glints of faces.
TEST(RemoteEngineTest, OneCallTracesTheRaysOfAllSourcesOfAllPings) {
  const std::vector<MovableObject> movable = {{"ball"}};
  Simulator simulator(many_sources(kRemote), small_world(), 2, movable);
  auto& engine = dynamic_cast<RemoteEngine&>(simulator.engine());
  Orders all;
  const int before = engine.calls;
  simulator.ping(all.orders);
  EXPECT_EQ(engine.batches, 1);
  EXPECT_GE(engine.calls - before, 1);
  EXPECT_LE(engine.calls - before, 3);
}

// Walks of all pings bounce together: no more calls than the longest of them needs.
TEST(RemoteEngineTest, WalksOfAllPingsAdvanceTogether) {
  Scenario scenario = small_scenario(kRemote);
  scenario.random_walks = 200;
  Simulator simulator(scenario, small_world(), 2);
  auto& engine = dynamic_cast<RemoteEngine&>(simulator.engine());
  engine.has_walks = true;
  std::vector<PingRequest> requests(RemoteBatch::kMostViews);
  std::vector<Ping> pings(requests.size());
  int longest = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    requests[i].number = i;
    const int before = engine.calls;
    (void)simulator.ping(0, requests[i]);
    longest = std::max(longest, engine.calls - before);
  }
  const int before = engine.calls;
  simulator.ping(0, requests, pings);
  EXPECT_EQ(engine.calls - before, longest);
}

}  // namespace
}  // namespace insonify::remote_engine_test
