// mosaic_test.cpp -- points, footprints and lines on a chart, at places worked out by hand.

#include "insonify/survey/mosaic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/message_of.h"
#include "survey/line.h"

namespace insonify::mosaic_test {
namespace {

using testing::Each;

// A line of `count` pings, `step` apart along a compass heading, from a place [deg], all alike.
MosaicLine line_of(const SonarConfig& sonar, const Ping& alike, int count, double step, const Vec3& from,
                   double heading, double altitude) {
  const double yaw = radians_from_degrees(90 - heading);
  const Vec3 ahead(std::cos(yaw), std::sin(yaw), 0);
  return {.sonar = sonar,
          .ping_count = static_cast<std::uint64_t>(count),
          .ping =
              [=](std::uint64_t number) {
                Ping ping = alike;
                ping.number = number;
                ping.world_from_sonar = {from + static_cast<double>(number) * step * ahead,
                                         orientation_from_rpy(0, 0, yaw)};
                return ping;
              },
          .altitudes = {altitude}};
}

Vec3 middle_of(const Mosaic& mosaic, int column, int row) {
  return {mosaic.west + (column + 0.5) * mosaic.cell, mosaic.north - (row + 0.5) * mosaic.cell, 0};
}

// Middle of all that is brighter than half of the brightest.
Vec3 bright_middle(const Mosaic& mosaic) {
  float most = 0;
  for (const float value : mosaic.intensity) {
    most = std::isnan(value) ? most : std::max(most, value);
  }
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (int row = 0; row < mosaic.rows; ++row) {
    for (int column = 0; column < mosaic.columns; ++column) {
      if (mosaic.intensity[mosaic.index(column, row)] > most / 2) {
        sum += middle_of(mosaic, column, row);
        ++count;
      }
    }
  }
  return sum / count;
}

// Altitude 5 m, an echo at 13 m: 12 m abeam. Heading 60 degrees: starboard is towards 150, port towards 330 degrees.
TEST(MosaicTest, AnEchoLiesAbeamAtItsGroundRange) {
  const SonarConfig sonar = side_scan_sonar();
  for (const int beam : {0, 1}) {
    Ping ping = dark_ping(sonar);
    ping.intensity[ping.index(260, beam)] = 1;
    const Mosaic mosaic = make_mosaic(std::array{line_of(sonar, ping, 1, 0, {100, -50, -3}, 60, 5)}, {.cell = 0.05});
    const double bearing = radians_from_degrees(beam == 0 ? 330 : 150);
    const Vec3 expected(100 + 12.027 * std::sin(bearing), -50 + 12.027 * std::cos(bearing), 0);
    EXPECT_NEAR((bright_middle(mosaic) - expected).norm(), 0, 0.05) << beam;
  }
}

// With the nose 20 degrees down, 5 m above the bed, the beams meet it 5 tan(20 deg) = 1.82 m behind the sonar.
TEST(MosaicTest, PitchMovesTheBeamsAlongTheTrack) {
  const SonarConfig sonar = side_scan_sonar();
  Ping ping = dark_ping(sonar);
  ping.world_from_sonar = {Vec3(0, 0, 5), orientation_from_rpy(0, radians_from_degrees(20), 0)};
  ping.intensity[ping.index(260, 0)] = 1;
  const MosaicLine line{sonar, 1, [&](std::uint64_t) { return ping; }, {5}};
  const Vec3 middle = bright_middle(make_mosaic(std::array{line}, {.cell = 0.05}));
  EXPECT_NEAR(middle.x(), -5 * std::tan(radians_from_degrees(20)), 0.05);
  EXPECT_NEAR(middle.y(), std::sqrt(13.025 * 13.025 - std::pow(5 / std::cos(radians_from_degrees(20)), 2)), 0.05);
}

// Two passes of one recording, to the north along x = 0 and back along x = 30, 20 s later. Without the pause between,
// the pings around it would reach 30 m along the track.
TEST(MosaicTest, PassesOfOneRecordingAreLinesOfTheirOwn) {
  const SonarConfig sonar = side_scan_sonar();
  Ping ping = dark_ping(sonar);
  std::ranges::fill(ping.intensity, 1.0F);
  const MosaicLine north = line_of(sonar, ping, 20, 0.5, {0, 0, 5}, 0, 5);
  const MosaicLine south = line_of(sonar, ping, 20, 0.5, {30, 9.5, 5}, 180, 5);
  MosaicLine both = north;
  both.ping_count = 40;
  for (const double pause : {20.0, 0.0}) {
    both.ping = [&](std::uint64_t number) {
      Ping one = number < 20 ? north.ping(number) : south.ping(number - 20);
      one.time = 0.25 * static_cast<double>(number) + (number < 20 ? 0 : pause);
      return one;
    };
    const Mosaic mosaic = make_mosaic(std::array{both}, {.cell = 0.5});
    double highest = -1e9;
    for (int row = 0; row < mosaic.rows; ++row) {
      for (int column = 0; column < mosaic.columns; ++column) {
        const std::size_t at = mosaic.index(column, row);
        highest = std::isnan(mosaic.intensity[at]) ? highest : std::max(highest, middle_of(mosaic, column, row).y());
      }
    }
    // Half of a beam of 1 degree at 40 m, of 0.35 m, or the way to the next ping, 0.5 m.
    EXPECT_NEAR(highest, pause > 0 ? 10 : 39.5, 0.51);
  }
}

// Where the first pass sees at 12 m, 5/13 below the horizontal, the second sees at 18 m, at 15.5 degrees.
TEST(MosaicTest, OfTwoPassesTheBestIsShownToo) {
  const SonarConfig sonar = side_scan_sonar();
  Ping bright = dark_ping(sonar), dim = bright;
  std::ranges::fill(bright.intensity, 4.0F);
  std::ranges::fill(dim.intensity, 1.0F);
  const MosaicLine north = line_of(sonar, bright, 20, 0.5, {0, 0, 5}, 0, 5);
  const MosaicLine south = line_of(sonar, dim, 20, 0.5, {30, 9.5, 5}, 180, 5);
  MosaicLine both = north;
  both.ping_count = 40;
  both.ping = [&](std::uint64_t number) {
    Ping one = number < 20 ? north.ping(number) : south.ping(number - 20);
    one.time = 0.25 * static_cast<double>(number) + (number < 20 ? 0 : 20);
    return one;
  };
  const Mosaic mosaic = make_mosaic(std::array{both}, {.cell = 0.5});
  const auto level_at = [&](double x) {
    return mosaic.intensity[mosaic.index(static_cast<int>((x - mosaic.west) / mosaic.cell),
                                         static_cast<int>((mosaic.north - 5) / mosaic.cell))];
  };
  EXPECT_NEAR(level_at(12), 4, 1e-3);
  EXPECT_NEAR(level_at(18), 1, 1e-3);
  const auto line_at = [&](double x) {
    return mosaic.line[mosaic.index(static_cast<int>((x - mosaic.west) / mosaic.cell),
                                    static_cast<int>((mosaic.north - 5) / mosaic.cell))];
  };
  EXPECT_EQ(mosaic.line_count, 2);
  EXPECT_EQ(line_at(12), 0);
  EXPECT_EQ(line_at(18), 1);
}

// A beam of 6 degrees is 0.105 r wide: 1.36 m at 13 m, 4.08 m at 39 m; within two cells of 5 cm.
TEST(MosaicTest, FootprintsGrowWithRange) {
  SonarConfig sonar = side_scan_sonar();
  sonar.azimuth_aperture = radians_from_degrees(6);
  Ping ping = dark_ping(sonar);
  std::ranges::fill(ping.intensity, 1.0F);
  const Mosaic mosaic = make_mosaic(std::array{line_of(sonar, ping, 1, 0, {0, 0, 5}, 0, 5)}, {.cell = 0.05});
  for (const double range : {13.0, 39.0}) {
    const double ground = std::sqrt(range * range - 25);
    int cells = 0;
    for (int row = 0; row < mosaic.rows; ++row) {
      const int column = static_cast<int>((ground - mosaic.west) / mosaic.cell);
      cells += std::isnan(mosaic.intensity[mosaic.index(column, row)]) ? 0 : 1;
    }
    EXPECT_NEAR(cells * mosaic.cell, radians_from_degrees(6) * range, 0.1) << range;
  }
}

// Two lines to the north, 20 m apart, 10 m above the bed. On the track of the first the second is seen at
// atan(10 / 20) = 27 degrees, the first itself at 90: it is the second's there, and the other way round; halfway each
// is at 45 degrees.
TEST(MosaicTest, NadirIsFilledByTheOtherLine) {
  const SonarConfig sonar = side_scan_sonar();
  Ping dim = dark_ping(sonar), bright = dim;
  std::ranges::fill(dim.intensity, 0.25F);
  std::ranges::fill(bright.intensity, 0.75F);
  const std::array lines{line_of(sonar, dim, 80, 0.5, {0, 0, 0}, 0, 10),
                         line_of(sonar, bright, 80, 0.5, {20, 0, 0}, 0, 10)};
  const auto at = [](const Mosaic& mosaic, double x) {
    return mosaic.index(static_cast<int>((x - mosaic.west) / mosaic.cell),
                        static_cast<int>((mosaic.north - 20) / mosaic.cell));
  };
  const Mosaic best = make_mosaic(lines, {.cell = 0.2});
  EXPECT_EQ(best.line[at(best, 0.1)], 1);
  EXPECT_EQ(best.line[at(best, 20.1)], 0);
  EXPECT_NEAR(best.intensity[at(best, 0.1)], 0.75, 1e-5);
  EXPECT_NEAR(degrees_from_radians(best.angle[at(best, 0.1)]), 26.7, 0.5);
  EXPECT_EQ(best.line[at(best, -30)], 0);  // Only the first reaches there.
  const Mosaic latest = make_mosaic(lines, {.cell = 0.2, .rule = MosaicRule::kLatest});
  EXPECT_EQ(latest.line[at(latest, 20.1)], 1);
  EXPECT_EQ(latest.line[at(latest, -30)], 0);
  const Mosaic mean = make_mosaic(lines, {.cell = 0.2, .rule = MosaicRule::kMean});
  EXPECT_NEAR(mean.intensity[at(mean, 10)], 0.5, 1e-5);
  EXPECT_NEAR(mean.intensity[at(mean, -30)], 0.25, 1e-5);
}

// A level bed of equal intensity stays equal everywhere, without holes between pings and bins: all of the rectangle
// that the line covers is seen, sqrt(40^2 - 100) = 38.7 m to both sides.
TEST(MosaicTest, AnEqualBedHasNoHoles) {
  const SonarConfig sonar = side_scan_sonar();
  Ping ping = dark_ping(sonar);
  std::ranges::fill(ping.intensity, 0.5F);
  const Mosaic mosaic = make_mosaic(std::array{line_of(sonar, ping, 40, 0.3, {0, 0, 0}, 37, 10)}, {.cell = 0.1});
  const double yaw = radians_from_degrees(90 - 37);
  for (int row = 0; row < mosaic.rows; ++row) {
    for (int column = 0; column < mosaic.columns; ++column) {
      const Vec3 place = middle_of(mosaic, column, row);
      const double along = place.x() * std::cos(yaw) + place.y() * std::sin(yaw);
      const double across = place.y() * std::cos(yaw) - place.x() * std::sin(yaw);
      const float value = mosaic.intensity[mosaic.index(column, row)];
      if (along > 0 && along < 11.7 && std::abs(across) < 38.5) {
        ASSERT_NEAR(value, 0.5, 1e-5) << along << ' ' << across;
      } else if (std::abs(across) > 39) {
        ASSERT_TRUE(std::isnan(value)) << across;
      }
    }
  }
}

TEST(MosaicTest, LabelsComeAlong) {
  const SonarConfig sonar = side_scan_sonar();
  Ping ping = dark_ping(sonar);
  ping.instance.assign(ping.intensity.size(), 2);
  for (int bin = 400; bin < 420; ++bin) {
    ping.instance[ping.index(bin, 1)] = 7;
  }
  const Mosaic mosaic = make_mosaic(std::array{line_of(sonar, ping, 10, 0.3, {0, 0, 0}, 0, 10)}, {.cell = 0.2});
  const auto label = [&](double x) {
    return mosaic.instance[mosaic.index(static_cast<int>((x - mosaic.west) / mosaic.cell),
                                        static_cast<int>((mosaic.north - 1) / mosaic.cell))];
  };
  EXPECT_EQ(label(std::sqrt(20.5 * 20.5 - 100)), 7);
  EXPECT_EQ(label(-std::sqrt(20.5 * 20.5 - 100)), 2);
  EXPECT_EQ(label(10), 2);
  EXPECT_EQ(label(-39.5), kNoLabel);
}

TEST(MosaicTest, BadInputIsRefused) {
  const SonarConfig sonar = side_scan_sonar();
  const Ping ping = dark_ping(sonar);
  EXPECT_EQ(message_of([&] { (void)make_mosaic({}); }), "a mosaic of 0 lines must have from 1 to 65534");
  EXPECT_EQ(message_of([&] {
              (void)make_mosaic(std::array{line_of(sonar, ping, 0, 1, {0, 0, 0}, 0, 5)});
            }),
            "sss: a line of a mosaic must have at least one ping");
  EXPECT_EQ(message_of([&] {
              (void)make_mosaic(std::array{line_of(sonar, ping, 3, 1, {0, 0, 0}, 0, -5)});
            }),
            "altitude = -5 m must be greater than 0 m");
  EXPECT_EQ(message_of([&] {
              (void)make_mosaic(std::array{line_of(sonar, ping, 3, std::nan(""), {0, 0, 0}, 0, 5)});
            }),
            "ping 0 of sss: its pose is not finite");
  MosaicLine two = line_of(sonar, ping, 3, 1, {0, 0, 0}, 0, 5);
  two.altitudes = {5, 6};
  EXPECT_EQ(message_of([&] { (void)make_mosaic(std::array{two}); }),
            "sss: there are 2 altitudes for 3 pings; there must be one for all or one for each");
  EXPECT_EQ(message_of([&] {
              (void)make_mosaic(std::array{line_of(sonar, ping, 2, 1e6, {0, 0, 0}, 0, 5)}, {.cell = 0.1});
            }),
            "a mosaic of 80 m x 1000080 m with cells of 0.1 m has 8e+09 of them; the most is 1e+08");
}

TEST(MosaicTest, ABedOutOfReachAndCellsAsLargeAsTheChartAreRefused) {
  const SonarConfig sonar = side_scan_sonar();
  const Ping ping = dark_ping(sonar);
  EXPECT_EQ(message_of([&] {
              (void)make_mosaic(std::array{line_of(sonar, ping, 1, 0, {0, 0, 0}, 0, 100)});
            }),
            "sss: no bin reaches the bed: its altitude is 100 m, its ranges end at 40 m");
  EXPECT_EQ(message_of([&] {
              (void)make_mosaic(std::array{line_of(sonar, ping, 21, 1, {0, 0, 0}, 0, 5)}, {.cell = 1000});
            }),
            "cell = 1000 m must be at most 40 m, half of the shorter side of 80 m x 100 m");
}

}  // namespace
}  // namespace insonify::mosaic_test
