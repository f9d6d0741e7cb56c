// sounding_grid_test.cpp -- heights and uncertainties of cells by hand, planes, outliers, gaps, and what is refused.

#include "insonify/survey/sounding_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "insonify/survey/bottom_detection.h"
#include "support/message_of.h"

namespace insonify::sounding_grid_test {
namespace {

using testing::ElementsAre;

PlacedSounding sounding(double x, double y, double z, float deviation = 0.1F) {
  return {.position = {x, y, z}, .deviation = deviation, .quality = 3, .detection = Detection::kPhase};
}

// Straight down, 60 degrees to port, and nothing. By hand: cos(60 deg) = 1/2.
TEST(PlaceSoundingsTest, UncertaintyOfTheHeightFollowsTheAngle) {
  const Pose down{Vec3(10, 20, -3), orientation_from_rpy(0, std::numbers::pi / 2, 0)};
  std::vector<Sounding> soundings(4);
  soundings[0] = {.range = 8, .uncertainty = 0.2F, .quality = 2, .detection = Detection::kAmplitude};
  soundings[1] = {.azimuth = static_cast<float>(radians_from_degrees(60)),
                  .range = 8,
                  .uncertainty = 0.2F,
                  .detection = Detection::kPhase};
  soundings[3] = {.azimuth = static_cast<float>(radians_from_degrees(89)),
                  .range = 8,
                  .uncertainty = 0.2F,
                  .detection = Detection::kPhase};
  std::vector<PlacedSounding> placed;
  place_soundings(soundings, down, placed);
  ASSERT_EQ(placed.size(), 3);
  EXPECT_NEAR((placed[0].position - Vec3(10, 20, -11)).norm(), 0, 1e-6);
  EXPECT_NEAR(placed[0].deviation, 0.2, 1e-6);
  EXPECT_EQ(placed[0].detection, Detection::kAmplitude);
  EXPECT_EQ(placed[0].quality, 2);
  EXPECT_NEAR((placed[1].position - Vec3(10, 20 + 8 * std::sqrt(0.75), -7)).norm(), 0, 1e-5);
  EXPECT_NEAR(placed[1].deviation, 0.1, 1e-6);
  EXPECT_NEAR(placed[2].deviation, 0.02, 1e-6);  // Not 0.2 cos(89 deg) = 0.0035.
}

// By position_of(), and through water of equal speed along a straight ray whose length is that of the time: 1450 /
// 1500.
TEST(PlaceSoundingsTest, AProfileBendsTheRays) {
  const Pose down{Vec3(10, 20, -3), orientation_from_rpy(0, std::numbers::pi / 2, 0)};
  const std::array soundings{
      Sounding{.azimuth = 0.9F, .range = 30, .uncertainty = 0.2F, .detection = Detection::kPhase}};
  std::vector<PlacedSounding> placed;
  const std::array points{ProfilePoint{0, 1520}, ProfilePoint{40, 1480}};
  const SoundSpeedProfile profile(points);
  place_soundings(soundings, down, profile, 1, 1500, placed);
  EXPECT_EQ(placed[0].position, position_of(soundings[0], down, profile, 1, 1500));
  const std::array equal{ProfilePoint{0, 1450}};
  place_soundings(soundings, down, SoundSpeedProfile(equal), 1, 1500, placed);
  EXPECT_NEAR((placed[1].position - position_of(soundings[0], down, 1450.0 / 1500)).norm(), 0, 1e-9);
  EXPECT_NEAR(placed[1].deviation, 0.2 * std::cos(0.9), 1e-6);
}

// Weights 1/0.01 and 1/0.04: (100 * -10 + 25 * -10.1) / 125 = -10.02; 1 / sqrt(125) = 0.0894. chi^2 / (n - 1) is
// (0.02 / 0.1)^2 + (0.08 / 0.2)^2 = 0.2 < 1.
TEST(SoundingGridTest, TheMeanIsWeightedByInverseVariances) {
  const std::array soundings{sounding(0.2, 0.2, -10, 0.1F), sounding(0.8, 0.6, -10.1, 0.2F)};
  const SoundingGrid grid = make_sounding_grid(soundings, {.cell = 1});
  ASSERT_EQ(grid.height.size(), 1);
  EXPECT_NEAR(grid.height[0], -10.02, 1e-5);
  EXPECT_NEAR(grid.uncertainty[0], std::sqrt(1.0 / 125), 1e-6);
  EXPECT_EQ(grid.count[0], 2);
  EXPECT_EQ(grid.west, 0);
  EXPECT_EQ(grid.north, 1);
}

// Soundings 1 m apart that state 0.1 m: chi^2 = 2 (0.5 / 0.1)^2 = 50, so 0.1 / sqrt(2) grows by sqrt(50).
TEST(SoundingGridTest, UncertaintyGrowsWithScatter) {
  const std::array soundings{sounding(0.2, 0.2, -10), sounding(0.8, 0.6, -11)};
  const SoundingGrid grid = make_sounding_grid(soundings, {.cell = 1});
  EXPECT_NEAR(grid.height[0], -10.5, 1e-6);
  EXPECT_NEAR(grid.uncertainty[0], 0.5, 1e-6);
}

// Of -10, -10.1, -10.2 with 0.3 m each; sqrt(pi / 2) 0.3 / sqrt(3) = 0.217.
TEST(SoundingGridTest, MedianAndShoalAreOnRequest) {
  const std::array soundings{sounding(0.2, 0.2, -10.2, 0.3F), sounding(0.5, 0.5, -10, 0.3F),
                             sounding(0.8, 0.6, -10.15, 0.3F)};
  const SoundingGrid median = make_sounding_grid(soundings, {.cell = 1, .method = GridMethod::kMedian});
  EXPECT_NEAR(median.height[0], -10.15, 1e-6);
  EXPECT_NEAR(median.uncertainty[0], std::sqrt(std::numbers::pi / 2) * 0.3 / std::sqrt(3), 1e-6);
  const SoundingGrid shoal = make_sounding_grid(soundings, {.cell = 1, .method = GridMethod::kShoal});
  EXPECT_NEAR(shoal.height[0], -10, 1e-6);
  EXPECT_NEAR(shoal.uncertainty[0], 0.3, 1e-6);
}

// Median -10.1; absolute deviations 0, 0.1, 0.1, 0.1, 5: 1.4826 * 0.1 = 0.148 m. The fish is 34 of these above it.
TEST(SoundingGridTest, OutliersAreRefusedAndCounted) {
  const std::array soundings{sounding(0.1, 0.1, -10, 0.05F), sounding(0.3, 0.1, -10.1, 0.05F),
                             sounding(0.5, 0.1, -10.2, 0.05F), sounding(0.7, 0.1, -10.2, 0.05F),
                             sounding(0.9, 0.1, -5.1, 0.05F)};
  const SoundingGrid grid = make_sounding_grid(soundings, {.cell = 1});
  EXPECT_NEAR(grid.height[0], -10.125, 1e-5);
  EXPECT_EQ(grid.refused, 1);
  EXPECT_EQ(grid.count[0], 4);
  const SoundingGrid shoal = make_sounding_grid(soundings, {.cell = 1, .method = GridMethod::kShoal});
  EXPECT_NEAR(shoal.height[0], -10, 1e-6);
  const SoundingGrid all = make_sounding_grid(soundings, {.cell = 1, .outliers = 0});
  EXPECT_EQ(all.refused, 0);
  EXPECT_EQ(all.count[0], 5);
  EXPECT_NEAR(all.height[0], -9.12, 1e-5);
}

// Of two soundings neither is more credible; and one whose own deviation admits it stays.
TEST(SoundingGridTest, UncertainSoundingsAreNoOutliers) {
  const std::array two{sounding(0.1, 0.1, -10), sounding(0.3, 0.1, -5)};
  EXPECT_EQ(make_sounding_grid(two, {.cell = 1}).refused, 0);
  const std::array wide{sounding(0.1, 0.1, -10), sounding(0.3, 0.1, -10), sounding(0.5, 0.1, -10.01),
                        sounding(0.7, 0.1, -7, 1)};
  EXPECT_EQ(make_sounding_grid(wide, {.cell = 1}).refused, 0);
}

// z = -12 + 0.1 x - 0.05 y with normal errors of 0.15 m. A cell of 2 m has 16 soundings on a regular lattice, so that
// its mean is the plane's height in its middle with a deviation of 0.0375 m, and the slope across it adds to the
// scatter: 0.1 m * 2 m / sqrt(12) = 0.06 m and half of that.
TEST(SoundingGridTest, APlaneIsRecoveredWithinItsUncertainty) {
  std::mt19937 random(7);
  std::normal_distribution<double> error(0, 0.15);
  std::vector<PlacedSounding> soundings;
  for (double x = -39.75; x < 40; x += 0.5) {
    for (double y = 100.25; y < 140; y += 0.5) {
      soundings.push_back(sounding(x, y, -12 + 0.1 * x - 0.05 * y + error(random), 0.15F));
    }
  }
  for (const GridMethod method : {GridMethod::kMean, GridMethod::kMedian}) {
    const SoundingGrid grid = make_sounding_grid(soundings, {.cell = 2, .method = method, .outliers = 0});
    ASSERT_EQ(grid.columns, 40);
    ASSERT_EQ(grid.rows, 20);
    double squares = 0;
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const double x = grid.west + 2 * column + 1, y = grid.north - 2 * row - 1;
        const std::size_t at = grid.index(column, row);
        ASSERT_EQ(grid.count[at], 16);
        ASSERT_NEAR(grid.height[at], -12 + 0.1 * x - 0.05 * y, 5 * grid.uncertainty[at]);
        squares += std::pow((grid.height[at] - (-12 + 0.1 * x - 0.05 * y)) / grid.uncertainty[at], 2);
      }
    }
    // Of 800 cells: 1 where uncertainties are right, within 5 %, and less by the slope's part of the scatter, 0.2.
    EXPECT_GT(std::sqrt(squares / 800), 0.75);
    EXPECT_LT(std::sqrt(squares / 800), 1.1);
  }
}

