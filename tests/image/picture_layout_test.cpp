// picture_layout_test.cpp -- labels do not overlap and are not cut off, for any sonar and picture size.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/colours.h"
#include "image/fan_frame.h"
#include "image/plot.h"
#include "image/scales.h"
#include "insonify/picture.h"

namespace insonify::picture_layout_test {
namespace {

constexpr int kHeights[] = {240, 321, 480, 720, 1100, 2000};
constexpr double kApertures[] = {3, 14.4, 30, 45, 60, 90, 120, 130, 179, 180, 200, 270, 310, 350, 359, 360};  // [deg]

SonarConfig sonar_of(double aperture_deg, double max_range) {
  SonarConfig sonar;
  sonar.model = "Sound Metrics ARIS Explorer 3000";
  sonar.frequency = 1.8e6;
  sonar.azimuth_aperture = radians_from_degrees(aperture_deg);
  sonar.beam_count = 8;
  sonar.bin_count = 10;
  sonar.max_range = max_range;
  return sonar;
}

Ping ping_of(const SonarConfig& sonar) {
  Ping ping;
  ping.number = 12345;
  ping.time = 2469.13;
  ping.beam_count = sonar.beam_count;
  ping.bin_count = sonar.bin_count;
  ping.intensity.assign(static_cast<std::size_t>(ping.beam_count) * ping.bin_count, 0.3F);
  return ping;
}

bool touch(const FanLabel& a, const FanLabel& b) {
  return std::abs(a.middle.x - b.middle.x) < (a.width + b.width) / 2 &&
         std::abs(a.middle.y - b.middle.y) < (a.height + b.height) / 2;
}

// Anything but background in the outermost `margin` pixels?
bool margin_is_free(const Picture& picture, int margin) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const bool inside = x >= margin && y >= margin && x < picture.width - margin && y < picture.height - margin;
      const std::uint8_t* pixel = picture.at(x, y);
      if (!inside && (pixel[0] != palette::kBackground.red || pixel[1] != palette::kBackground.green ||
                      pixel[2] != palette::kBackground.blue)) {
        return false;
      }
    }
  }
  return true;
}

FanShape shape_of(const SonarConfig& sonar) {
  return {-sonar.azimuth_aperture / 2, sonar.azimuth_aperture / 2, sonar.min_range, sonar.max_range, 0};
}

TEST(PictureLayoutTest, LabelsTouchNeitherEachOtherNorTheFanNorTheBorder) {
  for (const int height : kHeights) {
    for (const double aperture : kApertures) {
      const SonarConfig sonar = sonar_of(aperture, 35);
      const FanShape shape = shape_of(sonar);
      const FanMarks marks = marks_of(shape, shape.low, shape.high, Mounting::kHorizontal);
      Page page({.height = height}, heading_of(sonar, "ping 3", 0.2));
      const FanLayout layout = lay_out_fan(shape, marks, page, height);
      for (std::size_t i = 0; i < layout.labels.size(); ++i) {
        const FanLabel& label = layout.labels[i];
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_FALSE(touch(label, layout.labels[j])) << height << ' ' << aperture << ' ' << label.text;
        }
        EXPECT_GE(label.middle.x - label.width / 2, page.margin() - 1)
            << height << ' ' << aperture << ' ' << label.text;
        EXPECT_LE(label.middle.x + label.width / 2, layout.width - page.bar_width());
        EXPECT_GE(label.middle.y - label.height / 2, page.title_height());
        EXPECT_LE(label.middle.y + label.height / 2, height - page.margin() + 1);
        for (const double x : {-0.5, 0.0, 0.5}) {
          for (const double y : {-0.5, 0.0, 0.5}) {
            const FanGeometry::Place place =
                layout.geometry.place_at(static_cast<int>(label.middle.x + x * label.width),
                                         static_cast<int>(label.middle.y + y * label.height));
            const bool on_fan = place.range < shape.max_range &&
                                place.range * std::sin(std::min(1.0, shape.inside_by(place.azimuth))) > 0;
            EXPECT_TRUE(label.over_echoes || !on_fan) << height << ' ' << aperture << ' ' << label.text;
          }
        }
      }
    }
  }
}

