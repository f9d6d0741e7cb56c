// draw_fan_test.cpp -- fan pictures: geometry, interpolation, levels and refusals.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/colours.h"
#include "image/fan_frame.h"
#include "image/fan_geometry.h"
#include "insonify/error.h"
#include "insonify/picture.h"
#include "support/message_of.h"

namespace insonify::draw_fan_test {
namespace {

SonarConfig small_sonar() {
  SonarConfig sonar;
  sonar.name = "test";
  sonar.azimuth_aperture = radians_from_degrees(100);
  sonar.beam_count = 20;
  sonar.bin_count = 30;
  sonar.min_range = 2;
  sonar.max_range = 17;
  return sonar;
}

FanShape shape_of(const SonarConfig& sonar) {
  const std::vector<double> edges = sonar.bearings().edges();
  return {edges.back(), edges.front(), sonar.min_range, sonar.max_range, 0};
}

Ping silent_ping(const SonarConfig& sonar) {
  Ping ping;
  ping.number = 7;
  ping.time = 1.25;
  ping.beam_count = sonar.beam_count;
  ping.bin_count = sonar.bin_count;
  ping.intensity.assign(static_cast<std::size_t>(ping.beam_count) * ping.bin_count, 0.0F);
  return ping;
}

// Grey levels and no annotations, so that a byte is an intensity.
Display bare(int height = 400) {
  Display display;
  display.colour_map = ColourMap::kGrey;
  display.height = height;
  display.annotations = false;
  return display;
}

bool is_background(const std::uint8_t* pixel) {
  return pixel[0] == palette::kBackground.red && pixel[1] == palette::kBackground.green &&
         pixel[2] == palette::kBackground.blue;
}

struct Spot {
  int x = 0, y = 0, level = -1;
};
Spot brightest(const Picture& picture) {
  Spot spot;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.at(x, y)[0] > spot.level) {
        spot = {x, y, picture.at(x, y)[0]};
      }
    }
  }
  return spot;
}

TEST(DrawFanTest, ACellIsBrightestAtItsOwnRangeAndAzimuth) {
  const SonarConfig sonar = small_sonar();
  const FanGeometry geometry = bare_fan(shape_of(sonar), 400).geometry;
  for (const int beam : {0, 3, 10, 19}) {
    for (const int bin : {0, 11, 29}) {
      Ping ping = silent_ping(sonar);
      ping.intensity[ping.index(bin, beam)] = 1;
      const Spot spot = brightest(draw_fan(ping, sonar, bare()));
      const FanGeometry::Place place = geometry.place_at(spot.x, spot.y);
      EXPECT_NEAR(place.range, sonar.bin_range(bin), 0.5 * sonar.bin_length()) << beam << ' ' << bin;
      EXPECT_NEAR(place.azimuth, sonar.beam_azimuth(beam), 0.5 * sonar.azimuth_aperture / 20) << beam << ' ' << bin;
    }
  }
}

TEST(DrawFanTest, PortIsLeft) {
  const SonarConfig sonar = small_sonar();
  Ping ping = silent_ping(sonar);
  ping.intensity[ping.index(15, 2)] = 1;  // Beam 0 is furthest to port.
  const Picture picture = draw_fan(ping, sonar, bare());
  EXPECT_LT(brightest(picture).x, 0.3 * picture.width);  // 9.75 sin 37.5 of 17 m, from the middle.
}

