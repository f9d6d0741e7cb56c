// oculus_sonar_test.cpp -- frequency modes, what settings make of a sonar, and pixels by hand.

#include "insonify/wire/oculus_sonar.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

namespace insonify::oculus_sonar_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Optional;

Scenario scenario_with(const std::string& sonar) {
  return parse_scenario(
      "points: [{position: [3, 0, 0], target_strength_db: -20}]\nwater: {sound_speed: 1480}\nsonars: [" + sonar +
      "]\n");
}

OculusModes modes_of(const Scenario& scenario) {
  return oculus_modes(scenario, scenario.sonars[0]);
}

constexpr std::uint8_t kUsual = kOculusRangeInMetres | kOculusSimpleReturn | kOculus512Beams;

TEST(OculusSonarTest, APresetBringsBothItsModes) {
  for (const char* mode : {"low", "high"}) {
    const Scenario scenario =
        scenario_with(std::string("{name: a, preset: blueprint-oculus-m1200d, max_range: 7, mode: ") + mode +
                      ", position: [1, 2, 3], min_range: 0.3}");
    const OculusModes modes = modes_of(scenario);
    EXPECT_EQ(modes.part_number, 1042);
    ASSERT_TRUE(modes.high);
    EXPECT_EQ(modes.low.sonar.frequency, 1.2e6);
    EXPECT_EQ(modes.high->sonar.frequency, 2.1e6);
    EXPECT_EQ(modes.low.sonar.max_range, 40);  // The instrument's, not the scenario's.
    EXPECT_EQ(modes.high->sonar.max_range, 10);
    EXPECT_NEAR(degrees_from_radians(modes.high->sonar.azimuth_aperture), 60, 1e-9);
    EXPECT_NEAR(degrees_from_radians(modes.low.sonar.azimuth_aperture), 130, 1e-9);
    for (const SonarConfig& sonar : {modes.low.sonar, modes.high->sonar}) {
      EXPECT_EQ(sonar.name, "a");
      EXPECT_EQ(sonar.position, Vec3(1, 2, 3));
      EXPECT_EQ(sonar.min_range, 0.3);  // What the scenario changes holds in both.
    }
    EXPECT_EQ(modes.low.ping_period, std::nullopt);  // The preset's own belongs to one range.
  }
}

TEST(OculusSonarTest, OthersHaveOneModeOrAnotherSonarsAsWell) {
  const Scenario one = scenario_with("{preset: blueprint-oculus-m370s}");
  EXPECT_FALSE(modes_of(one).high);
  EXPECT_EQ(modes_of(one).part_number, 1041);
  EXPECT_EQ(modes_of(one).low.sonar.max_range, 200);
  const Scenario two =
      scenario_with("{name: a, max_range: 30, ping_period: 0.25}, {name: b, frequency: 2e6, max_range: 9}");
  EXPECT_FALSE(modes_of(two).high);
  EXPECT_EQ(modes_of(two).part_number, 0);
  EXPECT_THAT(modes_of(two).low.ping_period, Optional(0.25));
  const OculusModes pair = oculus_modes(two, two.sonars[0], &two.sonars[1]);
  ASSERT_TRUE(pair.high);
  EXPECT_EQ(pair.high->sonar.frequency, 2e6);
  EXPECT_EQ(pair.high->sonar.max_range, 9);
  EXPECT_EQ(pair.high->sonar.name, "a");  // It takes the place of the other.
}

TEST(OculusSonarTest, RowsBeginAtTheSonarAndThoseTooNearAreBlank) {
  const Scenario scenario = scenario_with("{min_range: 0.31, max_range: 12, bin_count: 200, beam_count: 512}");
  const OculusMode mode = modes_of(scenario).low;
  const OculusPlan plan = oculus_plan(mode, scenario, {.flags = kUsual, .range = 8, .gain = 50, .sound_speed = 1520});
  EXPECT_EQ(plan.rows, 200);
  EXPECT_DOUBLE_EQ(plan.row_length, 0.04);
  EXPECT_EQ(plan.blank_rows, 8);  // To 0.32 m.
  ASSERT_TRUE(plan.sonar);
  EXPECT_DOUBLE_EQ(plan.sonar->min_range, 0.32);
  EXPECT_EQ(plan.sonar->max_range, 8);
  EXPECT_EQ(plan.sonar->bin_count, 192);
  EXPECT_EQ(plan.sonar->beam_count, 512);
  EXPECT_THAT(plan.sonar->assumed_sound_speed, Optional(1520));
  EXPECT_DOUBLE_EQ(plan.period, 0.1);
  EXPECT_EQ(plan.gain_db, 0);

  // Nothing but blank rows.
  EXPECT_FALSE(oculus_plan(mode, scenario, {.flags = kUsual, .range = 0.2}).sonar);
  // 256 beams without the flag, of sonars that have more.
  EXPECT_EQ(oculus_plan(mode, scenario, {.flags = 0x09, .range = 8}).sonar->beam_count, 256);
  // 25 % of 12 m.
  EXPECT_DOUBLE_EQ(oculus_plan(mode, scenario, {.flags = 0x08, .range = 25}).range, 3);
}

