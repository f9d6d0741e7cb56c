// draw_polar_test.cpp -- polar pictures: cells, averaging and refusals.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "insonify/picture.h"
#include "support/message_of.h"

namespace insonify::draw_polar_test {
namespace {

// 320 x 240 pixels bare: 16 beams are 20 pixels wide each, 24 bins 10 pixels high.
SonarConfig table_sonar() {
  SonarConfig sonar;
  sonar.name = "table";
  sonar.azimuth_aperture = radians_from_degrees(80);
  sonar.beam_count = 16;
  sonar.bin_count = 24;
  sonar.min_range = 1;
  sonar.max_range = 13;
  return sonar;
}

Display bare() {
  Display display;
  display.colour_map = ColourMap::kGrey;
  display.height = 240;
  display.annotations = false;
  return display;
}

Ping counting_ping(const SonarConfig& sonar) {
  Ping ping;
  ping.beam_count = sonar.beam_count;
  ping.bin_count = sonar.bin_count;
  for (int i = 0; i < ping.beam_count * ping.bin_count; ++i) {
    ping.intensity.push_back(static_cast<float>(i % 251) / 255.0F);
  }
  return ping;
}

TEST(DrawPolarTest, EveryCellIsAPlainRectangle) {
  const SonarConfig sonar = table_sonar();
  const Ping ping = counting_ping(sonar);
  const Picture picture = draw_polar(ping, sonar, bare());
  ASSERT_EQ(picture.width, 320);
  ASSERT_EQ(picture.height, 240);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      // Port (beam 0) is left, the nearest bin is below.
      const float expected = 255 * ping.intensity[ping.index((239 - y) / 10, x / 20)];
      EXPECT_NEAR(picture.at(x, y)[0], static_cast<double>(expected), 0.6) << x << ' ' << y;
    }
  }
}

TEST(DrawPolarTest, MoreCellsThanPixelsAreAveraged) {
  SonarConfig sonar = table_sonar();
  sonar.beam_count = 640;
  sonar.bin_count = 480;
  Ping ping = counting_ping(sonar);
  for (int bin = 0; bin < 480; ++bin) {
    for (int beam = 0; beam < 640; ++beam) {
      ping.intensity[ping.index(bin, beam)] = (bin + beam) % 2 == 0 ? 1.0F : 0.0F;
    }
  }
  const Picture picture = draw_polar(ping, sonar, bare());
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    EXPECT_NEAR(picture.rgb[i], 128, 1);
  }
}

TEST(DrawPolarTest, NaNIsDrawnAsZero) {
  const SonarConfig sonar = table_sonar();
  Ping ping = counting_ping(sonar);
  std::fill(ping.intensity.begin(), ping.intensity.end(), std::numeric_limits<float>::quiet_NaN());
  for (const std::uint8_t byte : draw_polar(ping, sonar, bare()).rgb) {
    EXPECT_EQ(byte, 0);
  }
}

TEST(DrawPolarTest, OneBeamAndOneBinFillThePicture) {
  SonarConfig sonar = table_sonar();
  sonar.beam_count = 1;
  sonar.bin_count = 1;
  Ping ping = counting_ping(sonar);
  ping.intensity[0] = 1;
  for (const std::uint8_t byte : draw_polar(ping, sonar, bare()).rgb) {
    EXPECT_EQ(byte, 255);
  }
}

TEST(DrawPolarTest, RefusesAPingOfAnotherSonar) {
  const SonarConfig sonar = table_sonar();
  Ping ping = counting_ping(sonar);
  ping.number = 2;
  ping.bin_count = 23;
  EXPECT_EQ(message_of([&] { (void)draw_polar(ping, sonar); }),
            "ping 2 of table has 16 beams x 23 bins, must have 16 x 24");
}

}  // namespace
}  // namespace insonify::draw_polar_test
