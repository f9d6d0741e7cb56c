// ping_batch_test.cpp -- pings made on several threads at once are the same as each made alone.

#include <atomic>

#include "insonify/simulator.h"
#include "simulator/small_world.h"

namespace insonify::ping_batch_test {
namespace {

using namespace testing_scenes;

class PingBatchTest : public testing::TestWithParam<PingCase> {};
INSTANTIATE_TEST_SUITE_P(Cases, PingBatchTest, testing::ValuesIn(kPingCases), kPingCaseName);

// The reference shares nothing between pings, and takes a minute for what comes here.
class ChangedBatchTest : public PingBatchTest {};
INSTANTIATE_TEST_SUITE_P(Cases, ChangedBatchTest,
                         testing::Values(kPingCases[0], kPingCases[1], kPingCases[3], kPingCases[4]), kPingCaseName);

constexpr int kThreads = 3, kPings = 14;

std::vector<PingRequest> requests_on_a_path() {
  std::vector<PingRequest> requests(kPings);
  for (int i = 0; i < kPings; ++i) {
    requests[i].number = 7 + static_cast<std::uint64_t>(i);
    requests[i].time = 0.31 * i;
    requests[i].world_from_vehicle = {{0.2 * i, -0.1 * i, 0.1}, orientation_from_rpy(0.02, 0.05, 0.03 * i)};
    requests[i].twist = {{0.5, 0.2, 0}, {0, 0, 0.1 * i}};
  }
  return requests;
}

Scenario full_scenario(const PingCase& on) {
  Scenario scenario = small_scenario(on);
  if (on.model == EchoModel::kCalibrated) {
    scenario.receiver.field = true;
    scenario.motion_in_ping = true;
    scenario.points = {{.position = {6, 1, -0.5}, .target_strength_db = -20}};
    scenario.interferers = {{.position = {20, 4, 0}, .source_level_db = 190, .period = 0.11}};
    scenario.thrusters = {{.position = {0.6, 0.3, 0}, .blade_rate = 60, .modulation = 0.7},
                          {.position = {0.2, -0.9, 0}}};
  }
  return scenario;
}

void expect_as_alone(Simulator& simulator, const std::vector<PingRequest>& requests) {
  std::vector<Ping> pings(requests.size());
  simulator.ping(0, requests, pings);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(pings[i], simulator.ping(0, requests[i]));
  }
}

TEST_P(PingBatchTest, GivesThePingsMadeAlone) {
  Simulator simulator(full_scenario(GetParam()), small_world(), kThreads);
  const std::vector<PingRequest> requests = requests_on_a_path();
  std::vector<Ping> pings(requests.size());
  simulator.ping(0, requests, pings);
  Simulator other(full_scenario(GetParam()), small_world(), 1);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(pings[i], other.ping(0, requests[i]));
  }
}

TEST_P(ChangedBatchTest, FollowsChangesOfSonarAndScene) {
  const std::vector<MovableObject> movable = {{"ball"}};
  Simulator simulator(full_scenario(GetParam()), small_world(), kThreads, movable);
  const PingRequest moved{.moved = {{.name = "ball", .world_from_object = {.position = {6, 1, -1}}}}};
  std::vector<PingRequest> requests = requests_on_a_path();
  expect_as_alone(simulator, requests);
  (void)simulator.ping(0, moved);  // What it moved is back for the batch.
  expect_as_alone(simulator, requests);
  SonarConfig sonar = simulator.scenario().sonars[0];
  sonar.max_range = 11;
  sonar.bin_count = 97;
  simulator.set_sonar(0, sonar);
  expect_as_alone(simulator, requests);
  Scene buoy = SceneMaker().add("buoy", make_sphere(0.3), {.position = {4, 0, -0.5}}, 0.4).scene();
  simulator.add_objects(buoy);
  expect_as_alone(simulator, requests);
  simulator.remove_object("box");
  expect_as_alone(simulator, requests);
  requests[9].moved = moved.moved;
  expect_as_alone(simulator, requests);
}

TEST_P(PingBatchTest, EndsAtTheFirstRequestThatMakesNoSense) {
  Simulator simulator(full_scenario(GetParam()), small_world(), kThreads);
  std::vector<PingRequest> requests = requests_on_a_path();
  requests[9].head_angle = 0.1;
  std::vector<Ping> pings(requests.size());
  EXPECT_EQ(message_of([&] { simulator.ping(0, requests, pings); }),
            "ping 16 of fls: head_angle = 0.1 rad belongs to a scanning sonar; this one's type is fls");
  for (int i = 0; i < 9; ++i) {
    expect_same(pings[i], simulator.ping(0, requests[i]));
  }
  EXPECT_TRUE(pings[10].intensity.empty());
}

TEST_P(PingBatchTest, CanBeStopped) {
  Simulator simulator(full_scenario(GetParam()), small_world(), kThreads);
  const std::vector<PingRequest> requests = requests_on_a_path();
  std::vector<Ping> pings(requests.size());
  simulator.ping(0, requests, pings);
  const std::atomic<bool> stop = true;
  simulator.stop_when(&stop);
  EXPECT_THROW(simulator.ping(0, requests, pings), Interrupted);
  simulator.stop_when(nullptr);
  expect_as_alone(simulator, requests);
}

}  // namespace
}  // namespace insonify::ping_batch_test
