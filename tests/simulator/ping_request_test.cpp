// ping_request_test.cpp -- pings from requests with given poses.

#include "insonify/ping_request.h"

#include <limits>

#include "insonify/simulator.h"
#include "simulator/small_world.h"

namespace insonify::ping_request_test {
namespace {

using namespace testing_scenes;

class PingRequestTest : public testing::TestWithParam<PingCase> {};
INSTANTIATE_TEST_SUITE_P(Cases, PingRequestTest, testing::ValuesIn(kPingCases), kPingCaseName);

const Vec3 kRpy(0.05, 0.1, -0.4);
const Pose kSomewhere{{0.7, -0.3, 0.2}, orientation_from_rpy(0.05, 0.1, -0.4)};

TEST_P(PingRequestTest, PoseFromOutsideGivesThePingOfATrajectoryThere) {
  Scenario scenario = small_scenario(GetParam());
  scenario.sonars[0].position = {0.3, 0, 0.1};
  Simulator simulator(scenario, small_world(), 2);
  const Ping ping = simulator.ping(0, {.number = 5, .time = 2.5, .world_from_vehicle = kSomewhere});
  EXPECT_EQ(ping.number, 5U);
  EXPECT_EQ(ping.time, 2.5);
  EXPECT_LT((ping.world_from_sonar.position - kSomewhere * Vec3(0.3, 0, 0.1)).norm(), 1e-12);
  scenario.trajectory.waypoints = {{.position = kSomewhere.position, .orientation = kRpy}};
  const Ping expected = Simulator(scenario, small_world(), 2).make_ping(0, 5);
  expect_same(ping, expected);
  EXPECT_GT(*std::ranges::max_element(ping.intensity), 1e-6F);
}

TEST_P(PingRequestTest, PingsDoNotDependOnThoseBefore) {
  Simulator simulator(small_scenario(GetParam()), small_world(), 2);
  const Ping first = simulator.ping(0, {.number = 3});
  expect_same(simulator.ping(0, {.number = 3}), first);
  const Ping there = simulator.ping(0, {.number = 3, .world_from_vehicle = kSomewhere});
  EXPECT_NE(there.intensity, first.intensity);
  EXPECT_NE(simulator.ping(0, {.number = 4}).intensity, first.intensity) << "noise is drawn by the number";
  expect_same(simulator.ping(0, {.number = 3}), first);
}

TEST_P(PingRequestTest, ManyAtOnceAreThoseOneByOne) {
  Simulator simulator(small_scenario(GetParam()), small_world(), 2, std::vector<MovableObject>{{"ball"}});
  std::vector<PingRequest> requests(3);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    requests[i].number = i;
    requests[i].world_from_vehicle.position.y() = 0.2 * static_cast<double>(i);
    requests[i].moved = {{.name = "ball", .world_from_object = {.position = {4.0 + static_cast<double>(i), 0, -1}}}};
  }
  std::vector<Ping> pings(3);
  simulator.ping(0, requests, pings);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    expect_same(pings[i], simulator.ping(0, requests[i]));
  }
}

// Each sonar of a vehicle pings from its own mounting pose, as it would alone.
TEST_P(PingRequestTest, EverySonarOfAVehicleHearsFromItsMounting) {
  Scenario both = small_scenario(GetParam());
  both.sonars.push_back(small_sonar());
  both.sonars[1].name = "stern";
  both.sonars[1].position = {0.5, -0.2, 0.4};
  both.sonars[1].orientation = {0, 0.2, 0.3};
  both.sonars[1].bin_count = 120;
  Simulator simulator(both, small_world(), 2);
  const PingRequest request{.number = 2, .world_from_vehicle = kSomewhere};
  for (int i = 0; i < 2; ++i) {
    Scenario alone = both;
    alone.sonars = {both.sonars[i]};
    expect_same(simulator.ping(i, request), Simulator(alone, small_world(), 2).ping(0, request));
  }
}

// ---- Scanning heads -------------------------------------------------------------------------------------------------

SonarConfig scanning_sonar() {
  SonarConfig sonar = small_sonar();
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 3 * kDegree;
  sonar.head.step = 7 * kDegree;
  return sonar;
}

