// ping_count_test.cpp -- number of pings given by `pings`, `duration` and `turns`.

#include <gmock/gmock.h>

#include "insonify/error.h"
#include "insonify/scenario_requests.h"

namespace insonify::ping_count_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

SonarConfig fan(double period) {
  SonarConfig sonar;
  sonar.name = "fan";
  sonar.ping_period = period;
  return sonar;
}

SonarConfig head(double step, double sector, double period) {
  SonarConfig sonar;
  sonar.name = "head";
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 3 * kDegree;
  sonar.head.step = step * kDegree;
  sonar.head.sector_width = sector * kDegree;
  sonar.ping_period = period;
  return sonar;
}

TEST(PingCountTest, DurationCountsThePingsThatStartBeforeItsEnd) {
  Scenario scenario;
  scenario.sonars = {fan(0.1), fan(0.25), fan(7)};
  scenario.duration = 2;
  const ScenarioRequests requests(scenario);
  EXPECT_EQ(requests.ping_count(0), 20U);
  EXPECT_EQ(requests.ping_count(1), 8U);
  EXPECT_EQ(requests.ping_count(2), 1U);
  EXPECT_EQ(requests.most_pings(), 20U);
  EXPECT_EQ(requests.total_pings(), 29U);
  EXPECT_LT(requests.at(0, 19).time, 2);
}

TEST(PingCountTest, ATurnIsOnceRoundOrOneSweepOfTheSector) {
  EXPECT_EQ(fan(1).pings_per_turn(), 1U);
  EXPECT_EQ(head(0.9, 360, 1).pings_per_turn(), 400U);
  EXPECT_EQ(head(-0.9, 360, 1).pings_per_turn(), 400U);
  EXPECT_EQ(head(7, 360, 1).pings_per_turn(), 52U);
  EXPECT_EQ(head(2, 90, 1).pings_per_turn(), 46U);
  EXPECT_EQ(head(4, 90, 1).pings_per_turn(), 23U);
}

TEST(PingCountTest, OtherSonarsPingAsLongAsTheSlowestHeadTurns) {
  Scenario scenario;
  scenario.sonars = {head(2, 90, 0.1), fan(0.25), head(90, 360, 0.5)};
  scenario.turns = 1.5;
  const ScenarioRequests requests(scenario);
  EXPECT_EQ(requests.ping_count(0), 69U);
  EXPECT_EQ(requests.ping_count(1), 28U);  // 6.9 s.
  EXPECT_EQ(requests.ping_count(2), 6U);
}

std::string complaint_about(const Scenario& scenario) {
  try {
    scenario.validate();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PingCountTest, OnlyOneSettingSaysWhenPingsEnd) {
  Scenario scenario;
  scenario.world = "world.sdf";
  scenario.sonars = {head(2, 90, 0.1)};
  scenario.duration = 2;
  EXPECT_EQ(complaint_about(scenario), "");
  scenario.turns = 2;
  EXPECT_EQ(complaint_about(scenario), "duration and turns both say when pings end; leave one out");
  scenario.duration.reset();
  scenario.pings = 7;
  EXPECT_EQ(complaint_about(scenario), "turns says when pings end, as pings = 7 does; leave one out");
  scenario.pings = 1;
  EXPECT_EQ(complaint_about(scenario), "");
  scenario.sonars = {fan(1)};
  EXPECT_EQ(complaint_about(scenario),
            "turns needs a scanning sonar (type: msis), and there is none; duration or pings takes any");
}

}  // namespace
}  // namespace insonify::ping_count_test
