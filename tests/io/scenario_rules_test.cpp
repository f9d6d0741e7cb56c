// scenario_rules_test.cpp -- scenarios made in code are checked as files are.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "support/message_of.h"

namespace insonify::scenario_rules_test {
namespace {

TEST(ScenarioRulesTest, MessagesHaveNoPlaceWithoutAFile) {
  Scenario scenario;
  scenario.world = "wreck.sdf";
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "sonars must have at least one entry");
  scenario.sonars.resize(1);
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "no error");
  scenario.sonars[0].ping_period = 0.05;
  scenario.sonars[0].assumed_sound_speed = 1500;
  EXPECT_EQ(
      message_of([&] { scenario.validate(); }),
      "sonars[0].ping_period = 0.05 s must be at least 0.0667 s, the time sound takes to max_range = 50 m and back");
  scenario.sonars[0].ping_period = 0.0667;  // The limit in the message is allowed.
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "no error");
}

// Limits of the calibrated model do not apply to the paper model, whose fans may cover a full circle.
TEST(ScenarioRulesTest, ThePaperModelHasNoArray) {
  Scenario scenario;
  scenario.world = "wreck.sdf";
  scenario.sonars.resize(1);
  scenario.sonars[0].azimuth_aperture = radians_from_degrees(360);
  EXPECT_EQ(message_of([&] { scenario.validate(); }),
            "receiver.azimuth_pattern must be top_hat for fans of more than 180 deg; sonars[0] has 360");
  scenario.model = EchoModel::kPaper;
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "no error");
}

TEST(ScenarioRulesTest, TheSonarsOwnSoundSpeedRulesItsPeriod) {
  Scenario scenario;
  scenario.world = "wreck.sdf";
  scenario.water.sound_speed = 1400;
  scenario.sonars.resize(1);
  scenario.sonars[0].ping_period = 0.068;  // 100 m take 0.0714 s at 1400 m/s, 0.0667 s at 1500 m/s.
  EXPECT_EQ(
      message_of([&] { scenario.validate(); }),
      "sonars[0].ping_period = 0.068 s must be at least 0.0715 s, the time sound takes to max_range = 50 m and back");
  scenario.sonars[0].assumed_sound_speed = 1500;
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "no error");
}

}  // namespace
}  // namespace insonify::scenario_rules_test