TEST_P(PingRequestTest, HeadTurnsByItsStepsUnlessTheRequestTurnsIt) {
  Scenario scenario = small_scenario(GetParam());
  scenario.sonars = {scanning_sonar()};
  Simulator simulator(scenario, small_world(), 2);
  const Ping stepped = simulator.ping(0, {.number = 3});
  EXPECT_NEAR(stepped.head_angle, 21 * kDegree, 1e-12);
  expect_same(simulator.ping(0, {.number = 3, .head_angle = stepped.head_angle}), stepped);
  const Ping aside = simulator.ping(0, {.number = 3, .head_angle = -15 * kDegree});
  EXPECT_EQ(aside.head_angle, -15 * kDegree);
  EXPECT_NE(aside.intensity, stepped.intensity);
  const Pose head = simulator.world_from_head(0, {.number = 3, .head_angle = -15 * kDegree});
  EXPECT_NEAR((head.orientation * Vec3::UnitX()).y(), -std::sin(15 * kDegree), 1e-12);
  const PingRequest late = ScenarioRequests(scenario).at(0, 9'000'000);
  EXPECT_NEAR(simulator.ping(0, late).head_angle, 63'000'000 * kDegree, 1e-6);
}

// ---- Requests of a scenario -----------------------------------------------------------------------------------------

TEST(ScenarioRequestsTest, FollowTheTrajectoriesAtTheSonarsPeriod) {
  Scenario scenario = quiet_scenario(scanning_sonar());
  scenario.pings = 40;
  scenario.sonars[0].ping_period = 0.5;
  scenario.trajectory.waypoints = {{.time = 0}, {.time = 10, .position = {5, 0, -1}, .orientation = {0, 0, 1}}};
  scenario.motions = {{.object = "ball", .trajectory = {{{.time = 0}, {.time = 10, .position = {0, 2, 0}}}}}};
  const ScenarioRequests requests(scenario);
  EXPECT_EQ(requests.ping_count(0), 40U);
  EXPECT_EQ(requests.sonar_count(), 1);
  const PingRequest request = requests.at(0, 4);
  EXPECT_EQ(request.number, 4U);
  EXPECT_EQ(request.time, 2);
  EXPECT_LT((request.world_from_vehicle.position - Vec3(1, 0, -0.2)).norm(), 1e-12);
  EXPECT_LT((request.twist.linear - Vec3(0.5, 0, -0.1)).norm(), 1e-12);
  EXPECT_LT((request.twist.angular - Vec3(0, 0, 0.1)).norm(), 1e-9);
  ASSERT_EQ(request.moved.size(), 1U);
  EXPECT_EQ(request.moved[0].name, "ball");
  EXPECT_LT((request.moved[0].world_from_object.position - Vec3(0, 0.4, 0)).norm(), 1e-12);
  EXPECT_NEAR(*request.head_angle, 28 * kDegree, 1e-12);
}

TEST(ScenarioRequestsTest, TellWhereEverythingIsAtAnotherTime) {
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.sonars[0].ping_period = 0.5;
  scenario.trajectory.waypoints = {{.time = 0}, {.time = 4, .position = {8, 0, 0}}, {.time = 5, .position = {8, 3, 0}}};
  scenario.motions = {{.object = "ball", .trajectory = {{{.time = 0}, {.time = 10, .position = {0, 10, 0}}}}}};
  const ScenarioRequests requests(scenario);
  const PingRequest usual = requests.at(0, 9), same = requests.at(0, 9, 4.5);
  EXPECT_EQ(same.time, usual.time);
  EXPECT_EQ(same.world_from_vehicle.position, usual.world_from_vehicle.position);
  EXPECT_EQ(same.twist.linear, usual.twist.linear);
  const PingRequest earlier = requests.at(0, 9, 1);
  EXPECT_EQ(earlier.number, 9U);
  EXPECT_EQ(earlier.world_from_vehicle.position, Vec3(2, 0, 0));
  EXPECT_LT((earlier.twist.linear - Vec3(2, 0, 0)).norm(), 1e-9);
  EXPECT_EQ(earlier.moved.at(0).world_from_object.position, Vec3(0, 1, 0));
  EXPECT_EQ(message_of([&] { (void)requests.at(0, 9, std::nan("")); }), "time = nan s must be from -1e+10 to 1e+10 s");
  EXPECT_EQ(message_of([&] { (void)requests.at(1, 9); }), "sonar = 1 must be from 0 to 0, the last");
  EXPECT_EQ(message_of([&] { (void)requests.ping_count(-1); }), "sonar = -1 must be from 0 to 0, the last");
}

