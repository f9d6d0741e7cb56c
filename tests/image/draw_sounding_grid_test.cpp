// draw_sounding_grid_test.cpp -- colours, contours and size of charts.

#include "insonify/draw_sounding_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/message_of.h"

namespace insonify::draw_sounding_grid_test {
namespace {

// A slope of 80 x 60 cells of 0.5 m that rises to the east, from -9 to -1 m.
SoundingGrid slope() {
  SoundingGrid grid{.west = 0, .north = 30, .cell = 0.5, .columns = 80, .rows = 60};
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      grid.height.push_back(static_cast<float>(-9 + 8 * column / 79.0));
    }
  }
  grid.uncertainty.assign(grid.height.size(), 0.1F);
  grid.count.assign(grid.height.size(), 5);
  return grid;
}

int brightness(const Picture& picture, int x, int y) {
  const std::uint8_t* pixel = picture.at(x, y);
  return pixel[0] + pixel[1] + pixel[2];
}

// Letters of 900 / 55 = 16 pixels: the chart begins 5.2 and ends 8 of these from the sides.
constexpr int kLetter = 16, kLeft = 84, kRight = 8 * kLetter;

TEST(DrawSoundingGridTest, ShallowsAreBrighter) {
  const Picture chart = draw_sounding_grid(slope(), {"slope", "one line"});
  EXPECT_EQ(chart.height, 900);
  EXPECT_GT(brightness(chart, chart.width - kRight - 20, 450), brightness(chart, kLeft + 20, 450) + 150);
}

// Depths 8, 7 ... 2 m: seven contours, darker than the bed on both sides of them.
TEST(DrawSoundingGridTest, ContoursAreAtRoundDepths) {
  const Picture chart = draw_sounding_grid(slope(), {"slope", "one line"});
  int lines = 0;
  const int y = 700;  // Below the labels, which are where contours begin.
  for (int x = kLeft + 20; x < chart.width - kRight - 20; ++x) {
    const int here = brightness(chart, x, y);
    lines += here < brightness(chart, x - 4, y) - 20 && here < brightness(chart, x + 4, y) - 20 &&
                     here <= brightness(chart, x - 1, y) && here < brightness(chart, x + 1, y)
                 ? 1
                 : 0;
  }
  EXPECT_EQ(lines, 7);
}

TEST(DrawSoundingGridTest, TheDifferenceFromTheTruthIsBeside) {
  SoundingGrid grid = slope();
  const int alone = draw_sounding_grid(grid, {"slope", ""}).width;
  grid.truth = grid.height;
  for (std::size_t cell = 0; cell < grid.truth.size(); ++cell) {
    grid.truth[cell] += cell % 80 < 40 ? 0.2F : -0.2F;  // The chart is below it in the west, above it in the east.
  }
  const Picture both = draw_sounding_grid(grid, {"slope", ""});
  EXPECT_GE(both.width, 2 * alone);
  const std::uint8_t* west = both.at(both.width - alone + kLeft + 60, 450);
  const std::uint8_t* east = both.at(both.width - kRight - 60, 450);
  EXPECT_GT(west[2], west[0] + 50);  // Blue.
  EXPECT_GT(east[0], east[2] + 50);  // Red.
}

TEST(DrawSoundingGridTest, GapsAreGrey) {
  SoundingGrid grid = slope();
  for (int row = 20; row < 40; ++row) {
    for (int column = 20; column < 60; ++column) {
      grid.height[grid.index(column, row)] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  const Picture chart = draw_sounding_grid(grid, {"slope", ""});
  const std::uint8_t* middle = chart.at((kLeft + chart.width - kRight) / 2, 450);
  EXPECT_EQ(middle[0], 43);
  EXPECT_EQ(middle[1], 48);
  EXPECT_EQ(middle[2], 56);
}

TEST(DrawSoundingGridTest, BadInputIsRefused) {
  SoundingGrid grid = slope();
  EXPECT_EQ(message_of([&] { (void)draw_sounding_grid(grid, {}, 0, 100); }),
            "height = 100 pixels must be from 240 to 8192 pixels");
  grid.height.assign(grid.height.size(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(message_of([&] { (void)draw_sounding_grid(grid, {}); }), "a chart needs a grid with a height");
}

}  // namespace
}  // namespace insonify::draw_sounding_grid_test