// Intensity b/19 x r/29 in beam b and bin r: bilinear interpolation gives that product at fractional places too.
TEST(DrawFanTest, IsBilinearBetweenCells) {
  const SonarConfig sonar = small_sonar();
  Ping ping = silent_ping(sonar);
  for (int bin = 0; bin < 30; ++bin) {
    for (int beam = 0; beam < 20; ++beam) {
      ping.intensity[ping.index(bin, beam)] = static_cast<float>(beam * bin / (19.0 * 29.0));
    }
  }
  const Picture picture = draw_fan(ping, sonar, bare());
  const FanGeometry geometry = bare_fan(shape_of(sonar), 400).geometry;
  int compared = 0;
  for (int y = 0; y < 400; y += 7) {
    for (int x = 0; x < picture.width; x += 7) {
      const FanGeometry::Place place = geometry.place_at(x, y);
      const double bin = (place.range - sonar.min_range) / sonar.bin_length() - 0.5;
      const double beam = (sonar.azimuth_aperture / 2 - place.azimuth) / sonar.azimuth_aperture * 20 - 0.5;
      if (bin > 0.1 && bin < 28.9 && beam > 0.1 && beam < 18.9) {
        EXPECT_NEAR(picture.at(x, y)[0], 255 * beam * bin / (19 * 29), 1) << x << ' ' << y;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(DrawFanTest, OutsideOfTheFanThereIsOnlyBackground) {
  const SonarConfig sonar = small_sonar();
  Ping ping = silent_ping(sonar);
  std::fill(ping.intensity.begin(), ping.intensity.end(), 1.0F);
  const Picture picture = draw_fan(ping, sonar, bare());
  const FanShape shape = shape_of(sonar);
  const FanGeometry geometry = bare_fan(shape, 400).geometry;
  const double pixel = geometry.metres_per_pixel;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto [range, azimuth] = geometry.place_at(x, y);
      const double aside = range * std::sin(std::abs(azimuth) - sonar.azimuth_aperture / 2);
      if (range > sonar.max_range + pixel || range < sonar.min_range - pixel || aside > pixel) {
        EXPECT_TRUE(is_background(picture.at(x, y))) << x << ' ' << y;
      } else if (range < sonar.max_range - pixel && range > sonar.min_range + pixel && aside < -pixel) {
        EXPECT_EQ(picture.at(x, y)[0], 255) << x << ' ' << y;
      }
    }
  }
}

TEST(DrawFanTest, NaNIsDrawnAsZero) {
  const SonarConfig sonar = small_sonar();
  Ping ping = silent_ping(sonar);
  const Picture silence = draw_fan(ping, sonar, bare());
  std::fill(ping.intensity.begin(), ping.intensity.end(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(draw_fan(ping, sonar, bare()).rgb, silence.rgb);
  std::fill(ping.intensity.begin(), ping.intensity.end(), -1.0F);
  EXPECT_EQ(draw_fan(ping, sonar, bare()).rgb, silence.rgb);
}

// The level in the middle of a fan of one intensity.
int level_of(double intensity, const Display& display) {
  const SonarConfig sonar = small_sonar();
  Ping ping = silent_ping(sonar);
  std::fill(ping.intensity.begin(), ping.intensity.end(), static_cast<float>(intensity));
  const Picture picture = draw_fan(ping, sonar, display);
  return picture.at(picture.width / 2, picture.height / 2)[0];
}

TEST(DrawFanTest, LinearLevelsAreSharesOfFullScale) {
  Display display = bare(240);
  EXPECT_NEAR(level_of(0.25, display), 64, 1);
  EXPECT_EQ(level_of(1.5, display), 255);
  display.full_scale = 0.5;
  EXPECT_NEAR(level_of(0.25, display), 128, 1);
}

// 0.01 of full scale is -20 dB: with a floor of -40 dB half way up. Intensity goes with 10 log10.
TEST(DrawFanTest, DecibelLevelsRiseFromTheFloor) {
  Display display = bare(240);
  display.scale = Scale::kDecibel;
  display.floor_db = -40;
  EXPECT_NEAR(level_of(0.01, display), 127.5, 1);
  EXPECT_NEAR(level_of(0.1, display), 0.75 * 255, 1);
  EXPECT_EQ(level_of(1, display), 255);
  EXPECT_EQ(level_of(1e-4, display), 0);
  EXPECT_EQ(level_of(1e-9, display), 0);
  EXPECT_EQ(level_of(0, display), 0);
  display.full_scale = 10;
  EXPECT_NEAR(level_of(1, display), 0.75 * 255, 1);
}

// Bins of which several meet in a pixel are averaged: single bright bins cannot flicker in and out of sight.
TEST(DrawFanTest, SmallPicturesShowTheMeanOfManyBins) {
  SonarConfig sonar = small_sonar();
  sonar.bin_count = 720;  // Three to a pixel.
  Ping ping = silent_ping(sonar);
  for (int bin = 0; bin < 720; bin += 2) {
    for (int beam = 0; beam < 20; ++beam) {
      ping.intensity[ping.index(bin, beam)] = 1;
    }
  }
  const Picture picture = draw_fan(ping, sonar, bare(240));
  for (int y = 20; y < 180; ++y) {
    EXPECT_NEAR(picture.at(picture.width / 2, y)[0], 127, 45) << y;
  }
}

// Beams at both ends of a full circle are neighbours: halfway between them is the mean of both.
TEST(DrawFanTest, AFullCircleClosesAstern) {
  SonarConfig sonar = small_sonar();
  sonar.azimuth_aperture = 2 * std::numbers::pi;
  Ping ping = silent_ping(sonar);
  for (int bin = 0; bin < 30; ++bin) {
    ping.intensity[ping.index(bin, 0)] = 0.2F;
    ping.intensity[ping.index(bin, 19)] = 0.6F;
  }
  const Picture picture = draw_fan(ping, sonar, bare());
  EXPECT_EQ(picture.width, 400);
  EXPECT_NEAR(picture.at(200, 390)[0], 0.4 * 255, 3);
  EXPECT_NEAR(picture.at(199, 390)[0], 0.4 * 255, 3);
}

TEST(DrawFanTest, BeamTablesAreDrawnWhereTheBeamsPoint) {
  SonarConfig sonar = small_sonar();
  sonar.beam_count = 5;
  for (const double degrees : {50, 20, 5, -5, -30}) {
    sonar.beam_azimuths.push_back(radians_from_degrees(degrees));
  }
  const FanGeometry geometry = bare_fan(shape_of(sonar), 400).geometry;
  for (int beam = 0; beam < 5; ++beam) {
    Ping ping = silent_ping(sonar);
    ping.intensity[ping.index(20, beam)] = 1;
    const Spot spot = brightest(draw_fan(ping, sonar, bare()));
    // On the outermost half beams there is nothing to interpolate with: all of them are as bright.
    const double tolerance = beam == 0 || beam == 4 ? radians_from_degrees(16) : radians_from_degrees(0.5);
    EXPECT_NEAR(geometry.place_at(spot.x, spot.y).azimuth, sonar.beam_azimuth(beam), tolerance);
  }
}

TEST(DrawFanTest, BareFansHaveTheHeightAskedFor) {
  const SonarConfig sonar = small_sonar();
  const Picture picture = draw_fan(silent_ping(sonar), sonar, bare(333));
  EXPECT_EQ(picture.height, 333);
  EXPECT_EQ(picture.width, 510);  // 2 x 333 x sin 50 = 510.19
  EXPECT_EQ(picture.rgb.size(), 3U * 333 * 510);
}

TEST(DrawFanTest, RefusesPingsOfAnotherShape) {
  const SonarConfig sonar = small_sonar();
  Ping ping = silent_ping(sonar);
  ping.beam_count = 19;
  EXPECT_EQ(message_of([&] { (void)draw_fan(ping, sonar); }),
            "ping 7 of test has 19 beams x 30 bins, must have 20 x 30");
  ping = silent_ping(sonar);
  ping.intensity.pop_back();
  EXPECT_EQ(message_of([&] { (void)draw_fan(ping, sonar); }), "ping 7 of test has 599 intensities, must have 600");
}

TEST(DrawFanTest, RefusesDisplaysOutOfLimits) {
  const SonarConfig sonar = small_sonar();
  const Ping ping = silent_ping(sonar);
  const auto message = [&](const Display& display) {
    return message_of([&] { (void)draw_fan(ping, sonar, display); });
  };
  EXPECT_EQ(message({.height = 239}), "display.height = 239 pixels must be from 240 to 8192 pixels");
  EXPECT_EQ(message({.floor_db = 0}), "display.floor_db = 0 dB must be less than 0 dB");
  EXPECT_EQ(message({.full_scale = 0}), "display.full_scale = 0 must be greater than 0");
  EXPECT_EQ(message({.full_scale = std::nan("")}), "display.full_scale = nan must be greater than 0");
}

}  // namespace
}  // namespace insonify::draw_fan_test