// ---- Errors ---------------------------------------------------------------------------------------------------------

class WrongRequestTest : public testing::Test {
 protected:
  std::string message_of_ping(const PingRequest& request) {
    return message_of([&] { (void)simulator_.ping(0, request); });
  }
  Simulator simulator_{quiet_scenario(small_sonar()), small_world(), 1};
};

TEST_F(WrongRequestTest, NamesWhatIsNoNumberOrOutOfLimits) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of_ping({.number = 7, .time = kNan}), "ping 7 of fls: time = nan s must be from -1e+10 to 1e+10 s");
  EXPECT_EQ(message_of_ping({.world_from_vehicle = {.position = {0, 2e7, 0}}}),
            "ping 0 of fls: world_from_vehicle.position[1] = 20000000 m must be from -10000000 to 10000000 m");
  EXPECT_EQ(message_of_ping({.world_from_vehicle = {.orientation = Eigen::Quaterniond(2, 0, 0, 0)}}),
            "ping 0 of fls: world_from_vehicle.orientation must be a unit quaternion; the norm of this one is 2");
  EXPECT_EQ(message_of_ping({.world_from_vehicle = {.orientation = Eigen::Quaterniond(kNan, 0, 0, 0)}}),
            "ping 0 of fls: world_from_vehicle.orientation must be a unit quaternion; the norm of this one is nan");
  EXPECT_EQ(message_of_ping({.twist = {.linear = {0, 0, kNan}}}),
            "ping 0 of fls: twist.linear[2] = nan m/s must be a finite number");
}

// A faster turn cannot be told from a slower one the other way round. Without motion in a ping a turn has no effect,
// and jumps of a trajectory come to such rates.
TEST_F(WrongRequestTest, TurnsByMoreThanHalfATurnWhileItListens) {
  Scenario moving = quiet_scenario(small_sonar());
  moving.model = EchoModel::kCalibrated;
  moving.motion_in_ping = true;
  Simulator simulator(moving, small_world(), 1);
  const double time = 2 * 16 / *simulator.sonar(0).assumed_sound_speed;
  const auto turning = [&](double degrees) {
    return PingRequest{.twist = {.angular = {0, 0, degrees * kDegree / time}}};
  };
  EXPECT_EQ(
      message_of([&] { (void)simulator.ping(0, turning(181)); }),
      "ping 0 of fls: twist.angular turns the sonar by 181 deg while it listens; with motion_in_ping at most 180");
  EXPECT_EQ(message_of([&] { (void)simulator.ping(0, turning(-180)); }), "no error");
  EXPECT_EQ(message_of_ping(turning(1e6)), "no error");
}

TEST_F(WrongRequestTest, TurnsNoHeadThatIsNotThere) {
  EXPECT_EQ(message_of_ping({.head_angle = 1.5}),
            "ping 0 of fls: head_angle = 1.5 rad belongs to a scanning sonar; this one's type is fls");
}

TEST_F(WrongRequestTest, NeedsAsManyPingsAsRequests) {
  std::vector<Ping> pings(2);
  EXPECT_EQ(message_of([&] { simulator_.ping(0, std::vector<PingRequest>(3), pings); }),
            "3 requests must have as many pings to fill, not 2");
}

TEST_F(WrongRequestTest, LeavesTheSimulatorAsItWas) {
  const Ping before = simulator_.ping(0, {});
  EXPECT_NE(message_of_ping({.time = 1e11}), "no error");
  expect_same(simulator_.ping(0, {}), before);
}

}  // namespace
}  // namespace insonify::ping_request_test
