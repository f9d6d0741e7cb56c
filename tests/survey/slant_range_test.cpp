// slant_range_test.cpp -- ranges on a level bed, the integral of footprints, and gain against angle.

#include "insonify/survey/slant_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/message_of.h"
#include "survey/line.h"

namespace insonify::slant_range_test {
namespace {

// 3, 4, 5.
TEST(SlantRangeTest, IsPythagoras) {
  EXPECT_DOUBLE_EQ(ground_range(5, 3), 4);
  EXPECT_DOUBLE_EQ(ground_range(13, 5), 12);
  EXPECT_EQ(ground_range(2.9, 3), 0);
}

// A point at the ground range 12 m under an altitude of 5 m is at 13 m: in bin 260 of 5 cm, whose footprint reaches
// from 12 m to sqrt(13.05^2 - 25) = 12.0542 m. With cells of 10 cm all of it lies in cell 120.
TEST(SlantRangeTest, APointComesToItsPlaceOnTheBed) {
  const SonarConfig sonar = side_scan_sonar();
  Ping ping = dark_ping(sonar);
  ping.intensity[ping.index(260, 1)] = 1;
  const std::vector<float> ground = slant_to_ground(ping, sonar, 5, {0.1, 400});
  for (int cell = 0; cell < 390; ++cell) {
    const double share = cell == 120 ? (std::sqrt(13.05 * 13.05 - 25) - 12) / 0.1 : 0;
    EXPECT_NEAR(ground[2 * cell + 1], share, 1e-6) << cell;
    EXPECT_EQ(ground[2 * cell], 0) << cell;
  }
}

// Intensity I(r) on the bed: sum of cells x their length = sum of bins x their footprints, whatever the cells.
TEST(SlantRangeTest, TheIntegralOverTheBedIsKept) {
  const SonarConfig sonar = side_scan_sonar();
  std::mt19937 random(3);
  const Ping ping = bed_ping(sonar, 7.3, 30, random);
  double bins = 0;
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    bins += ping.intensity[ping.index(bin, 0)] * (ground_range(0.05 * (bin + 1), 7.3) - ground_range(0.05 * bin, 7.3));
  }
  const double end = ground_range(40, 7.3);
  for (const int count : {50, 333, 2000}) {
    const double cell = end / count;
    const std::vector<float> ground = slant_to_ground(ping, sonar, 7.3, {cell, count});
    double cells = 0;
    for (int i = 0; i < count; ++i) {
      cells += ground[2 * i] * cell;
    }
    EXPECT_NEAR(cells, bins, 1e-5 * bins) << count;
  }
}

TEST(SlantRangeTest, ALevelBedOfEqualIntensityStaysEqual) {
  const SonarConfig sonar = side_scan_sonar();
  Ping ping = dark_ping(sonar);
  std::ranges::fill(ping.intensity, 0.7F);
  const GroundGrid grid = ground_grid_of(sonar);
  EXPECT_EQ(grid.count, 800);
  const std::vector<float> ground = slant_to_ground(ping, sonar, 10, grid);
  const double end = ground_range(40, 10);  // 38.73 m
  for (int cell = 0; cell < grid.count; ++cell) {
    if (cell * grid.cell < end) {
      EXPECT_NEAR(ground[2 * cell], 0.7, 1e-6) << cell;
    } else {
      EXPECT_TRUE(std::isnan(ground[2 * cell])) << cell;
    }
  }
}

// The plane of the beams is inclined: in it the bed is 5 / cos(30 deg) away. Bin 267, from 13.35 to 13.4 m, lies
// between sqrt(13.35^2 - 25 / 0.75) = 12.036 m and 12.092 m; without the pitch it would be at 12.38 m.
TEST(SlantRangeTest, PitchInclinesThePlane) {
  const SonarConfig sonar = side_scan_sonar();
  Ping ping = dark_ping(sonar);
  ping.world_from_sonar.orientation = orientation_from_rpy(0, radians_from_degrees(30), 1);
  ping.intensity[ping.index(267, 0)] = 1;
  const std::vector<float> ground = slant_to_ground(ping, sonar, 5, {0.2, 200});
  const auto brightest = std::ranges::max_element(ground) - ground.begin();
  EXPECT_EQ(brightest, 2 * 60);
}

TEST(SlantRangeTest, BadInputIsRefused) {
  const SonarConfig sonar = side_scan_sonar();
  const Ping ping = dark_ping(sonar);
  EXPECT_EQ(message_of([&] {
              (void)slant_to_ground(ping, sonar, 0, {0.1, 10});
            }),
            "altitude = 0 m must be greater than 0 m");
  EXPECT_EQ(message_of([&] {
              (void)slant_to_ground(ping, sonar, -2, {0.1, 10});
            }),
            "altitude = -2 m must be greater than 0 m");
  EXPECT_EQ(message_of([&] {
              (void)slant_to_ground(ping, sonar, std::nan(""), {0.1, 10});
            }),
            "altitude = nan m must be greater than 0 m");
  EXPECT_EQ(message_of([&] { (void)slant_to_ground(ping, sonar, 3, {0, 10}); }), "cell = 0 m must be greater than 0 m");
  EXPECT_EQ(message_of([&] { (void)ground_range(3, 0); }), "altitude = 0 m must be greater than 0 m");
  Ping down = ping;
  down.world_from_sonar.orientation = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), -Vec3::UnitZ());
  EXPECT_EQ(message_of([&] {
              (void)slant_to_ground(down, sonar, 3, {0.1, 10});
            }),
            "ping 0 of sss: the sonar points straight up or down");
}

