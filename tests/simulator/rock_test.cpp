// rock_test.cpp -- pings as samples of Rock, with a look-alike of base::samples::Sonar.

#include "insonify/rock.h"

#include <gmock/gmock.h>

#include <numbers>

#include "insonify/files.h"
#include "insonify/scenario.h"
#include "insonify/simulator.h"
#include "support/message_of.h"

// The members that Rock's classes have, by their names there.
namespace base {

struct Time {
  std::int64_t microseconds = 0;
  static Time fromMicroseconds(std::int64_t value) { return {value}; }
};

struct Angle {
  double rad = 0;
  static Angle fromRad(double value) { return {std::remainder(value, 2 * std::numbers::pi)}; }
};

namespace samples {

struct Sonar {
  Time time;
  std::vector<Time> timestamps;
  Time bin_duration;
  Angle beam_width, beam_height;
  std::vector<Angle> bearings;
  float speed_of_sound = 0;
  std::uint32_t bin_count = 0, beam_count = 0;
  std::vector<float> bins;

  [[nodiscard]] float getBinStartDistance(unsigned int bin) const {
    return static_cast<float>(1e-6 * static_cast<double>(bin_duration.microseconds)) * speed_of_sound * bin;
  }
};

}  // namespace samples
}  // namespace base

namespace insonify::rock_test {
namespace {

using Sample = base::samples::Sonar;

SonarConfig small_sonar() {
  SonarConfig sonar;
  sonar.beam_count = 5;
  sonar.azimuth_aperture = radians_from_degrees(50);
  sonar.bin_count = 400;
  sonar.min_range = 0.7;
  sonar.max_range = 40.7;
  sonar.assumed_sound_speed = 1500;
  return sonar;
}

Ping empty_ping(const SonarConfig& sonar) {
  Ping ping;
  ping.beam_count = sonar.beam_count;
  ping.bin_count = sonar.bin_count;
  ping.intensity.assign(static_cast<std::size_t>(sonar.beam_count * sonar.bin_count), 0.0F);
  return ping;
}

TEST(RockTest, RangesDoNotDriftWithWholeMicroseconds) {
  const SonarConfig sonar = small_sonar();
  const auto sample = to_rock<Sample>(empty_ping(sonar), sonar, {.high_db = 1});
  EXPECT_EQ(sample.bin_duration.microseconds, 67);  // 66.7 us.
  EXPECT_NEAR(sample.speed_of_sound, 1492.537, 1e-3);
  EXPECT_EQ(sample.bin_count, 407U);
  for (const int bin : {0, 1, 399}) {
    EXPECT_NEAR(sample.getBinStartDistance(static_cast<unsigned>(bin) + 7), 0.7 + 0.1 * bin, 1e-4);
  }
  EXPECT_NEAR(rock_bins(sonar).range_error, 0, 1e-12);
}

TEST(RockTest, AWindowThatBeginsWithinABinIsOffByLessThanHalfOfIt) {
  SonarConfig sonar = small_sonar();
  sonar.min_range = 0.73;
  const RockBins bins = rock_bins(sonar);
  EXPECT_NEAR(bins.range_error, bins.leading * sonar.bin_length() - 0.73, 1e-12);
  EXPECT_LE(std::abs(bins.range_error), sonar.bin_length() / 2);
}

TEST(RockTest, BinsOfLessThanAMicrosecondKeepTheirLength) {
  SonarConfig sonar = small_sonar();
  sonar.min_range = 0;
  sonar.max_range = 0.2;
  const RockBins bins = rock_bins(sonar);
  EXPECT_EQ(bins.duration_us, 1);
  EXPECT_NEAR(1e-6 * static_cast<double>(bins.duration_us) * bins.sound_speed, 0.0005, 1e-12);
}

class RockMirrorTest : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Mirrored, RockMirrorTest, testing::Bool());

TEST_P(RockMirrorTest, BeamsRunFromStarboardToPortUnlessMirrored) {
  const SonarConfig sonar = small_sonar();
  Ping ping = empty_ping(sonar);
  ping.time = 3.25;
  ping.head_angle = radians_from_degrees(7);
  ping.intensity[ping.index(120, 0)] = 0.25F;  // Far to port.
  const auto sample =
      to_rock<Sample>(ping, sonar, {.decibels = false, .high_db = 1}, {.epoch_us = 1000, .mirrored = GetParam()});
  EXPECT_EQ(sample.time.microseconds, 3'251'000);
  EXPECT_TRUE(sample.timestamps.empty());
  ASSERT_EQ(sample.bearings.size(), 5U);
  EXPECT_NEAR(sample.bearings.front().rad, radians_from_degrees(GetParam() ? -27 : -13), 1e-12);
  EXPECT_NEAR(sample.bearings.back().rad, radians_from_degrees(GetParam() ? 13 : 27), 1e-12);
  EXPECT_NEAR(sample.beam_width.rad, radians_from_degrees(10), 1e-12);
  EXPECT_NEAR(sample.beam_height.rad, radians_from_degrees(20), 1e-12);
  ASSERT_EQ(sample.bins.size(), 5U * 407U);
  const std::size_t beam = GetParam() ? 0 : 4;
  EXPECT_EQ(sample.bins[beam * 407 + 7 + 120], 0.25F);
  EXPECT_EQ(std::ranges::count(sample.bins, 0.0F), std::ssize(sample.bins) - 1);
}

TEST(RockTest, WidthsMayBeThoseOfTheFan) {
  const SonarConfig sonar = small_sonar();
  const auto sample = to_rock<Sample>(empty_ping(sonar), sonar, {.high_db = 1}, {.fan_width = true});
  EXPECT_NEAR(sample.beam_width.rad, radians_from_degrees(50), 1e-12);
}

TEST(RockTest, ValuesAreThoseOfImages) {
  const Scenario scenario = parse_scenario(R"(points: [{position: [9, 2, 0], target_strength_db: -20}]
sonars: [{beam_count: 24, bin_count: 90, max_range: 12, azimuth_aperture_deg: 70, elevation_aperture_deg: 25}])");
  Simulator simulator(scenario, {}, 1);
  const Ping ping = simulator.make_ping(0, 0);
  SonarMessages messages(message_source(scenario, simulator.sonar(0)));
  messages.take(ping);
  const std::vector<std::byte> image = messages.encode(0);
  const auto sample = to_rock<Sample>(ping, simulator.sonar(0), messages.levels());
  // The image's values, 16 bits each, end the message: range-major, port first.
  const std::size_t cells = ping.intensity.size();
  const int leading = rock_bins(simulator.sonar(0)).leading;
  double brightest = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::size_t at = image.size() - 2 * cells + 2 * cell;
    const double expected = (std::to_integer<int>(image[at]) + 256 * std::to_integer<int>(image[at + 1])) / 65535.0;
    const std::size_t bin = cell / 24, beam = cell % 24;
    ASSERT_NEAR(sample.bins[(23 - beam) * sample.bin_count + static_cast<std::size_t>(leading) + bin], expected, 1.1e-5)
        << cell;
    brightest = std::max(brightest, expected);
  }
  EXPECT_GT(brightest, 0.5);
}

TEST(RockTest, APingOfAnotherSonarIsRefused) {
  SonarConfig other = small_sonar();
  other.bin_count = 399;
  EXPECT_EQ(message_of([&] { (void)to_rock<Sample>(empty_ping(other), small_sonar(), {.high_db = 1}); }),
            "to_rock: the ping has not the sonar's beams and bins");
}

}  // namespace
}  // namespace insonify::rock_test