TEST(SoundingGridTest, RowsBeginInTheNorth) {
  const std::array soundings{sounding(-0.5, 10.5, -1), sounding(1.5, 10.5, -2), sounding(-0.5, 8.5, -3)};
  const SoundingGrid grid = make_sounding_grid(soundings, {.cell = 1});
  EXPECT_EQ(grid.west, -1);
  EXPECT_EQ(grid.north, 11);
  EXPECT_EQ(grid.columns, 3);
  EXPECT_EQ(grid.rows, 3);
  EXPECT_EQ(grid.height[0], -1);
  EXPECT_EQ(grid.height[2], -2);
  EXPECT_EQ(grid.height[6], -3);
  EXPECT_TRUE(std::isnan(grid.height[4]));
  EXPECT_TRUE(std::isnan(grid.uncertainty[4]));
  EXPECT_THAT(grid.count, ElementsAre(1, 0, 1, 0, 0, 0, 1, 0, 0));
}

// A gap of three cells between -4 and -8: -5, -6, -7, and half of the rise as uncertainty: sqrt(0.1^2 + 2^2).
TEST(SoundingGridTest, SmallGapsAreFilledOnRequest) {
  const std::array soundings{sounding(0.5, 0.5, -4), sounding(4.5, 0.5, -8), sounding(9.5, 0.5, -8)};
  const SoundingGrid none = make_sounding_grid(soundings, {.cell = 1});
  EXPECT_TRUE(std::isnan(none.height[1]));
  EXPECT_EQ(none.filled, 0);
  const SoundingGrid grid = make_sounding_grid(soundings, {.cell = 1, .fill = 3});
  EXPECT_NEAR(grid.height[1], -5, 1e-6);
  EXPECT_NEAR(grid.height[2], -6, 1e-6);
  EXPECT_NEAR(grid.height[3], -7, 1e-6);
  EXPECT_NEAR(grid.uncertainty[2], std::sqrt(4.01), 1e-5);
  EXPECT_EQ(grid.count[2], 0);
  EXPECT_TRUE(std::isnan(grid.height[6]));  // A gap of four.
  EXPECT_EQ(grid.filled, 3);
}