TEST(OculusSonarTest, ARangeTooLongIsLimitedAndToldSo) {
  const Scenario scenario = scenario_with("{max_range: 12}");
  const OculusPlan plan = oculus_plan(modes_of(scenario).low, scenario, {.flags = kUsual, .range = 55});
  EXPECT_EQ(plan.range, 12);
  EXPECT_EQ(plan.fire.range, 12);
}

TEST(OculusSonarTest, TheHighModeHasGainsFrom40To100Percent) {
  const Scenario scenario = scenario_with("{max_range: 12}");
  const OculusPlan plan =
      oculus_plan(modes_of(scenario).low, scenario, {.mode = 2, .flags = kUsual, .range = 5, .gain = 75});
  EXPECT_EQ(plan.fire.gain, 85);
  EXPECT_NEAR(plan.gain_db, 7, 1e-12);  // 35 of 50 percent of 10 dB.
}

TEST(OculusSonarTest, ThePeriodIsTheLongestOfThree) {
  const Scenario scenario = scenario_with("{max_range: 120, ping_period: 0.4}");
  const OculusMode mode = modes_of(scenario).low;
  const auto period = [&](std::uint8_t rate, double range) {
    return oculus_plan(mode, scenario, {.ping_rate = rate, .flags = kUsual, .range = range, .sound_speed = 1500})
        .period;
  };
  EXPECT_DOUBLE_EQ(period(kOculus40Hz, 10), 0.4);  // The scenario's.
  EXPECT_DOUBLE_EQ(period(kOculus2Hz, 10), 0.5);
  EXPECT_EQ(period(kOculusStandby, 10), 0);
  const Scenario fast = scenario_with("{max_range: 120}");
  // 2 x 120 m / 1500 m/s.
  EXPECT_DOUBLE_EQ(oculus_plan(modes_of(fast).low, fast,
                               {.ping_rate = kOculus40Hz, .flags = kUsual, .range = 120, .sound_speed = 1500})
                       .period,
                   0.16);
}

TEST(OculusSonarTest, SalinityChangesTheAssumedSoundSpeedByItsEffect) {
  const Scenario scenario = scenario_with("{max_range: 12}");  // 10 degC, 35 PSU, and 1480 m/s as given.
  const OculusMode mode = modes_of(scenario).low;
  const auto speed = [&](double salinity) {
    return *oculus_plan(mode, scenario, {.flags = kUsual, .range = 5, .salinity = salinity}).sonar->assumed_sound_speed;
  };
  EXPECT_EQ(speed(0), 1480);  // Not told.
  EXPECT_DOUBLE_EQ(speed(35), 1480);
  // About 1.2 m/s per PSU at 10 degC (Mackenzie 1981: 1.34 - 0.01 x 10 at 35 PSU).
  EXPECT_THAT(speed(30), DoubleNear(1480 - 5 * 1.22, 0.3));
}

TEST(OculusSonarTest, BearingsRiseFromPortToStarboard) {
  const Scenario scenario = scenario_with("{max_range: 12, beam_count: 3, azimuth_aperture_deg: 91}");
  // Centres at +-30.333 degrees.
  EXPECT_THAT(oculus_bearings(scenario.sonars[0]), ElementsAre(-3033, 0, 3033));
}

// Two rows of two beams behind a blank one, each 2 m long; no gain over range, full amplitude at -20 dB: 0.01.
class OculusImageTest : public testing::Test {
 protected:
  OculusPlan plan_{.fire = {.gamma = 255, .flags = kOculusGainSent, .gain = 50},
                   .rows = 3,
                   .blank_rows = 1,
                   .row_length = 2,
                   .range = 6};
  MessageLevels levels_{.decibels = true, .low_db = -80, .high_db = -20};
  Ping ping_;

  void SetUp() override {
    ping_.bin_count = 2;
    ping_.beam_count = 2;
    ping_.intensity = {0.01F, 0.0025F, 1.0F, 0.0F};
  }
};

