// page_test.cpp -- ticks and caption of the colour bar.

#include "image/page.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insonify::page_test {
namespace {

void expect_ticks(const Display& display, const std::vector<std::pair<double, std::string>>& expected) {
  const std::vector<Page::Tick> ticks = Page(display, {}).bar_ticks(5);
  ASSERT_EQ(ticks.size(), expected.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_NEAR(ticks[i].level, expected[i].first, 1e-9) << i;
    EXPECT_EQ(ticks[i].text, expected[i].second);
  }
}

TEST(PageTest, BarOfLinearLevelsEndsAtFullScale) {
  const Display display{.full_scale = 2};
  EXPECT_EQ(Page(display, {}).bar_caption(), "echo intensity (0 to 2)");
  expect_ticks(display, {{0, "0"}, {0.25, "0.5"}, {0.5, "1"}, {0.75, "1.5"}, {1, "2"}});
}

TEST(PageTest, BarOfDecibelsIsReFullScale) {
  const Display display{.scale = Scale::kDecibel, .floor_db = -40, .full_scale = 0.01, .raised_per_decade = 20};
  EXPECT_EQ(Page(display, {}).bar_caption(), "dB re full scale, + 20 log r");
  expect_ticks(display, {{0, "−40"}, {0.25, "−30"}, {0.5, "−20"}, {0.75, "−10"}, {1, "0"}});
}

// The brightest at -65 dB, the darkest at -105.
TEST(PageTest, BarOfCalibratedLevelsIsReTheSource) {
  Display display{.scale = Scale::kDecibel, .floor_db = -40, .full_scale = std::pow(10, -6.5), .of_source = true};
  EXPECT_EQ(Page(display, {}).bar_caption(), "dB re source at 1 m");
  expect_ticks(display, {{0.125, "−100"}, {0.375, "−90"}, {0.625, "−80"}, {0.875, "−70"}});
  display.raised_per_decade = 30;
  EXPECT_EQ(Page(display, {}).bar_caption(), "dB re source at 1 m, + 30 log r");
}

}  // namespace
}  // namespace insonify::page_test