TEST(SoundingGridTest, SoundingsAreLeftOutByQualityAndDetection) {
  std::array soundings{sounding(0.5, 0.5, -4), sounding(0.5, 0.5, -5), sounding(0.5, 0.5, -6)};
  soundings[0].quality = 1;
  soundings[1].detection = Detection::kAmplitude;
  EXPECT_NEAR(make_sounding_grid(soundings, {.cell = 1, .least_quality = 2}).height[0], -5.5, 1e-6);
  const SoundingGrid grid = make_sounding_grid(soundings, {.cell = 1, .least_quality = 2, .only = Detection::kPhase});
  EXPECT_NEAR(grid.height[0], -6, 1e-6);
  EXPECT_EQ(grid.given, 3);
  EXPECT_EQ(grid.left_out, 2);
  EXPECT_EQ(message_of([&] { (void)make_sounding_grid(soundings, {.least_quality = 4}); }),
            "no sounding is left to grid: all 3 were left out by quality or detection");
}

// Every 0.3 m: cells of 0.5 m have 2.8 soundings, those of 1 m 11.
TEST(SoundingGridTest, TheCellFollowsTheDensity) {
  std::vector<PlacedSounding> soundings;
  for (int i = 0; i < 200; ++i) {
    for (int k = 0; k < 100; ++k) {
      soundings.push_back(sounding(0.3 * i, 0.3 * k, -4));
    }
  }
  EXPECT_EQ(make_sounding_grid(soundings).cell, 1);
  // One sounding, and two that are far apart, are gridded too.
  EXPECT_EQ(make_sounding_grid(std::array{sounding(3, 4, -5)}).count[0], 1);
  EXPECT_EQ(make_sounding_grid(std::array{sounding(0, 0, -5), sounding(300, 400, -5)}).count.front(), 2);
}