std::vector<std::string> labels_of(const SonarConfig& sonar, int height = 720) {
  const FanShape shape = shape_of(sonar);
  const FanMarks marks = marks_of(shape, shape.low, shape.high, Mounting::kHorizontal);
  Page page({.height = height}, heading_of(sonar, "ping 3", 0.2));
  std::vector<std::string> found;
  for (const FanLabel& label : lay_out_fan(shape, marks, page, height).labels) {
    found.push_back(label.text);
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(PictureLayoutTest, FansHaveTheirMainLabels) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(labels_of(sonar_of(120, 50)), (Texts{"0°", "10 m", "20 m", "20° P", "20° S", "30 m", "40 m", "40° P",
                                                 "40° S", "50 m", "60° P", "60° S"}));
  EXPECT_EQ(labels_of(sonar_of(30, 10)),
            (Texts{"0°", "10 m", "10° P", "10° S", "15° P", "15° S", "2 m", "4 m", "5° P", "5° S", "6 m", "8 m"}));
  EXPECT_EQ(labels_of(sonar_of(45, 75)),
            (Texts{"0°", "10° P", "10° S", "20 m", "22.5° P", "22.5° S", "40 m", "60 m", "75 m"}));
  EXPECT_EQ(labels_of(sonar_of(360, 20)), (Texts{"0°", "10 m", "120° P", "120° S", "15 m", "150° P", "150° S", "180°",
                                                 "20 m", "30° P", "30° S", "5 m", "60° P", "60° S", "90° P", "90° S"}));
}

TEST(PictureLayoutTest, EveryFanLabelsItsEnds) {
  for (const int height : kHeights) {
    for (const double aperture : kApertures) {
      const std::vector<std::string> labels = labels_of(sonar_of(aperture, 35), height);
      EXPECT_THAT(labels, testing::IsSupersetOf({"0°", "35 m"})) << height << ' ' << aperture;
      if (aperture < 354) {
        const double edge = radians_from_degrees(aperture / 2);
        EXPECT_THAT(labels, testing::IsSupersetOf({bearing_text(edge), bearing_text(-edge)}))
            << height << ' ' << aperture;
      } else {
        EXPECT_THAT(labels, testing::Contains("180°")) << height << ' ' << aperture;
      }
    }
  }
}

// A window of 10 m has rings every 2 m, wherever it begins; there is room for the names of some.
TEST(PictureLayoutTest, RingsFollowTheWindowOfRanges) {
  SonarConfig sonar = sonar_of(60, 100);
  sonar.min_range = 90;
  EXPECT_THAT(labels_of(sonar), testing::IsSupersetOf({"90 m", "92 m", "96 m", "100 m"}));
}

// Between full scale, which is nearly white, and silence, which is nearly black.
TEST(PictureLayoutTest, RingsShowOnAnyEchoes) {
  const SonarConfig sonar = sonar_of(120, 50);
  const FanShape shape = shape_of(sonar);
  const FanMarks marks = marks_of(shape, shape.low, shape.high, Mounting::kHorizontal);
  Page page({}, heading_of(sonar, "ping 12345", 2469.13));
  const FanGeometry geometry = lay_out_fan(shape, marks, page, 720).geometry;
  for (const float intensity : {0.0F, 0.3F, 0.6F, 1.0F}) {
    Ping ping = ping_of(sonar);
    std::ranges::fill(ping.intensity, intensity);
    const Picture picture = draw_fan(ping, sonar);
    const Point ring = geometry.point_at(30, radians_from_degrees(10));
    int darkest = 3 * 255, brightest = 0;
    for (int y = -4; y <= 4; ++y) {
      const std::uint8_t* pixel = picture.at(static_cast<int>(ring.x), static_cast<int>(ring.y) + y);
      const int light = pixel[0] + pixel[1] + pixel[2];
      darkest = std::min(darkest, light);
      brightest = std::max(brightest, light);
    }
    EXPECT_GE(brightest - darkest, 3 * 25) << intensity;  // A tenth of what there is.
  }
}

// The 0 in the middle of the axis is written where only every third angle has room.
TEST(PictureLayoutTest, AxesKeepTheirZero) {
  SonarConfig sonar = sonar_of(3, 20);
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.head.step = radians_from_degrees(1.8);
  ScanView view(sonar);
  view.add(ping_of(sonar));
  const Picture picture = view.draw_polar({.height = 240});
  Page page({.height = 240}, heading_of(sonar, "1 ping", 2469.13));
  const PlotAxes axes{{}, range_ticks(sonar), "head angle", "range (m)"};
  const PlotLayout plot = lay_out_plot(axes, page, 240);
  int bright = 0;
  for (int y = plot.bottom + 6; y < plot.bottom + 14; ++y) {
    for (int x = (plot.left + plot.right) / 2 - 4; x < (plot.left + plot.right) / 2 + 4; ++x) {
      bright += picture.at(x, y)[0] > 100 ? 1 : 0;
    }
  }
  EXPECT_GT(bright, 8);
}

TEST(PictureLayoutTest, NothingIsCutOffAtTheBorders) {
  for (const int height : {240, 300, 720}) {
    for (const double aperture : {3.0, 30.0, 120.0, 360.0}) {
      const SonarConfig sonar = sonar_of(aperture, 120);
      const Ping ping = ping_of(sonar);
      const Display display{.scale = height == 300 ? Scale::kDecibel : Scale::kLinear, .height = height};
      const Picture fan = draw_fan(ping, sonar, display);
      EXPECT_EQ(fan.height, height);
      EXPECT_TRUE(margin_is_free(fan, 3)) << height << ' ' << aperture;
      EXPECT_TRUE(margin_is_free(draw_polar(ping, sonar, display), 3)) << height << ' ' << aperture;
    }
  }
}

TEST(PictureLayoutTest, LongNamesAreShortened) {
  SonarConfig sonar = sonar_of(60, 20);
  sonar.model = std::string(300, 'W');
  const Picture picture = draw_fan(ping_of(sonar), sonar, {.height = 300});
  EXPECT_LT(picture.width, 600);
  EXPECT_TRUE(margin_is_free(picture, 3));
}

TEST(PictureLayoutTest, ScansFitToo) {
  SonarConfig sonar = sonar_of(3, 20);
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.head.step = radians_from_degrees(5);
  for (const int height : {240, 400}) {
    for (const double width_deg : {10.0, 60.0, 200.0, 360.0}) {
      for (const double center_deg : {0.0, 90.0, -170.0}) {
        for (const Mounting mounting : {Mounting::kHorizontal, Mounting::kVertical}) {
          sonar.head.sector_width = radians_from_degrees(width_deg);
          sonar.head.sector_center = radians_from_degrees(center_deg);
          sonar.head.mounting = mounting;
          ScanView view(sonar);
          Ping ping = ping_of(sonar);
          ping.head_angle = sonar.head.sector_center;
          view.add(ping);
          ping.head_angle =
              sonar.head.sector_center + sonar.head.sector_width;  // Where no head of this sonar can look.
          view.add(ping);
          EXPECT_TRUE(margin_is_free(view.draw({.height = height}), 3))
              << height << ' ' << width_deg << ' ' << center_deg;
          EXPECT_TRUE(margin_is_free(view.draw_polar({.height = height}), 3))
              << height << ' ' << width_deg << ' ' << center_deg;
        }
      }
    }
  }
}

}  // namespace
}  // namespace insonify::picture_layout_test
