// recorded_fans_test.cpp -- which pings of a file have a fan picture, and what that saves.

#include <gtest/gtest.h>

#include <filesystem>

#include "insonify/mcap_recording.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::recorded_fans_test {
namespace {

constexpr double kPeriod = 0.15;  // [s]

SonarConfig sonar_of(SonarType type) {
  SonarConfig sonar;
  sonar.name = "around";
  sonar.type = type;
  sonar.beam_count = 1;
  sonar.bin_count = 3;
  sonar.max_range = 9;
  sonar.head.step = 0.7;
  sonar.assumed_sound_speed = 1500;
  sonar.ping_period = kPeriod;
  return sonar;
}

Ping ping_of(const SonarConfig& sonar, std::uint64_t number) {
  Ping ping;
  ping.number = number;
  ping.time = static_cast<double>(number) * kPeriod;
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  ping.intensity = {1e-9F, 1e-8F, 1e-7F};
  return ping;
}

// Numbers of the pings, of twelve, after which each channel but the fan's is due, and those with a fan picture.
std::vector<std::uint64_t> pings_with_fans(SonarType type, const MessageOptions& options) {
  const SonarConfig sonar = sonar_of(type);
  SonarMessages messages({sonar, EchoModel::kCalibrated, {}, "pings: 1\n"}, options);
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t number = 0; number < 12; ++number) {
    messages.take(ping_of(sonar, number));
    for (std::size_t channel = 0; channel < messages.channels().size(); ++channel) {
      if (messages.channels()[channel].kind != MessageKind::kFan) {
        EXPECT_TRUE(messages.is_due(channel));
      } else if (messages.is_due(channel)) {
        numbers.push_back(number);
      }
    }
  }
  return numbers;
}

using Numbers = std::vector<std::uint64_t>;
const Numbers kAll = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};

TEST(RecordedFansTest, AScanningSonarHasTwoASecond) {
  // Times are 0, 0.15, 0.3, 0.45 | 0.6, 0.75, 0.9 | 1.05, 1.2, 1.35 | 1.5, 1.65.
  EXPECT_EQ(pings_with_fans(SonarType::kMechanicallyScanned, {}), (Numbers{0, 4, 7, 10}));
  EXPECT_EQ(pings_with_fans(SonarType::kForwardLooking, {}), kAll);
}

TEST(RecordedFansTest, TheRateIsThatOfTheOptionsForAllSonars) {
  // Intervals of 0.3 s begin at pings 0, 2, 4 ..., though 4 * 0.15 is not twice 0.3 exactly.
  const MessageOptions third{.fan_rate = 1 / 0.3};
  for (const SonarType type : {SonarType::kMechanicallyScanned, SonarType::kForwardLooking}) {
    EXPECT_EQ(pings_with_fans(type, third), (Numbers{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(pings_with_fans(type, {.fan_rate = 1000}), kAll);
    EXPECT_EQ(pings_with_fans(type, {.fan_rate = 0}), Numbers{});
  }
  EXPECT_EQ(message_of([] { pings_with_fans(SonarType::kForwardLooking, {.fan_rate = -1}); }),
            "messages.fan_rate = -1 1/s must be from 0 to 1000 1/s");
}

TEST(RecordedFansTest, TheForecastOfAFileFollowsTheRate) {
  const SonarConfig sonar = sonar_of(SonarType::kMechanicallyScanned);
  constexpr std::uint64_t kPings =
      200;  // 30 s, in which there are 60 pictures of 240 x 480 pixels at most, and one more.
  constexpr std::uint64_t kPicture = 3 * 240 * 480;
  const auto forecast = [&](std::optional<double> rate) {
    return mcap_bytes(sonar, kPings, {.fan_height = 240, .fan_rate = rate});
  };
  EXPECT_EQ(forecast(1000) - forecast(0), kPings * kPicture);
  EXPECT_EQ(forecast({}) - forecast(0), 61 * kPicture);
  EXPECT_EQ(forecast(5) - forecast(0), 151 * kPicture);
  EXPECT_EQ(mcap_bytes(sonar_of(SonarType::kForwardLooking), kPings, {.fan_height = 240}), forecast(1000));
  // Without a period, pings are as far apart as the sound needs in the slowest water: 18 m / 1400 m/s.
  SonarConfig unfilled = sonar;
  unfilled.ping_period.reset();
  unfilled.assumed_sound_speed.reset();
  EXPECT_EQ(mcap_bytes(unfilled, kPings, {.fan_height = 240}) -
                mcap_bytes(unfilled, kPings, {.fan_height = 240, .fan_rate = 0}),
            (6 + 1) * kPicture);
}

TEST(RecordedFansTest, AFileIsSmallerAndNotLargerThanItsForecast) {
  const WorkingFolder folder;
  const SonarConfig sonar = sonar_of(SonarType::kMechanicallyScanned);
  const auto recorded = [&](const char* path, std::optional<double> rate) {
    McapOptions options;
    options.messages.fan_height = 240;
    options.messages.fan_rate = rate;
    McapRecording out(path, {MessageSource{sonar, EchoModel::kCalibrated, {}, "pings: 1\n", {}}}, options);
    for (std::uint64_t number = 0; number < 40; ++number) {
      out.add(0, ping_of(sonar, number));
    }
    out.close();
    EXPECT_LE(std::filesystem::file_size(path), mcap_bytes(sonar, 40, options.messages)) << path;
    return std::filesystem::file_size(path);
  };
  const auto all = recorded("all.mcap", 1000), usual = recorded("usual.mcap", {}), none = recorded("none.mcap", 0);
  EXPECT_LT(usual, all);
  EXPECT_LT(none, usual);
}

}  // namespace
}  // namespace insonify::recorded_fans_test
