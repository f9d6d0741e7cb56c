// trajectory_test.cpp -- interpolation of poses along trajectories.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "insonify/scenario.h"
#include "support/message_of.h"

namespace insonify::trajectory_test {
namespace {

constexpr double kPoseTolerance = 1e-12;

Waypoint waypoint(double time, Vec3 position, double yaw_deg) {
  return {time, position, {0, 0, radians_from_degrees(yaw_deg)}};
}

double yaw_deg(const Pose& pose) {
  const Vec3 ahead = pose.orientation * Vec3::UnitX();
  return degrees_from_radians(std::atan2(ahead.y(), ahead.x()));
}

TEST(TrajectoryTest, WithoutWaypointsStandsAtTheOrigin) {
  EXPECT_EQ(Trajectory().at(3).position, Vec3::Zero());
  EXPECT_EQ(yaw_deg(Trajectory().at(3)), 0);
}

TEST(TrajectoryTest, MovesStraightAndTurnsEvenly) {
  const Trajectory trajectory{{waypoint(2, {0, 4, 0}, 0), waypoint(6, {8, 4, -2}, 80)}};
  // A quarter of the way: 1 s of 4 s.
  EXPECT_LT((trajectory.at(3).position - Vec3(2, 4, -0.5)).norm(), kPoseTolerance);
  EXPECT_NEAR(yaw_deg(trajectory.at(3)), 20, 1e-10);
  EXPECT_NEAR(yaw_deg(trajectory.at(5)), 60, 1e-10);
}

TEST(TrajectoryTest, TurnsTheShorterWay) {
  const Trajectory trajectory{{waypoint(0, {0, 0, 0}, 170), waypoint(1, {0, 0, 0}, -170)}};
  EXPECT_NEAR(std::abs(yaw_deg(trajectory.at(0.5))), 180, 1e-10);
  EXPECT_NEAR(yaw_deg(trajectory.at(0.25)), 175, 1e-10);
}

TEST(TrajectoryTest, StandsStillOutsideItsTimes) {
  const Trajectory trajectory{{waypoint(2, {1, 0, 0}, 10), waypoint(3, {2, 0, 0}, 20)}};
  EXPECT_EQ(trajectory.at(-5).position, Vec3(1, 0, 0));
  EXPECT_EQ(trajectory.at(2).position, Vec3(1, 0, 0));
  EXPECT_EQ(trajectory.at(3).position, Vec3(2, 0, 0));
  EXPECT_EQ(trajectory.at(99).position, Vec3(2, 0, 0));
  EXPECT_NEAR(yaw_deg(trajectory.at(99)), 20, 1e-10);
}

TEST(TrajectoryTest, RefusesTimesThatDoNotRise) {
  const Trajectory trajectory{{waypoint(2, {0, 0, 0}, 0), waypoint(1.5, {0, 0, 0}, 0)}};
  EXPECT_EQ(message_of([&] { trajectory.validate("trajectory"); }),
            "trajectory[1].time = 1.5 s must be greater than trajectory[0].time = 2 s");
}

TEST(TrajectoryTest, RefusesANotANumber) {
  const Trajectory trajectory{{waypoint(0, {0, NAN, 0}, 0)}};
  EXPECT_EQ(message_of([&] { trajectory.validate("motions[1].trajectory"); }),
            "motions[1].trajectory[0].position[1] = nan m must be from -10000000 to 10000000 m");
}

}  // namespace
}  // namespace insonify::trajectory_test
