// survey_path_test.cpp -- lines over an area, and turns between them, against lengths worked out by hand.

#include "pattern/survey_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pattern/pattern_scenes.h"

namespace insonify::survey_path_test {
namespace {

using testing_surveys::three_lines;

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 1e-9;  // Rounding over paths of a kilometre [m].

TEST(SurveyPathTest, HasALineForEachBegunSpacing) {
  const SurveyLines lines{.width = 60};
  EXPECT_EQ(line_count(lines, 12), 5);  // 60/12 = 5.
  EXPECT_EQ(line_count(lines, 11), 6);  // 60/11 = 5.45.
  EXPECT_EQ(line_count(lines, 100), 1);
  EXPECT_EQ(line_count({.width = 0.3}, 0.1), 3);  // 0.3/0.1 is a little more than 3 in binary.
  EXPECT_EQ(line_count({.width = 0}, 12), 1);
}

TEST(SurveyPathTest, CentresTheLinesOnTheArea) {
  // 25 m wide, 10 m apart: 3 lines, at -10, 0 and 10 m to port of the centre.
  const SurveyPath path = survey_path({.center = {100, 50}, .length = 40, .width = 25, .yaw = 0, .altitude = 5}, 10);
  ASSERT_EQ(path.line_count, 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(path.line(i).y, 40 + 10 * i, kExact);
    EXPECT_NEAR(path.line(i).x, i == 1 ? 120 : 80, kExact);  // To and fro.
    EXPECT_NEAR(path.line(i).length, 40, kExact);
  }
}

TEST(SurveyPathTest, CornerIsBesideTheStartOfTheFirstLineAndTheAreaToPort) {
  // Along y (yaw 90 deg), port is -x: lines at x = 7 - 2 and 7 - 6.
  const SurveyPath path = survey_path({.corner = {7, -3}, .length = 40, .width = 8, .yaw = kPi / 2}, 4);
  ASSERT_EQ(path.line_count, 2);
  EXPECT_NEAR(path.line(0).x, 5, kExact);
  EXPECT_NEAR(path.line(0).y, -3, kExact);
  EXPECT_NEAR(path.line(1).x, 1, kExact);
  EXPECT_NEAR(path.line(1).y, 37, kExact);
}

TEST(SurveyPathTest, LengthIsThatOfLinesRunInsAndTurns) {
  SurveyLines lines = three_lines().lines;
  // By default half circles of radius 5: 3 x 100 + 2 x 5 pi.
  EXPECT_NEAR(survey_path(lines, 10).length(), 300 + 10 * kPi, kExact);
  // Quarter circles of 2 m and 6 m between them; run-ins before and after each line.
  lines.turn_radius = 2;
  lines.run_in = 3;
  EXPECT_NEAR(survey_path(lines, 10).length(), 300 + 6 * 3 + 2 * (2 * kPi + 6), kExact);
  // r = 10 > 5: cos a = (20 + 10)/40, a = 0.722734248; r (pi + 4 a) = 60.3252965.
  lines.turn_radius = 10;
  EXPECT_NEAR(turn_length(10, 10), 60.3252965, 1e-6);
  EXPECT_NEAR(survey_path(lines, 10).length(), 300 + 18 + 2 * 60.3252965, 1e-5);
}

TEST(SurveyPathTest, TurnsLeadToTheNextLineWhateverTheirRadius) {
  for (const double radius : {1.0, 4.0, 5.0, 5.5, 12.0, 80.0}) {
    SurveyLines lines = three_lines().lines;
    lines.yaw = 0.4;
    lines.turn_radius = radius;
    const SurveyPath path = survey_path(lines, 10);
    const Eigen::Vector2d port(-std::sin(0.4), std::cos(0.4));
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(Eigen::Vector2d(path.line(i).x, path.line(i).y).dot(port), -10 + 10 * i, 1e-7) << radius;
      EXPECT_NEAR(path.line(i).yaw, 0.4 + (i == 1 ? kPi : 0), 1e-9) << radius;
    }
  }
}

TEST(SurveyPathTest, IsContinuousAndBendsNoMoreThanTheTurns) {
  SurveyLines lines = three_lines().lines;
  lines.turn_radius = 8;
  const SurveyPath path = survey_path(lines, 10);
  SurveyPath::Station last = path.at(0);
  constexpr double kStep = 0.01;
  for (double distance = kStep; distance < path.length(); distance += kStep) {
    const SurveyPath::Station here = path.at(distance);
    ASSERT_LT(std::hypot(here.x - last.x, here.y - last.y), kStep * (1 + 1e-9));
    ASSERT_LT(std::abs(here.yaw - last.yaw), kStep / 8 + 1e-9);
    last = here;
  }
}

}  // namespace
}  // namespace insonify::survey_path_test
