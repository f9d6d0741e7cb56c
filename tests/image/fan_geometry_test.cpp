// fan_geometry_test.cpp -- conversion between pixels, ranges and azimuths, and the beam axis.

#include "image/fan_geometry.h"

#include <gtest/gtest.h>

namespace insonify::fan_geometry_test {
namespace {

// The worked example: 120 degrees, 50 m, 500 pixels high, 256 beams x 500 bins. W = 2 H sin(F/2) = 866, s = R/H = 0.1
// m, x = (H - (py + .5)) s, y = (px + .5 - W/2) s to starboard, r = hypot(x, y), th = atan2(y, x), beam = (th + F/2)/F
// N - .5, bin = r/R B - .5. The formula counts azimuth to starboard, the project to port.
constexpr double kExact = 1e-9;

struct Example {
  SonarConfig sonar;
  FanShape shape;
  Example() {
    sonar.azimuth_aperture = radians_from_degrees(120);
    sonar.beam_count = 256;
    sonar.bin_count = 500;
    sonar.min_range = 0;
    sonar.max_range = 50;
    shape = {-sonar.azimuth_aperture / 2, sonar.azimuth_aperture / 2, 0, 50, 0};
  }
};

TEST(FanGeometryTest, APlainFanIsAsWideAsItsAperture) {
  const BareFan fan = bare_fan(Example().shape, 500);
  EXPECT_EQ(fan.width, 866);
  EXPECT_EQ(fan.height, 500);
  EXPECT_NEAR(fan.geometry.apex.x, 433, kExact);
  EXPECT_NEAR(fan.geometry.apex.y, 500, kExact);
  EXPECT_NEAR(fan.geometry.metres_per_pixel, 0.1, kExact);
}

TEST(FanGeometryTest, PixelsShowThePublishedRangesAndBearings) {
  const FanGeometry geometry = bare_fan(Example().shape, 500).geometry;
  const FanGeometry::Place top = geometry.place_at(433, 0);
  EXPECT_NEAR(top.range, 49.95002502501876, kExact);
  const FanGeometry::Place left = geometry.place_at(100, 200);
  EXPECT_NEAR(left.range, 44.75002793295218, kExact);
  EXPECT_NEAR(degrees_from_radians(left.azimuth), 47.98899555325738, kExact);
}

TEST(FanGeometryTest, PixelsShowThePublishedBeams) {
  const Example example;
  const FanGeometry geometry = bare_fan(example.shape, 500).geometry;
  const BeamAxis axis(example.sonar);
  EXPECT_NEAR(axis.beam_at(geometry.place_at(433, 0).azimuth), 127.62235330877812, kExact);
  EXPECT_NEAR(axis.beam_at(geometry.place_at(100, 200).azimuth), 25.12347615305092, kExact);
}

TEST(FanGeometryTest, PlacesAndPointsAreInverse) {
  const FanGeometry geometry{{312.5, 401.25}, 0.037, 0.4};
  const FanGeometry::Place place = geometry.place_at(120, 77);
  const Point point = geometry.point_at(place.range, place.azimuth);
  EXPECT_NEAR(point.x, 120.5, kExact);
  EXPECT_NEAR(point.y, 77.5, kExact);
}

TEST(FanGeometryTest, PortIsLeftAndAheadIsUp) {
  const FanGeometry geometry{{100, 100}, 1, 0};
  EXPECT_LT(geometry.point_at(10, radians_from_degrees(30)).x, 100);
  EXPECT_LT(geometry.point_at(10, 0).y, 100);
  EXPECT_GT(geometry.point_at(10, radians_from_degrees(180)).y, 100);
}

// With up at 90 degrees, azimuth 0 points right: x = 100 + 10.
TEST(FanGeometryTest, AnotherDirectionMayPointUp) {
  const FanGeometry geometry{{100, 100}, 1, radians_from_degrees(90)};
  const Point ahead = geometry.point_at(10, 0);
  EXPECT_NEAR(ahead.x, 110, kExact);
  EXPECT_NEAR(ahead.y, 100, kExact);
}

// A quarter circle about straight left: it spans 1 across and 2 sin 45 = 1.414 along, and never up to 1.
TEST(FanGeometryTest, TheExtentOfASectorHoldsItsArcAndItsApex) {
  const FanExtent left = extent_of({radians_from_degrees(45), radians_from_degrees(135), 0, 20, 0});
  EXPECT_NEAR(left.left, -1, kExact);
  EXPECT_NEAR(left.right, 0, kExact);
  EXPECT_NEAR(left.top, std::sqrt(0.5), kExact);
  EXPECT_NEAR(left.bottom, -std::sqrt(0.5), kExact);

  // 270 degrees about straight ahead: to the sides 1, astern cos 135.
  const FanExtent wide = extent_of({radians_from_degrees(-135), radians_from_degrees(135), 0, 20, 0});
  EXPECT_NEAR(wide.left, -1, kExact);
  EXPECT_NEAR(wide.right, 1, kExact);
  EXPECT_NEAR(wide.top, 1, kExact);
  EXPECT_NEAR(wide.bottom, -std::sqrt(0.5), kExact);
}

TEST(FanGeometryTest, AFullCircleFillsASquare) {
  const BareFan fan = bare_fan({-std::numbers::pi, std::numbers::pi, 0.3, 20, 0}, 600);
  EXPECT_EQ(fan.width, 600);
  EXPECT_NEAR(fan.geometry.apex.x, 300, kExact);
  EXPECT_NEAR(fan.geometry.apex.y, 300, kExact);
}

// 20 degrees about straight left would be 1/(2 sin 10) = 2.9 times as wide as high: it is made smaller and put in the
// middle.
TEST(FanGeometryTest, AFlatSectorIsAtMostTwiceAsWideAsHigh) {
  const BareFan fan = bare_fan({radians_from_degrees(80), radians_from_degrees(100), 0, 20, 0}, 300);
  EXPECT_EQ(fan.width, 600);
  EXPECT_NEAR(fan.geometry.apex.y, 150, kExact);
}

TEST(FanGeometryTest, TheFullCircleHasNoEdge) {
  const FanShape whole{-std::numbers::pi, std::numbers::pi, 0, 1, 0};
  EXPECT_TRUE(whole.full_circle());
  const FanShape nearly{radians_from_degrees(-179), radians_from_degrees(179), 0, 1, 0};
  EXPECT_FALSE(nearly.full_circle());
  EXPECT_NEAR(degrees_from_radians(nearly.inside_by(radians_from_degrees(178))), 1, kExact);
  EXPECT_NEAR(degrees_from_radians(nearly.inside_by(radians_from_degrees(180))), -1, kExact);
}

// Centres 20, 5, -10, -20 degrees have edges 27.5, 12.5, -2.5, -15, -25.
TEST(BeamAxisTest, ATableIsLinearBetweenItsCentres) {
  SonarConfig sonar;
  sonar.beam_count = 4;
  for (const double degrees : {20, 5, -10, -20}) {
    sonar.beam_azimuths.push_back(radians_from_degrees(degrees));
  }
  const BeamAxis axis(sonar);
  const auto beam_at = [&](double degrees) { return axis.beam_at(radians_from_degrees(degrees)); };
  EXPECT_NEAR(degrees_from_radians(axis.port_edge()), 27.5, kExact);
  EXPECT_NEAR(degrees_from_radians(axis.starboard_edge()), -25, kExact);
  EXPECT_NEAR(beam_at(27.5), -0.5, kExact);
  EXPECT_NEAR(beam_at(23.75), -0.25, kExact);
  EXPECT_NEAR(beam_at(20), 0, kExact);
  EXPECT_NEAR(beam_at(12.5), 0.5, kExact);
  EXPECT_NEAR(beam_at(2), 1.2, kExact);
  EXPECT_NEAR(beam_at(-13), 2.3, kExact);
  EXPECT_NEAR(beam_at(-20), 3, kExact);
  EXPECT_NEAR(beam_at(-25), 3.5, kExact);
  EXPECT_NEAR(beam_at(40), -0.5, kExact);  // Beyond the edges: the edges.
  EXPECT_NEAR(beam_at(-40), 3.5, kExact);
}

TEST(BeamAxisTest, FallsFromBeamToBeamWhateverTheTable) {
  SonarConfig sonar;
  sonar.beam_count = 200;
  for (int beam = 0; beam < 200; ++beam) {  // Even in sine, as array sonars have it.
    sonar.beam_azimuths.push_back(std::asin(0.9 * (1 - 2 * (beam + 0.5) / 200)));
  }
  const BeamAxis axis(sonar);
  for (int beam = 0; beam < 200; ++beam) {
    EXPECT_NEAR(axis.beam_at(sonar.beam_azimuth(beam)), beam, kExact);
  }
}

}  // namespace
}  // namespace insonify::fan_geometry_test
