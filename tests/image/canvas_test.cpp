// canvas_test.cpp -- anti-aliased lines, arcs and blending.

#include "image/canvas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace insonify::canvas_test {
namespace {

constexpr Ink kWhite{{255, 255, 255}, 1};

// Ink on a black picture, in whole pixels.
double ink_on(const Picture& picture) {
  double sum = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    sum += picture.rgb[i] / 255.0;
  }
  return sum;
}

TEST(CanvasTest, ALineCoversItsLengthTimesItsWidth) {
  for (const double angle : {0.0, 0.3, 0.7853981633974483, 1.2, 1.5707963267948966, 2.5, 4.0}) {
    Picture picture = blank_picture(200, 200, {0, 0, 0});
    draw_line(picture, {100.5, 100.5}, {100.5 + 60 * std::cos(angle), 100.5 + 60 * std::sin(angle)}, 2, kWhite);
    EXPECT_NEAR(ink_on(picture), 120, 3) << angle;  // Coverage is estimated from distances: 2 %.
  }
}

TEST(CanvasTest, ALineThinnerThanAPixelIsPale) {
  Picture picture = blank_picture(100, 20, {0, 0, 0});
  draw_line(picture, {10, 10.5}, {90, 10.5}, 0.25, kWhite);
  EXPECT_NEAR(ink_on(picture), 20, 0.5);
}

TEST(CanvasTest, AnArcCoversItsLengthTimesItsWidth) {
  for (const double angle : {0.5, 2.0, 4.0, 2 * std::numbers::pi}) {
    Picture picture = blank_picture(200, 200, {0, 0, 0});
    draw_arc(picture, {100, 100}, 70, -angle / 2, angle / 2, 1.5, kWhite);
    EXPECT_NEAR(ink_on(picture), 70 * angle * 1.5, 0.02 * 70 * angle * 1.5 + 1) << angle;
  }
}

// From 0 (up) to 90 degrees, counterclockwise: the upper left quarter.
TEST(CanvasTest, ArcsTurnCounterclockwiseFromUp) {
  Picture picture = blank_picture(100, 100, {0, 0, 0});
  draw_arc(picture, {50, 50}, 30, 0, std::numbers::pi / 2, 2, kWhite);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      if (picture.at(x, y)[0] > 0) {
        EXPECT_LE(x, 50);
        EXPECT_LE(y, 50);
      }
    }
  }
  EXPECT_GT(picture.at(49, 20)[0], 0);
  EXPECT_GT(picture.at(20, 49)[0], 0);
}

TEST(CanvasTest, InkMixesWithWhatIsBelow) {
  Picture picture = blank_picture(4, 4, {100, 50, 0});
  fill_rectangle(picture, {1, 1}, {2, 2}, {{200, 50, 100}, 0.5});
  EXPECT_EQ(picture.at(1, 1)[0], 150);
  EXPECT_EQ(picture.at(1, 1)[1], 50);
  EXPECT_EQ(picture.at(1, 1)[2], 50);
  EXPECT_EQ(picture.at(2, 2)[0], 100);
}

TEST(CanvasTest, MarksMayLeaveThePicture) {
  Picture picture = blank_picture(20, 20, {0, 0, 0});
  draw_line(picture, {-50, 10}, {80, 10}, 1, kWhite);
  draw_line(picture, {10, -1e6}, {10, 1e6}, 1, kWhite);
  draw_arc(picture, {-100, 10}, 110, -3, 3, 1, kWhite);
  fill_rectangle(picture, {-5, -5}, {3, 3}, kWhite);
  EXPECT_EQ(picture.rgb.size(), 1200U);
  EXPECT_EQ(picture.at(0, 0)[0], 255);
}

}  // namespace
}  // namespace insonify::canvas_test
