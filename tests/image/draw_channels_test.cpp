// draw_channels_test.cpp -- pixels of the panels of distance, intensity and both.

#include <gtest/gtest.h>

#include <limits>

#include "insonify/channels.h"
#include "support/message_of.h"

namespace insonify::draw_channels_test {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

// Left half at 5 of 10 m and an intensity of 0.4, right half open water.
Channels halves() {
  Channels channels{.columns = 2,
                    .rows = 1,
                    .port_edge = 1,
                    .starboard_edge = -1,
                    .upper_edge = 0.4,
                    .lower_edge = -0.4,
                    .distance = {},
                    .intensity = {}};
  channels.distance = {5, kNothing};
  channels.intensity = {0.4F, kNothing};  // Full scale is 0.5, the next round number.
  return channels;
}

SonarConfig ten_metres() {
  SonarConfig sonar;
  sonar.max_range = 10;
  return sonar;
}

std::array<int, 3> pixel(const Picture& picture, double x, double y) {
  const std::uint8_t* at = picture.at(static_cast<int>(x * picture.width), static_cast<int>(y * picture.height));
  return {at[0], at[1], at[2]};
}

TEST(DrawChannelsTest, PanelsShowDistanceIntensityAndBoth) {
  const Picture picture = draw_channels(halves(), ten_metres(), {.height = 300, .annotations = false});
  EXPECT_EQ(picture.width, 400);
  EXPECT_EQ(picture.height % 3, 0);
  const auto shown = [](ColourMap map, double level) {
    const Rgb rgb = colour(map, level);
    return std::array<int, 3>{rgb.red, rgb.green, rgb.blue};
  };
  EXPECT_EQ(pixel(picture, 0.25, 1.0 / 6), shown(ColourMap::kBlue, 0.5));
  EXPECT_EQ(pixel(picture, 0.25, 3.0 / 6), shown(ColourMap::kInferno, 0.8));
  EXPECT_EQ(pixel(picture, 0.25, 5.0 / 6), (std::array<int, 3>{0, 204, 128}));
  for (const double panel : {1.0, 3.0, 5.0}) {
    EXPECT_EQ(pixel(picture, 0.75, panel / 6), pixel(picture, 0.75, 1.0 / 6));  // Nothing: alike in all.
  }
}

TEST(DrawChannelsTest, IsAsHighAsAskedOrLess) {
  Channels channels = halves();
  channels.upper_edge = 3;  // Taller than it is wide.
  const Picture picture = draw_channels(channels, ten_metres(), {.height = 480});
  EXPECT_LE(picture.height, 480);
  EXPECT_GE(picture.height, 440);
  EXPECT_EQ(picture.width, 640);
}

TEST(DrawChannelsTest, RefusesChannelsWithoutValues) {
  Channels channels = halves();
  channels.intensity.clear();
  EXPECT_EQ(message_of([&] { static_cast<void>(draw_channels(channels, ten_metres())); }),
            "channels have 2 distances and 0 intensities for 2 columns x 1 rows");
}

}  // namespace
}  // namespace insonify::draw_channels_test