// A bed whose intensity is sin^2 of the grazing angle, port twice starboard: after the gain both sides have one mean
// everywhere, and an object twice as bright as the bed stays so. Within a percent: sin^2 is not straight within classes
// of 1 degree.
TEST(AngleGainTest, TakesOutTheMeanOfEachAngle) {
  const SonarConfig sonar = side_scan_sonar();
  AngleGain gain(2);
  Ping ping = dark_ping(sonar);
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    const double sine = std::min(1.0, 10 / sonar.bin_range(bin));
    ping.intensity[ping.index(bin, 0)] = static_cast<float>(2 * sine * sine);
    ping.intensity[ping.index(bin, 1)] = static_cast<float>(sine * sine);
  }
  for (int i = 0; i < 99; ++i) {
    gain.add(ping, sonar, 10);
  }
  Ping object = ping;
  object.intensity[object.index(500, 0)] *= 2;
  const Ping shown = gain.applied(object, sonar, 10);
  const double mean = shown.intensity[shown.index(400, 1)];
  for (int bin = 205; bin < 785; ++bin) {  // Down to the middle of the last class.
    EXPECT_NEAR(shown.intensity[shown.index(bin, 1)], mean, 0.01 * mean) << bin;
    EXPECT_NEAR(shown.intensity[shown.index(bin, 0)], mean * (bin == 500 ? 2 : 1), 0.02 * mean) << bin;
  }
}

// An object 30 dB above the bed in a fifth of the pings, at 25 m: what lies at its angle in the others, and on the
// other side, is as bright as elsewhere. By the mean of all it would be 23 dB darker.
TEST(AngleGainTest, ABrightObjectLeavesNoStripe) {
  const SonarConfig sonar = side_scan_sonar();
  AngleGain gain(2);
  Ping bed = dark_ping(sonar);
  std::ranges::fill(bed.intensity, 1.0F);
  Ping object = bed;
  for (int bin = 480; bin < 520; ++bin) {
    object.intensity[object.index(bin, 0)] = 1000;
  }
  for (int i = 0; i < 100; ++i) {
    gain.add(i % 5 == 0 ? object : bed, sonar, 10);
  }
  const Ping shown = gain.applied(bed, sonar, 10);
  for (int bin = 205; bin < 785; ++bin) {
    EXPECT_NEAR(shown.intensity[shown.index(bin, 0)], 1, 1e-5) << bin;
    EXPECT_NEAR(shown.intensity[shown.index(bin, 1)], 1, 1e-5) << bin;
  }
}

}  // namespace
}  // namespace insonify::slant_range_test
