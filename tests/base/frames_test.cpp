// frames_test.cpp -- spherical coordinates, orientations and poses.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/rotation_between.h"
#include "insonify/geometry.h"
#include "support/relative.h"

namespace insonify::frames_test {
namespace {

constexpr double kRounding = 1e-15;

struct Seen {
  double x, y, z;
  double range, azimuth_deg, elevation_deg;
};

// atan2 in double precision, independently of this code; the third is 3-4-5 with its azimuth beyond 90 degrees, where
// atan(y/x) gives -36.87.
constexpr Seen kSeen[] = {
    {10, 2, 1, 10.246950765959598, 11.309932474020213, 5.600409184816617},
    {10, -3, -1, 10.488088481701515, -16.69924423399362, -5.47124945343343},
    {5, 5, -2, 7.3484692283495345, 45, -15.793169048263962},
    {-4, 3, 1, 5.0990195135927845, 143.13010235415598, 11.309932474020213},
    {10, 0, 0.001, 10.00000005, 0, 0.005729577932209639},
};

class SphericalTest : public testing::TestWithParam<Seen> {};

TEST_P(SphericalTest, IsRangeAzimuthAndElevationOfAPoint) {
  const Seen seen = GetParam();
  const Spherical spherical = spherical_from_point({seen.x, seen.y, seen.z});
  EXPECT_THAT(spherical.range, RelativelyNear(seen.range));
  EXPECT_THAT(degrees_from_radians(spherical.azimuth), RelativelyNear(seen.azimuth_deg));
  EXPECT_THAT(degrees_from_radians(spherical.elevation), RelativelyNear(seen.elevation_deg));
}

TEST_P(SphericalTest, LeadsBackToThePoint) {
  const Vec3 point(GetParam().x, GetParam().y, GetParam().z);
  EXPECT_LE((point_from_spherical(spherical_from_point(point)) - point).norm(), 8 * kRounding * point.norm());
}

INSTANTIATE_TEST_SUITE_P(Points, SphericalTest, testing::ValuesIn(kSeen));

TEST(SphericalAxesTest, AzimuthGrowsToPortAndElevationUp) {
  EXPECT_DOUBLE_EQ(degrees_from_radians(spherical_from_point({0, 7, 0}).azimuth), 90);
  EXPECT_DOUBLE_EQ(degrees_from_radians(spherical_from_point({0, 0, 7}).elevation), 90);
}

TEST(SphericalAxesTest, TheOriginIsAtZeros) {
  const Spherical origin = spherical_from_point(Vec3::Zero());
  EXPECT_EQ(origin.range, 0);
  EXPECT_EQ(origin.azimuth, 0);
  EXPECT_EQ(origin.elevation, 0);
}

// A wall across x = 10 m is 10/cos(azimuth) away.
TEST(SphericalAxesTest, AWallAcrossTheAxisRecedesToTheSides) {
  const auto range_at = [](double azimuth_deg) {
    return spherical_from_point({10, 10 * std::tan(radians_from_degrees(azimuth_deg)), 0}).range;
  };
  EXPECT_THAT(range_at(20), RelativelyNear(10.641777724759121));
  EXPECT_THAT(range_at(40), RelativelyNear(13.054072893322786));
  EXPECT_THAT(range_at(50), RelativelyNear(15.557238268604122));
}

TEST(OrientationTest, PositivePitchLooksDown) {
  const Vec3 ahead = orientation_from_rpy(0, radians_from_degrees(30), 0) * Vec3::UnitX();
  EXPECT_NEAR(ahead.z(), -0.5, kRounding);
}

// Roll 90 takes y to z; pitch 90 then takes z to x; yaw 90 then takes x to y: so y comes back to y.
TEST(OrientationTest, RollsThenPitchesThenYawsAboutFixedAxes) {
  const double quarter = radians_from_degrees(90);
  EXPECT_LE((orientation_from_rpy(quarter, quarter, quarter) * Vec3::UnitY() - Vec3::UnitY()).norm(), 4 * kRounding);
}

TEST(PoseTest, InnerFrameIsPlacedInTheOuter) {
  const Pose world_from_vehicle{{1, 2, 3}, orientation_from_rpy(0, 0, radians_from_degrees(90))};
  const Pose vehicle_from_sonar{{4, 0, 0}, orientation_from_rpy(0, 0, radians_from_degrees(-90))};
  const Pose world_from_sonar = world_from_vehicle * vehicle_from_sonar;
  EXPECT_LE((world_from_sonar * Vec3(5, 6, 7) - Vec3(6, 12, 10)).norm(), 16 * kRounding);
}

// All around, straight up and down included, where roll and yaw turn about the same axis.
TEST(OrientationTest, AnglesOfAnOrientationGiveItAgain) {
  const double right = std::numbers::pi / 2;
  for (const double pitch : {-right, -1.2, -1e-9, 0.0, 0.4, right - 1e-8, right}) {
    for (int i = -8; i <= 8; ++i) {
      const auto given = orientation_from_rpy(0.39 * i, pitch, 0.17 * i * i - 3);
      const Vec3 rpy = rpy_from_orientation(given);
      const Eigen::Quaterniond again = orientation_from_rpy(rpy.x(), rpy.y(), rpy.z());
      EXPECT_LE((again.toRotationMatrix() - given.toRotationMatrix()).norm(), 16 * kRounding) << pitch << " " << i;
    }
  }
  EXPECT_LE((rpy_from_orientation(orientation_from_rpy(0.1, -0.2, 3)) - Vec3(0.1, -0.2, 3)).norm(), 16 * kRounding);
}

TEST(PoseTest, InverseUndoesIt) {
  const Pose pose{{1, -2, 3}, orientation_from_rpy(0.3, -0.7, 2.1)};
  const Vec3 point(4, 5, -6);
  EXPECT_LE((pose.inverse() * (pose * point) - point).norm(), 16 * kRounding);
}

TEST(RotationBetweenTest, TurnsOneToTheOtherTheShortWay) {
  for (const Vec3& from : {Vec3(1, 0, 0), Vec3(0.2, -3, 0.5), Vec3(0, 0, -1e-3)}) {
    for (const Vec3& to : {Vec3(1, 2, 3), Vec3(-0.2, 3, -0.3), Vec3(-2, 0, 0), Vec3(0.4, -6, 1), Vec3(0, 0, 7)}) {
      const Eigen::Quaterniond turn = rotation_between(from, to);
      EXPECT_LE((turn * from.normalized() - to.normalized()).norm(), 1e-11)
          << from.transpose() << " " << to.transpose();
      EXPECT_NEAR(2 * std::acos(std::min(1.0, turn.w())), std::atan2(from.cross(to).norm(), from.dot(to)), 1e-7);
    }
  }
}

// Opposite directions leave the axis open: half a turn about some normal.
TEST(RotationBetweenTest, HalfATurnBetweenOpposites) {
  for (const Vec3& from : {Vec3(0, 0, 1), Vec3(1, 2, -3), Vec3(-1e5, 0, 0)}) {
    const Eigen::Quaterniond turn = rotation_between(from, -2 * from);
    EXPECT_EQ(turn.w(), 0);
    EXPECT_NEAR(turn.norm(), 1, kRounding);
    EXPECT_LE((turn * from.normalized() + from.normalized()).norm(), 4 * kRounding);
  }
}

}  // namespace
}  // namespace insonify::frames_test
