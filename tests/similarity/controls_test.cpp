// controls_test.cpp -- control pictures and their scores.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "similarity/reference_pictures.h"

namespace insonify::controls_test {
namespace {

// Sums of a few thousand numbers of order one.
constexpr double kRounding = 1e-12;

// Rows 0 1 2 and 3 4 8 of tenths: means 1 and 5, of all 3.
const GreyPicture kSmall{"small", 3, 2, {0, 0.1, 0.2, 0.3, 0.4, 0.8}};

TEST(ControlsTest, FlatGreyIsTheMean) {
  for (const double value : flat_grey(kSmall).values) {
    EXPECT_NEAR(value, 0.3, kRounding);
  }
  EXPECT_EQ(flat_grey(kSmall).name, "flat grey of small");
}

TEST(ControlsTest, TheRangeProfileIsTheMeanOfEachRow) {
  EXPECT_THAT(mean_range_profile(kSmall).values,
              testing::Pointwise(testing::DoubleNear(kRounding), std::vector{0.1, 0.1, 0.1, 0.5, 0.5, 0.5}));
}

TEST(ControlsTest, AShuffleKeepsThePixelsAndIsTheSameEveryTime) {
  const GreyPicture a = waves_and_squares(64);
  const GreyPicture shuffled = pixel_shuffle(a);
  EXPECT_EQ(shuffled.values, pixel_shuffle(a).values);
  EXPECT_EQ(ks_distance(a.values, shuffled.values), 0);
  // 4096 pixels in random order have the correlation 0, with the standard deviation 1 / sqrt(4096).
  EXPECT_LT(std::abs(correlation(a, shuffled)), 4.0 / 64);
}

// Each pixel's new place is uniform: the mean distance that it travels is a third of the length.
TEST(ControlsTest, AShuffleSendsPixelsEverywhere) {
  constexpr int kLength = 10000;
  GreyPicture line{"line", kLength, 1, {}};
  for (int i = 0; i < kLength; ++i) {
    line.values.push_back(i / double{kLength});
  }
  const GreyPicture shuffled = pixel_shuffle(line);
  double travelled = 0;
  for (int i = 0; i < kLength; ++i) {
    travelled += std::abs(shuffled.values[i] - line.values[i]) / kLength;
  }
  EXPECT_NEAR(travelled, 1.0 / 3, 0.01);  // Four deviations: 4 x 0.236 / sqrt(10000).
}

// The mean squared error of the mean is the variance, that of a shuffle twice as much; correlation knows neither.
TEST(ControlsTest, TheyScoreTheVarianceOfThePicture) {
  const GreyPicture a = with_noise(waves_and_squares(176));
  const ControlSimilarities controls = compare_controls(a);
  const double variance = mean_squared_error(a, flat_grey(a));
  EXPECT_EQ(controls.flat_grey.mse, variance);
  EXPECT_EQ(controls.flat_grey.correlation, 0);
  EXPECT_NEAR(controls.pixel_shuffle.mse, 2 * variance, 0.05 * variance);
  EXPECT_LT(controls.range_profile.mse, variance);
  // What the profile explains of the variance is the square of its correlation.
  EXPECT_NEAR(controls.range_profile.mse, variance * (1 - std::pow(controls.range_profile.correlation, 2)), kRounding);
}

TEST(ControlsTest, AChangeOfGainAloneBeatsThemAll) {
  const GreyPicture a = waves_and_squares(176);
  const Similarity gain = compare_pictures(a, with_gain(a));
  const ControlSimilarities controls = compare_controls(a);
  for (const Similarity& control : {controls.flat_grey, controls.range_profile, controls.pixel_shuffle}) {
    EXPECT_LT(gain.mse, control.mse);
    EXPECT_GT(gain.ssim, control.ssim);
    EXPECT_GT(gain.ms_ssim, control.ms_ssim);
    EXPECT_GT(gain.correlation, control.correlation);
  }
}

}  // namespace
}  // namespace insonify::controls_test
