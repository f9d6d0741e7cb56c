// view_parts_test.cpp -- parts of the camera view: camera, sector, housing and colours.

#include <gtest/gtest.h>

#include <cmath>

#include "view/camera.h"
#include "view/drawn_sonar.h"
#include "view/underwater_light.h"

namespace insonify::view_parts_test {
namespace {

constexpr double kExact = 1e-9;

TEST(CameraTest, RaysThroughAPointsImageMeetThePoint) {
  const Camera camera({.position = {3, -2, 5}, .look_at = {10, 4, 1}, .field_of_view = 1.1}, 640, 480);
  const Vec3 point(12, 3, 2);
  const Camera::Image image = camera.image_of(point);
  EXPECT_TRUE(camera.direction(image.x, image.y).isApprox((point - camera.position()).normalized(), kExact));
}

// Half a width of 400 pixels subtends half of 90 degrees: a point 45 degrees to the right is on the right border.
TEST(CameraTest, TheFieldOfViewIsThatOfTheWidth) {
  const Camera camera({.position = {0, 0, 0}, .look_at = {5, 0, 0}, .field_of_view = std::numbers::pi / 2}, 400, 300);
  const Camera::Image right = camera.image_of({10, -10, 0});
  EXPECT_NEAR(right.x, 400, kExact);
  EXPECT_NEAR(right.y, 150, kExact);
  EXPECT_NEAR(right.depth, 10, kExact);
  EXPECT_NEAR(camera.image_of({10, 0, 5}).y, 50, kExact);  // 5/10 of 200 pixels above the middle.
}

TEST(CameraTest, MayLookStraightDown) {
  const Camera camera({.position = {0, 0, 9}, .look_at = {0, 0, 0}, .field_of_view = 1}, 40, 40);
  EXPECT_TRUE(camera.direction(20, 20).isApprox(-Vec3::UnitZ(), kExact));
  EXPECT_LT(camera.image_of({1, 0, 0}).y, 20);  // x is up.
}

TEST(InsonifiedSectorTest, HoldsWhatTheFanHolds) {
  SonarConfig sonar;
  sonar.azimuth_aperture = radians_from_degrees(60);
  sonar.elevation_aperture = radians_from_degrees(20);
  sonar.elevation_center = radians_from_degrees(5);
  sonar.min_range = 1;
  sonar.max_range = 10;
  const InsonifiedSector sector(sonar, {.position = {100, 0, 0}});
  const auto inside_by = [&](double range, double azimuth_deg, double elevation_deg) {
    const Vec3 point =
        point_from_spherical({range, radians_from_degrees(azimuth_deg), radians_from_degrees(elevation_deg)});
    return degrees_from_radians(sector.inside_by(Vec3(100, 0, 0) + point));
  };
  EXPECT_NEAR(inside_by(5, 0, 5), 10, 1e-6);
  EXPECT_NEAR(inside_by(5, 28, 5), 2, 1e-6);
  EXPECT_NEAR(inside_by(5, -32, 5), -2, 1e-6);
  EXPECT_NEAR(inside_by(5, 0, -6), -1, 1e-6);
  EXPECT_LT(inside_by(0.9, 0, 5), 0);
  EXPECT_LT(inside_by(10.1, 0, 5), 0);
}

// A beam of 4 degrees turned from 50 to 110 degrees: from 48 to 112.
TEST(InsonifiedSectorTest, OfAScanningSonarIsAllThatItSweeps) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = radians_from_degrees(4);
  sonar.head.sector_center = radians_from_degrees(80);
  sonar.head.sector_width = radians_from_degrees(60);
  const InsonifiedSector sector(sonar, {});
  const auto inside_by = [&](double azimuth_deg) {
    return sector.inside_by(point_from_spherical({5, radians_from_degrees(azimuth_deg), 0}));
  };
  EXPECT_GT(inside_by(48.5), 0);
  EXPECT_LT(inside_by(47.5), 0);
  EXPECT_GT(inside_by(111.5), 0);
  EXPECT_LT(inside_by(112.5), 0);
  sonar.head.sector_width = 2 * std::numbers::pi;
  const InsonifiedSector whole(sonar, {});
  for (double azimuth_deg = -180; azimuth_deg <= 180; azimuth_deg += 7) {
    EXPECT_GT(whole.inside_by(point_from_spherical({5, radians_from_degrees(azimuth_deg), 0})), 0);
  }
}

// Beams of 1 x 50 degrees, 30 degrees down to either side.
TEST(InsonifiedSectorTest, OfASideScanSonarLooksAbeam) {
  SonarConfig sonar;
  sonar.type = SonarType::kSideScan;
  sonar.beam_count = 2;
  sonar.azimuth_aperture = radians_from_degrees(1);
  sonar.elevation_aperture = radians_from_degrees(50);
  sonar.depression = radians_from_degrees(30);
  const InsonifiedSector sector(sonar, {});
  const auto inside_by = [&](double azimuth_deg, double elevation_deg) {
    return degrees_from_radians(sector.inside_by(
        point_from_spherical({5, radians_from_degrees(azimuth_deg), radians_from_degrees(elevation_deg)})));
  };
  for (const double side : {90.0, -90.0}) {
    EXPECT_NEAR(inside_by(side, -30), 0.5, 1e-6);
    EXPECT_GT(inside_by(side, -54), 0);
    EXPECT_LT(inside_by(side, -56), 0);
    EXPECT_GT(inside_by(side, -6), 0);
    EXPECT_LT(inside_by(side, -4), 0);
    EXPECT_LT(inside_by(side + 1, -30), 0);
  }
  EXPECT_LT(inside_by(0, -30), 0);
  EXPECT_LT(sector.point_at(10, 0.25, 0.5).y(), -8);
  EXPECT_GT(sector.point_at(10, 0.75, 0.5).y(), 8);
}

// A cylinder of radius 0.5 along x, its front at the origin and 1.4 long.
TEST(HousingTest, RaysMeetItsFrontItsBackAndItsSide) {
  const Housing housing(SonarConfig{}, {}, 0.5);
  const Housing::Cut front = housing.cut({.origin = {5, 0.1, 0.2}, .direction = -Vec3::UnitX()});
  EXPECT_NEAR(front.distance, 5, kExact);
  EXPECT_TRUE(front.normal.isApprox(Vec3::UnitX(), kExact));
  EXPECT_TRUE(front.transducer);
  const Housing::Cut back = housing.cut({.origin = {-5, 0.1, 0.2}, .direction = Vec3::UnitX()});
  EXPECT_NEAR(back.distance, 3.6, kExact);
  EXPECT_FALSE(back.transducer);
  const Housing::Cut side = housing.cut({.origin = {-1, 3, 0}, .direction = -Vec3::UnitY()});
  EXPECT_NEAR(side.distance, 2.5, kExact);
  EXPECT_TRUE(side.normal.isApprox(Vec3::UnitY(), kExact));
  EXPECT_TRUE(std::isinf(housing.cut({.origin = {-1, 3, 0.6}, .direction = -Vec3::UnitY()}).distance));
}

TEST(UnderwaterLightTest, MaterialsLookDifferent) {
  const auto tint = [](const char* name, double density = 2500) { return tint_of({.name = name, .density = density}); };
  EXPECT_FALSE(tint("sand").isApprox(tint("steel"), 0.05F));
  EXPECT_FALSE(tint("yellow_steel").isApprox(tint("steel"), 0.1F));  // Painted.
  EXPECT_TRUE(tint("very_coarse_sand").isApprox(tint("sand")));
  EXPECT_TRUE(tint("sandy_gravel").isApprox(tint("gravel")));
  // Unknown names: always the same tint, different from each other, and dense materials darker than aluminium.
  EXPECT_TRUE(tint("hull", 7850).isApprox(tint("hull", 7850)));
  EXPECT_FALSE(tint("hull", 7850).isApprox(tint("deck", 7850), 0.02F));
  EXPECT_LT(tint("hull", 7850).sum(), tint("hull", 2700).sum());
}

TEST(UnderwaterLightTest, WaterIsBrighterTowardsTheSurface) {
  for (double rise = -1; rise < 0.99; rise += 0.05) {
    EXPECT_GT(water_colour({0, 0, rise + 0.05}).sum(), water_colour({0, 0, rise}).sum()) << rise;
  }
}

TEST(ValueNoiseTest, IsSmoothAndBounded) {
  for (int i = -500; i < 500; ++i) {
    const Vec3 point(0.31 * i, -0.17 * i, 0.05 * i);
    const float value = value_noise(point, 0.8);
    EXPECT_LE(std::abs(value), 1);
    EXPECT_NEAR(value_noise(point + Vec3(1e-6, 0, 0), 0.8), value, 1e-4);
  }
}

}  // namespace
}  // namespace insonify::view_parts_test
