// waterfall_test.cpp -- rows and columns of a side-scan's pings on a picture.

#include "insonify/waterfall.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/message_of.h"
#include "survey/line.h"

namespace insonify::waterfall_test {
namespace {

// Both sides, 8 bins of 1 m.
SonarConfig small_sonar() {
  SonarConfig sonar = side_scan_sonar();
  sonar.bin_count = 8;
  sonar.max_range = 8;
  return sonar;
}

Display bare() {
  Display display;
  display.colour_map = ColourMap::kGrey;
  display.annotations = false;
  display.pixel_per_bin = true;
  return display;
}

Ping ping_at(const SonarConfig& sonar, int number, double x) {
  Ping ping = dark_ping(sonar, static_cast<std::uint64_t>(number));
  ping.time = 0.5 * number;
  ping.world_from_sonar.position.x() = x;
  return ping;
}

bool is_bright(const Picture& picture, int x, int y) {
  return picture.at(x, y)[0] > 128;
}

// Ping 0 has an echo in port bin 0, ping 1 in port bin 7, ping 2 in starboard bin 2: of 16 columns 7, 0 and 10.
TEST(WaterfallTest, PortIsLeftTheTrackInTheMiddleTheNewestOnTop) {
  const SonarConfig sonar = small_sonar();
  Waterfall waterfall(sonar);
  const int bins[] = {0, 7, 2}, beams[] = {0, 0, 1};
  for (int i = 0; i < 3; ++i) {
    Ping ping = ping_at(sonar, i, i);
    ping.intensity[ping.index(bins[i], beams[i])] = 1;
    waterfall.add(ping);
  }
  const Picture picture = waterfall.draw(bare());
  ASSERT_EQ(picture.width, 16);
  ASSERT_EQ(picture.height, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_EQ(is_bright(picture, x, y), (y == 2 && x == 7) || (y == 1 && x == 0) || (y == 0 && x == 10))
          << x << ' ' << y;
    }
  }
}

// Altitude 4 m: the echo between 5 and 6 m lies between 3 and 4.47 m on the bed, cells 3 and half of 4.
TEST(WaterfallTest, CorrectedRangesAreThoseOnTheBed) {
  const SonarConfig sonar = small_sonar();
  Waterfall waterfall(sonar, {.corrected = true, .altitudes = {4}});
  Ping ping = ping_at(sonar, 0, 0);
  ping.intensity[ping.index(5, 1)] = 1;
  waterfall.add(ping);
  const Picture picture = waterfall.draw(bare());
  EXPECT_TRUE(is_bright(picture, 8 + 3, 0));
  EXPECT_FALSE(is_bright(picture, 8 + 2, 0));
  EXPECT_NEAR(picture.at(8 + 4, 0)[0], 255 * (std::sqrt(20.0) - 4), 2);
  EXPECT_FALSE(is_bright(picture, 8 + 5, 0));
}

// 16 m across; 3 pings, 4 m apart, cover 12 m: of a picture of 320 x 240 pixels without annotations 240 rows are 12 m.
// With pings 2 m apart 6 m are 120 rows.
TEST(WaterfallTest, ToScaleHeightFollowsFromTheWay) {
  const SonarConfig sonar = small_sonar();
  Display display = bare();
  display.pixel_per_bin = false;
  display.height = 240;
  for (const double step : {4.0, 2.0}) {
    Waterfall waterfall(sonar, {.to_scale = true});
    for (int i = 0; i < 3; ++i) {
      waterfall.add(ping_at(sonar, i, i * step));
    }
    const Picture picture = waterfall.draw(display);
    EXPECT_EQ(picture.width, 320);
    EXPECT_EQ(picture.height, static_cast<int>(60 * step));
  }
}

// Bright pings 1 m apart, at 0 to 9 m and 60 to 69 m: in 70 m of 280 pixels, 4 a metre, the jump is empty.
TEST(WaterfallTest, ToScaleAJumpIsAGap) {
  const SonarConfig sonar = small_sonar();
  Display display = bare();
  display.pixel_per_bin = false;
  display.height = 240;
  for (const bool jumps : {true, false}) {
    Waterfall waterfall(sonar, {.to_scale = true, .along = AlongTrack::kDistance});
    for (int i = 0; i < (jumps ? 20 : 70); ++i) {
      Ping ping = ping_at(sonar, i, jumps && i >= 10 ? i + 50 : i);
      std::ranges::fill(ping.intensity, 1.0F);
      waterfall.add(ping);
    }
    const Picture picture = waterfall.draw(display);
    const int height = picture.height;
    const auto at = [&](double metres) {
      return is_bright(picture, 40, height - 1 - static_cast<int>(metres / 70 * height));
    };
    EXPECT_TRUE(at(5));
    EXPECT_TRUE(at(9.5));
    EXPECT_EQ(at(11), !jumps);
    EXPECT_EQ(at(35), !jumps);
    EXPECT_EQ(at(58), !jumps);
    EXPECT_TRUE(at(61));
    EXPECT_TRUE(at(66));
  }
}

TEST(WaterfallTest, KeepsTheLastPingsIfAsked) {
  const SonarConfig sonar = small_sonar();
  Waterfall waterfall(sonar, {}, 2);
  for (int i = 0; i < 5; ++i) {
    waterfall.add(ping_at(sonar, i, i));
  }
  EXPECT_EQ(waterfall.draw(bare()).height, 2);
}

TEST(WaterfallTest, TheProductOfASideScanIsItsWaterfall) {
  const SonarConfig sonar = small_sonar();
  ProductView view(sonar);
  Waterfall waterfall(sonar);
  for (int i = 0; i < 3; ++i) {
    const Ping ping = ping_at(sonar, i, i);
    view.add(ping);
    waterfall.add(ping);
  }
  EXPECT_EQ(view.draw().rgb, waterfall.draw().rgb);
}

TEST(WaterfallTest, BadInputIsRefused) {
  const SonarConfig sonar = small_sonar();
  EXPECT_EQ(message_of([&] { (void)Waterfall(sonar).draw(); }), "sss: a waterfall must have at least one ping");
  EXPECT_EQ(message_of([&] { (void)Waterfall(SonarConfig()); }),
            "sonar has 256 beams: a side-scan sonar must have one to port and one to starboard, or a single one that "
            "does not turn");
  Waterfall still(sonar, {.to_scale = true});
  still.add(ping_at(sonar, 0, 0));
  EXPECT_EQ(message_of([&] { (void)still.draw(); }), "sss: to scale needs a sonar that has moved along its track");
  Waterfall high(sonar, {.to_scale = true});
  high.add(ping_at(sonar, 0, 0));
  high.add(ping_at(sonar, 1, 1000));
  Display display = bare();
  display.pixel_per_bin = false;
  display.height = 240;
  EXPECT_EQ(message_of([&] { (void)high.draw(display); }),
            "the picture would be 40000 pixels high, to scale at a width of 320; the most is 8192");
  Waterfall below(sonar, {.corrected = true, .altitudes = {-1}});
  below.add(ping_at(sonar, 0, 0));
  EXPECT_EQ(message_of([&] { (void)below.draw(); }), "altitude = -1 m must be greater than 0 m");
}

}  // namespace
}  // namespace insonify::waterfall_test
