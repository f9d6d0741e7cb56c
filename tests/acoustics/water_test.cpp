// water_test.cpp -- sound speed and absorption of a Water, and its limits.

#include "insonify/water.h"

#include <gtest/gtest.h>

#include <cmath>

#include "insonify/acoustics/absorption.h"
#include "insonify/acoustics/sound_speed.h"
#include "support/message_of.h"

namespace insonify::water_test {
namespace {

TEST(WaterTest, SoundSpeedFollowsFromTemperatureSalinityAndDepth) {
  const Water tank{.temperature_c = 18, .salinity = 0, .ph = 7, .depth = 3};
  EXPECT_EQ(tank.true_sound_speed(), chen_millero_sound_speed(18, 0, 3));
}

TEST(WaterTest, AGivenSoundSpeedOverrulesTheRest) {
  const Water water{.temperature_c = 18, .sound_speed = 1473.5};
  EXPECT_EQ(water.true_sound_speed(), 1473.5);
}

TEST(WaterTest, AbsorptionIsAinslieAndMcColmsUntilSwitchedOff) {
  Water water{.temperature_c = 4, .salinity = 33, .ph = 7.9, .depth = 200};
  EXPECT_EQ(water.absorption_db_per_m_at(450e3), absorption_db_per_m(450e3, water));
  water.absorption = false;
  EXPECT_EQ(water.absorption_db_per_m_at(450e3), 0);
}

TEST(WaterTest, TheLimitsThemselvesAreAllowed) {
  EXPECT_NO_THROW((Water{.temperature_c = -6, .salinity = 0, .ph = 6.5, .depth = 0, .sound_speed = 1300}.validate()));
  EXPECT_NO_THROW(
      (Water{.temperature_c = 35, .salinity = 50, .ph = 8.5, .depth = 7000, .sound_speed = 1700}.validate()));
}

TEST(WaterTest, NamesTheFieldOutOfItsLimits) {
  const auto message = [](const Water& water) { return message_of([&] { water.validate(); }); };
  EXPECT_EQ(message({.temperature_c = -6.5}), "water.temperature_c = -6.5 degC must be from -6 to 35 degC");
  EXPECT_EQ(message({.temperature_c = NAN}), "water.temperature_c = nan degC must be from -6 to 35 degC");
  EXPECT_EQ(message({.salinity = 51}), "water.salinity = 51 PSU must be from 0 to 50 PSU");
  EXPECT_EQ(message({.ph = 9}), "water.ph = 9 pH must be from 6.5 to 8.5 pH");
  EXPECT_EQ(message({.depth = -1}), "water.depth = -1 m must be from 0 to 7000 m");
  EXPECT_EQ(message({.sound_speed = 340}), "water.sound_speed = 340 m/s must be from 1300 to 1700 m/s");
}

}  // namespace
}  // namespace insonify::water_test
