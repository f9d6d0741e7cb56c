// lettering_test.cpp -- size, position and shortening of text.

#include "image/lettering.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace insonify::lettering_test {
namespace {

struct Bounds {
  int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;  // Bounds of the pixels that are not black; inclusive.
};

Bounds bounds_of(const Picture& picture) {
  Bounds bounds;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.at(x, y)[0] > 0) {
        bounds = {std::min(bounds.left, x), std::min(bounds.top, y), std::max(bounds.right, x),
                  std::max(bounds.bottom, y)};
      }
    }
  }
  return bounds;
}

TEST(LetteringTest, TextCoversWhatItWasMeasuredToCover) {
  for (const int size : {9, 14, 41, 120}) {
    const Lettering lettering(size);
    Picture picture = blank_picture(1600, 300, {0, 0, 0});
    lettering.draw(picture, {800, 150}, "H0 720 kHz 8H", {{255, 255, 255}, 1});
    const Bounds bounds = bounds_of(picture);
    const double width = lettering.width("H0 720 kHz 8H");
    // Letters have some room at their sides, and pixels at their borders are partly covered.
    EXPECT_NEAR(bounds.left, 800 - width / 2, 0.12 * size + 1);
    EXPECT_NEAR(bounds.right, 800 + width / 2, 0.12 * size + 1);
    EXPECT_NEAR(bounds.top, 150 - lettering.height() / 2, 0.05 * size + 1.5);
    EXPECT_NEAR(bounds.bottom, 150 + lettering.height() / 2, 0.05 * size + 1.5);
  }
}

TEST(LetteringTest, AnchorsHoldTheStartTheMiddleOrTheEnd) {
  const Lettering lettering(20);
  Picture start = blank_picture(300, 60, {0, 0, 0});
  lettering.draw(start, {150, 30}, "mmm", {}, Anchor::kStart);
  EXPECT_GE(bounds_of(start).left, 149);
  Picture end = blank_picture(300, 60, {0, 0, 0});
  lettering.draw(end, {150, 30}, "mmm", {}, Anchor::kEnd);
  EXPECT_LE(bounds_of(end).right, 150);
}

TEST(LetteringTest, UpwardTextIsTheSameTurnedLeft) {
  const Lettering lettering(24);
  Picture across = blank_picture(200, 200, {0, 0, 0});
  Picture upwards = blank_picture(200, 200, {0, 0, 0});
  lettering.draw(across, {20, 100}, "Echo 5", {}, Anchor::kStart);
  lettering.draw_upwards(upwards, {100, 180}, "Echo 5", {}, Anchor::kStart);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      EXPECT_EQ(across.at(x, y)[0], upwards.at(y, 199 - x)[0]) << x << ' ' << y;
    }
  }
}

TEST(LetteringTest, ReadsUtf8) {
  const Lettering lettering(20);
  EXPECT_NEAR(lettering.width("30°"), lettering.width("30") + lettering.width("°"), 0.5);
  EXPECT_GT(lettering.width("Ölüm 深"), lettering.width("Ol"));
  // A byte that cannot be is one strange sign, and no reason to stop.
  EXPECT_GT(lettering.width("a\xffz"), lettering.width("az"));
  EXPECT_GT(lettering.width("a\xe2\x82"), lettering.width("a"));
  EXPECT_EQ(lettering.width(""), 0);
}

TEST(LetteringTest, ShortensWhatDoesNotFit) {
  const Lettering lettering(20);
  const std::string name = "a sonar with a name of some lengthß°";
  EXPECT_EQ(lettering.shortened(name, 1000), name);
  for (double limit = 30; limit < lettering.width(name); limit += 7) {
    const std::string shortened = lettering.shortened(name, limit);
    EXPECT_LE(lettering.width(shortened), limit);
    EXPECT_TRUE(shortened.ends_with("…")) << shortened;
    EXPECT_EQ(name.substr(0, shortened.size() - 3), shortened.substr(0, shortened.size() - 3));
  }
  EXPECT_EQ(lettering.shortened(name, 3), "");
}

TEST(LetteringTest, TextThatLeavesThePictureIsCutOff) {
  const Lettering lettering(20);
  Picture picture = blank_picture(30, 10, {0, 0, 0});
  lettering.draw(picture, {0, 0}, "wide text", {});
  lettering.draw_upwards(picture, {30, 10}, "wide text", {});
  lettering.draw_rimmed(picture, {15, 5}, "wide text", {});
  EXPECT_EQ(picture.rgb.size(), 900U);
}

TEST(LetteringTest, LettersThatTheFontLacksAreShownByTheirNumbers) {
  const Lettering lettering(20);
  EXPECT_DOUBLE_EQ(lettering.width("声纳 A"), lettering.width("\\u58f0\\u7eb3 A"));
}

}  // namespace
}  // namespace insonify::lettering_test