TEST_F(OculusImageTest, PixelsAreAmplitudesBehindTheirGain) {
  // 0.0025 is half of the amplitude of 0.01: 127.5, rounded up. A gain of 1 is 50.
  EXPECT_THAT(oculus_image(plan_, &ping_, levels_, 2), ElementsAre(50, 0, 0, 0, 0, 0,      //
                                                                   50, 0, 0, 0, 255, 128,  //
                                                                   50, 0, 0, 0, 255, 0));
  plan_.fire.flags = 0;
  EXPECT_THAT(oculus_image(plan_, nullptr, levels_, 2), ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST_F(OculusImageTest, WidePixelsHave16Bits) {
  plan_.fire.flags = kOculus16Bits;
  // 65535 / 2 = 0x7fff.8, rounded up.
  EXPECT_THAT(oculus_image(plan_, &ping_, levels_, 2), ElementsAre(0, 0, 0, 0, 0xff, 0xff, 0, 0x80, 0xff, 0xff, 0, 0));
}

TEST_F(OculusImageTest, TheExtendedFlagOfLayout2Asks32Bits) {
  plan_.fire.flags = kOculus16Bits;
  plan_.fire.extended_flags = 0x200;
  EXPECT_EQ(oculus_image(plan_, &ping_, levels_, 2).size(), 12U);  // Layout 1 has no such flags.
  plan_.fire.layout = 2;
  const std::vector<std::uint8_t> image = oculus_image(plan_, &ping_, levels_, 2);
  ASSERT_EQ(image.size(), 24U);
  std::uint32_t pixels[6];
  std::memcpy(pixels, image.data(), image.size());
  EXPECT_EQ(pixels[2], 0xffffff00U);  // The largest float below 2^32.
  constexpr double kRounding = 1024;  // Floats have 24 bits.
  EXPECT_NEAR(pixels[3], 2147483648.0, kRounding);
  EXPECT_EQ(pixels[5], 0U);
}

TEST_F(OculusImageTest, GammaIsAnExponent) {
  plan_.fire.flags = 0;
  plan_.fire.gamma = 51;  // 51 / 255 = 0.2: 255 x 0.5^0.2 = 222.0
  EXPECT_EQ(oculus_image(plan_, &ping_, levels_, 2).at(3), 222);
  plan_.fire.gamma = 0;  // Stands for 255.
  EXPECT_EQ(oculus_image(plan_, &ping_, levels_, 2).at(3), 128);
}

TEST_F(OculusImageTest, GainOverRangeAndGainAct) {
  levels_.gain_per_decade = 20;  // Amplitude times range: 1, 3 and 5 m in the middles of rows.
  plan_.gain_db = -10 * std::log10(25.0);
  const std::vector<std::uint8_t> image = oculus_image(plan_, &ping_, levels_, 2);
  EXPECT_EQ(image.at(0), 2);         // 50 x 1 / 25.
  EXPECT_EQ(image.at(6), 18);        // 50 x 9 / 25.
  EXPECT_EQ(image.at(12), 50);       // 50 x 25 / 25.
  EXPECT_EQ(image.at(6 + 4), 153);   // 255 x 3 / 5.
  EXPECT_EQ(image.at(6 + 5), 77);    // Half of that: 76.5.
  EXPECT_EQ(image.at(12 + 4), 255);  // As loud as can be.
}

TEST_F(OculusImageTest, GainAssistBringsTheBrightestToHalf) {
  plan_.fire.flags = kOculusGainAssist;
  ping_.bin_count = 2;
  ping_.beam_count = 100;
  ping_.intensity.assign(200, 0.01F / 400);  // A twentieth of the full amplitude: times 10, which are 20 dB.
  EXPECT_EQ(oculus_image(plan_, &ping_, levels_, 100).at(150), 128);
  ping_.intensity.assign(200, 0.01F / 40000);                        // Beyond what it can do.
  EXPECT_EQ(oculus_image(plan_, &ping_, levels_, 100).at(150), 13);  // 255 / 200 x 10.
  ping_.intensity.assign(200, 0.0F);
  EXPECT_EQ(oculus_image(plan_, &ping_, levels_, 100).at(150), 0);
}

TEST_F(OculusImageTest, InThePapersModelIntensityIsAmplitude) {
  levels_ = {.decibels = false, .low_db = 0, .high_db = 0};
  ping_.intensity = {0.5F, 0.2F, 1.5F, 0.0F};
  plan_.fire.flags = 0;
  EXPECT_THAT(oculus_image(plan_, &ping_, levels_, 2), ElementsAre(0, 0, 128, 51, 255, 0));
}

}  // namespace
}  // namespace insonify::oculus_sonar_test
