// scan_view_test.cpp -- pictures of scanning sonars: slots, gaps, blending and orientation.

#include <gtest/gtest.h>

#include <cmath>

#include "image/colours.h"
#include "image/fan_geometry.h"
#include "image/scan_slots.h"
#include "insonify/error.h"
#include "insonify/picture.h"
#include "support/message_of.h"

namespace insonify::scan_view_test {
namespace {

constexpr double kFullCircle = 2 * std::numbers::pi;

SonarConfig scanner(double step_deg) {
  SonarConfig sonar;
  sonar.name = "scanner";
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.bin_count = 50;
  sonar.azimuth_aperture = radians_from_degrees(4);
  sonar.min_range = 0;
  sonar.max_range = 10;
  sonar.head.step = radians_from_degrees(step_deg);
  return sonar;
}

Ping ping_at(double head_deg, float intensity) {
  Ping ping;
  ping.beam_count = 1;
  ping.bin_count = 50;
  ping.head_angle = radians_from_degrees(head_deg);
  ping.intensity.assign(50, intensity);
  return ping;
}

Display bare() {
  Display display;
  display.colour_map = ColourMap::kGrey;
  display.height = 400;
  display.annotations = false;
  return display;
}

// What is drawn at 80 % of the range in a direction of the full circle.
const std::uint8_t* seen_at(const Picture& picture, double azimuth_deg, double up_deg = 0) {
  const FanGeometry geometry{{200, 200}, 10.0 / 200, radians_from_degrees(up_deg)};
  const Point point = geometry.point_at(8, radians_from_degrees(azimuth_deg));
  return picture.at(static_cast<int>(point.x), static_cast<int>(point.y));
}

bool is_blank(const std::uint8_t* pixel) {
  return pixel[0] == palette::kNotYetSeen.red && pixel[1] == palette::kNotYetSeen.green &&
         pixel[2] == palette::kNotYetSeen.blue;
}

TEST(ScanViewTest, FillsAsTheHeadTurns) {
  ScanView view(scanner(10));
  EXPECT_TRUE(is_blank(seen_at(view.draw(bare()), 0)));
  for (int ping = 0; ping < 36; ++ping) {
    view.add(ping_at(10 * ping, 0.5F));
    const Picture picture = view.draw(bare());
    for (int other = 0; other < 36; ++other) {
      if (other <= ping) {
        EXPECT_NEAR(seen_at(picture, 10 * other)[0], 127, 1) << ping << ' ' << other;
      } else {
        EXPECT_TRUE(is_blank(seen_at(picture, 10 * other))) << ping << ' ' << other;
      }
    }
  }
}

// Steps of 10 degrees about 40: from 35 to 45.
TEST(ScanViewTest, APingFillsItsOwnStep) {
  ScanView view(scanner(10));
  view.add(ping_at(40, 1));
  const Picture picture = view.draw(bare());
  for (const double azimuth : {36.0, 40.0, 44.0}) {
    EXPECT_EQ(seen_at(picture, azimuth)[0], 255) << azimuth;
  }
  for (const double azimuth : {33.0, 47.0, -40.0, 220.0}) {
    EXPECT_TRUE(is_blank(seen_at(picture, azimuth))) << azimuth;
  }
}

// A beam of 4 degrees fills steps of up to 12.
TEST(ScanViewTest, BetweenLongStepsThereAreGaps) {
  ScanView view(scanner(45));
  view.add(ping_at(0, 1));
  view.add(ping_at(45, 1));
  const Picture picture = view.draw(bare());
  for (const double azimuth : {-1.5, 0.0, 1.5, 43.5, 45.0, 46.5}) {
    EXPECT_EQ(seen_at(picture, azimuth)[0], 255) << azimuth;
  }
  for (const double azimuth : {-3.0, 3.0, 22.5, 42.0, 48.0}) {
    EXPECT_TRUE(is_blank(seen_at(picture, azimuth))) << azimuth;
  }
  ScanView filled(scanner(12));
  filled.add(ping_at(0, 1));
  EXPECT_EQ(seen_at(filled.draw(bare()), 5.5)[0], 255);
}

TEST(ScanViewTest, ALaterPingCoversAnEarlierOne) {
  ScanView view(scanner(-10));
  for (int ping = 0; ping < 36; ++ping) {
    view.add(ping_at(-10 * ping, 0.2F));
  }
  view.add(ping_at(-360, 0.8F));
  view.add(ping_at(-370, 0.8F));
  const Picture picture = view.draw(bare());
  EXPECT_NEAR(seen_at(picture, 0)[0], 0.8 * 255, 1);
  EXPECT_NEAR(seen_at(picture, -10)[0], 0.8 * 255, 1);
  EXPECT_NEAR(seen_at(picture, -20)[0], 0.2 * 255, 1);
}

// In 2 degrees off the middle of a step of 10, the next ping has a share of 0.2.
TEST(ScanViewTest, NeighboursInTimeAreBlended) {
  const ScanSlots slots({0, radians_from_degrees(10), radians_from_degrees(20)}, radians_from_degrees(10),
                        radians_from_degrees(10));
  const ScanSlots::Mix mix = slots.at(radians_from_degrees(12));
  EXPECT_EQ(mix.ping, 1);
  EXPECT_EQ(mix.neighbour, 2);
  EXPECT_NEAR(mix.share, 0.2, 0.005);  // A slot is 0.022 degrees wide.
  const ScanSlots::Mix outermost = slots.at(radians_from_degrees(23));
  EXPECT_EQ(outermost.ping, 2);
  EXPECT_EQ(outermost.neighbour, 2);
}

// Where the newest ping meets one of the last turn, the scene may have changed: no blending.
TEST(ScanViewTest, TurnsAreNotBlended) {
  std::vector<double> heads;
  for (int ping = 0; ping <= 36; ++ping) {
    heads.push_back(radians_from_degrees(10 * ping));
  }
  const ScanSlots slots(heads, radians_from_degrees(10), radians_from_degrees(10));
  const ScanSlots::Mix mix = slots.at(radians_from_degrees(4));
  EXPECT_EQ(mix.ping, 36);
  EXPECT_EQ(mix.neighbour, 36);
}

TEST(ScanViewTest, NoStepLeavesGaps) {
  for (const double step_deg : {0.225, 0.9, 1.8, 3.0, 7.2}) {
    std::vector<double> heads;
    for (double head = 0; head < 360; head += step_deg) {
      heads.push_back(radians_from_degrees(head));
    }
    const ScanSlots slots(heads, radians_from_degrees(step_deg), radians_from_degrees(step_deg));
    for (double azimuth = -180; azimuth < 180; azimuth += 0.0171) {
      EXPECT_GE(slots.at(radians_from_degrees(azimuth)).ping, 0) << step_deg << ' ' << azimuth;
    }
  }
}

TEST(ScanViewTest, PortIsLeftAndAheadIsUp) {
  ScanView view(scanner(10));
  view.add(ping_at(90, 1));
  const Picture picture = view.draw(bare());
  EXPECT_EQ(picture.at(40, 200)[0], 255);
  EXPECT_TRUE(is_blank(picture.at(360, 200)));
  EXPECT_TRUE(is_blank(picture.at(200, 40)));
}

// A vertical mounting turns port up: the head at 90 degrees looks up and is drawn up; at 0 it looks ahead, drawn to the
// right.
TEST(ScanViewTest, AVerticalScanHasUpUp) {
  SonarConfig sonar = scanner(10);
  sonar.head.mounting = Mounting::kVertical;
  const Vec3 port = sonar.vehicle_from_sonar().orientation * Vec3::UnitY();
  EXPECT_NEAR(port.z(), 1, 1e-12);
  ScanView view(sonar);
  view.add(ping_at(90, 0.5F));
  view.add(ping_at(0, 1));
  const Picture picture = view.draw(bare());
  EXPECT_NEAR(picture.at(200, 40)[0], 127, 1);
  EXPECT_EQ(picture.at(360, 200)[0], 255);
  EXPECT_TRUE(is_blank(picture.at(40, 200)));
}

TEST(ScanViewTest, TheWaterfallRunsFromPortToStarboard) {
  SonarConfig sonar = scanner(10);
  sonar.head.sector_width = radians_from_degrees(90);  // 100 degrees with the half steps at its ends, 533 pixels wide.
  ScanView view(sonar);
  view.add(ping_at(45, 0.25F));
  view.add(ping_at(35, 0.5F));
  const Picture picture = view.draw_polar(bare());
  ASSERT_EQ(picture.width, 533);
  EXPECT_NEAR(picture.at(26, 200)[0], 0.25 * 255, 1);
  EXPECT_NEAR(picture.at(80, 200)[0], 0.5 * 255, 1);
  EXPECT_TRUE(is_blank(picture.at(133, 200)));
  EXPECT_TRUE(is_blank(picture.at(520, 200)));
}

TEST(ScanViewTest, ABinLiesAtItsRange) {
  ScanView view(scanner(10));
  Ping ping = ping_at(0, 0);
  ping.intensity[30] = 1;  // 6.1 m of 10: 122 of 200 pixels above the middle.
  view.add(ping);
  const Picture picture = view.draw(bare());
  int brightest = 0;
  for (int y = 0; y < 200; ++y) {
    brightest = picture.at(200, y)[0] > picture.at(200, brightest)[0] ? y : brightest;
  }
  EXPECT_NEAR(200 - (brightest + 0.5), 122, 2);
}

TEST(ScanViewTest, RefusesSonarsThatDoNotScan) {
  SonarConfig fan = scanner(10);
  fan.beam_count = 4;
  EXPECT_EQ(message_of([&] { ScanView view(fan); }),
            "scanner turns 4 beams by 10 deg: a scan view must have one beam that turns");
  EXPECT_EQ(message_of([&] { ScanView view(scanner(0)); }),
            "scanner turns 1 beam by 0 deg: a scan view must have one beam that turns");
}

TEST(ScanViewTest, RefusesPingsOfAnotherSonar) {
  ScanView view(scanner(10));
  Ping ping = ping_at(0, 0);
  ping.bin_count = 49;
  EXPECT_EQ(message_of([&] { view.add(ping); }), "ping 0 of scanner has 1 beam x 49 bins, must have 1 x 50");
  ping = ping_at(0, 0);
  ping.head_angle = std::nan("");
  EXPECT_EQ(message_of([&] { view.add(ping); }), "ping 0 of scanner has head_angle = nan rad, must be a finite number");
  EXPECT_TRUE(is_blank(seen_at(view.draw(bare()), 0)));
}

}  // namespace
}  // namespace insonify::scan_view_test