TEST(SoundingGridTest, DoesNotDependOnTheOrderOfSoundings) {
  std::vector<PlacedSounding> soundings;
  for (int i = 0; i < 300; ++i) {
    soundings.push_back(sounding(0.01 * i, 0.5, -4 - 0.37 * (i * 7 % 11), i % 3 == 0 ? 0.2F : 0.1F));
  }
  const SoundingGrid grid = make_sounding_grid(soundings, {.cell = 1});
  std::ranges::reverse(soundings);
  EXPECT_EQ(make_sounding_grid(soundings, {.cell = 1}).height, grid.height);
}

TEST(SoundingGridTest, BadInputIsRefused) {
  EXPECT_EQ(message_of([] { (void)make_sounding_grid({}); }), "there is no sounding to grid");
  const std::array far{sounding(0, 0, -4), sounding(1000, 2000, -4)};
  EXPECT_EQ(message_of([&] { (void)make_sounding_grid(far, {.cell = -1}); }), "cell = -1 m must be at least 0 m");
  EXPECT_EQ(message_of([&] { (void)make_sounding_grid(far, {.cell = 1, .fill = -1}); }),
            "fill = -1 cells must be from 0 to 1000 cells");
  EXPECT_EQ(message_of([&] { (void)make_sounding_grid(far, {.cell = 1, .outliers = std::nan("")}); }),
            "outliers = nan must be at least 0");
  EXPECT_EQ(message_of([&] { (void)make_sounding_grid(far, {.cell = 0.01}); }),
            "a grid of 1000 m x 2000 m with cells of 0.01 m has 2e+10 of them; the most is 1e+08");
  EXPECT_EQ(message_of([] { (void)make_sounding_grid(std::array{sounding(0, std::nan(""), -4)}); }),
            "sounding 0: its position is not finite");
  EXPECT_EQ(message_of([] {
              (void)make_sounding_grid(std::array{sounding(0, 0, -4), sounding(0, 0, -4, 0)});
            }),
            "sounding 1: its standard deviation of 0 m must be greater than 0 and finite");
}

// S-44, table 1, at 20 m: sqrt(0.15^2 + 0.15^2) = 0.2121, sqrt(0.25^2 + 0.15^2) = 0.2915, sqrt(0.5^2 + 0.26^2) =
// 0.5636.
TEST(SurveyOrderTest, AllowsWhatS44Does) {
  EXPECT_NEAR(allowed_uncertainty(SurveyOrder::kExclusive, 20), 0.2121, 1e-4);
  EXPECT_NEAR(allowed_uncertainty(SurveyOrder::kSpecial, 20), 0.2915, 1e-4);
  EXPECT_NEAR(allowed_uncertainty(SurveyOrder::k1a, 20), 0.5636, 1e-4);
  EXPECT_EQ(allowed_uncertainty(SurveyOrder::kSpecial, -3), 0.25);
}

// Differences 0.1, -0.1, 0.25, -0.5 at 20 m below the datum at z = 10.
TEST(GridErrorsTest, AreThoseOfCellsWithBoth) {
  std::vector<PlacedSounding> soundings;
  for (const auto& [x, z] : {std::pair(0.5, -9.9), {1.5, -10.1}, {2.5, -9.75}, {3.5, -10.5}, {4.5, -10.0}}) {
    soundings.push_back(sounding(x, 0.5, z));
  }
  SoundingGrid grid = make_sounding_grid(soundings, {.cell = 1});
  EXPECT_FALSE(errors_of(grid, 10));
  grid.truth = {-10, -10, -10, -10, std::numeric_limits<float>::quiet_NaN()};
  const GridErrors errors = errors_of(grid, 10).value();
  EXPECT_EQ(errors.cells, 4);
  EXPECT_NEAR(errors.mean, -0.0625, 1e-6);
  // Mean square (0.01 + 0.01 + 0.0625 + 0.25) / 4 = 0.083125, less 0.0625^2.
  EXPECT_NEAR(errors.deviation, std::sqrt(0.083125 - 0.00390625), 1e-6);
  EXPECT_NEAR(errors.within_95, 0.5, 1e-6);
  EXPECT_EQ(errors.exclusive, 0.5);
  EXPECT_EQ(errors.special, 0.75);
  EXPECT_EQ(errors.order_1a, 1);
}

}  // namespace
}  // namespace insonify::sounding_grid_test
