// survey_plan_test.cpp -- numbers and picture of a plan; patterns in files and in simulators.

#include "insonify/survey_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "pattern/pattern_scenes.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::survey_plan_test {
namespace {

using testing_surveys::flat_scene;
using testing_surveys::survey_scenario;
using testing_surveys::three_lines;

TEST(SurveyPlanTest, HasTheNumbersOfTheFlight) {
  const SurveyPlan plan = plan_survey(survey_scenario(three_lines()), flat_scene());
  ASSERT_EQ(plan.lines.size(), 3U);
  EXPECT_EQ(plan.line_length, 300);
  EXPECT_NEAR(plan.length, 300 + 10 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(plan.duration, 150 + 5 * std::numbers::pi, 1e-9);
  EXPECT_EQ(plan.spacing, 10);
  EXPECT_NEAR(plan.steepest, 0, 1e-9);
  // Line 2 comes back on y = 0, after a turn of 2.5 pi s.
  EXPECT_NEAR((plan.lines[1].begin - PlanPoint(50, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((plan.lines[1].end - PlanPoint(-50, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR(plan.lines[1].begin_time, 50 + 2.5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(plan.lines[1].end_time, 100 + 2.5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(plan.lines[1].least_altitude, 5, 1e-5);
  EXPECT_NEAR(plan.lines[1].most_altitude, 5, 1e-5);
  ASSERT_EQ(plan.sonars.size(), 1U);
  EXPECT_EQ(plan.sonars[0].pings, 332U);
  EXPECT_EQ(plan.sonars[0].ping_distance, 1);  // 0.5 s at 2 m/s.
}

TEST(SurveyPlanTest, SonarThatLooksAheadHasNoSwath) {
  const SurveyPlan plan = plan_survey(survey_scenario(three_lines()), flat_scene());
  EXPECT_EQ(plan.swath_sonar, -1);
  EXPECT_FALSE(plan.sonars[0].least_swath);
  EXPECT_FALSE(plan.sonars[0].covered);
  EXPECT_TRUE(plan.lines[0].half_swath.empty());
}

// A side-scan sonar that reaches 13 m: at 5 m above the bed 12 m to either side.
Scenario side_scan_scenario() {
  Scenario scenario = survey_scenario(three_lines());
  scenario.sonars[0].name = "sss";
  scenario.sonars[0].type = SonarType::kSideScan;
  scenario.sonars[0].beam_count = 2;
  scenario.sonars[0].azimuth_aperture = radians_from_degrees(1);
  scenario.sonars[0].max_range = 13;
  return scenario;
}

TEST(SurveyPlanTest, SwathIsTheGroundRangeOnBothSides) {
  const SurveyPlan plan = plan_survey(side_scan_scenario(), flat_scene());
  const PlannedSonar& sonar = plan.sonars[0];
  EXPECT_EQ(plan.swath_sonar, 0);
  EXPECT_NEAR(*sonar.least_swath, 24, 1e-4);
  EXPECT_NEAR(*sonar.most_swath, 24, 1e-4);
  EXPECT_NEAR(*sonar.overlap, 1 - 10.0 / 24, 1e-5);  // 10 m apart.
  EXPECT_EQ(*sonar.covered, 1);
}

// A multibeam of 100 degrees: at 5 m above the bed 5 tan(50 deg) to either side, or as far as its range reaches.
TEST(SurveyPlanTest, SwathOfAMultibeamEndsWithItsOutermostBeams) {
  Scenario scenario = survey_scenario(three_lines());
  SonarConfig& sonar = scenario.sonars[0];
  sonar.type = SonarType::kMultibeam;
  sonar.beam_count = 50;
  sonar.azimuth_aperture = radians_from_degrees(100);
  sonar.elevation_aperture = radians_from_degrees(2);
  sonar.max_range = 13;
  const double wide = 10 * std::tan(radians_from_degrees(50));
  const SurveyPlan plan = plan_survey(scenario, flat_scene());
  EXPECT_EQ(plan.swath_sonar, 0);
  EXPECT_NEAR(*plan.sonars[0].least_swath, wide, 1e-3);
  EXPECT_NEAR(*plan.sonars[0].overlap, 1 - 10 / wide, 1e-4);
  sonar.max_range = 6;
  EXPECT_NEAR(*plan_survey(scenario, flat_scene()).sonars[0].most_swath, 2 * std::sqrt(11), 1e-3);
}

TEST(SurveyPlanTest, SpacingFollowsFromTheOverlap) {
  Scenario scenario = side_scan_scenario();
  scenario.pattern->lines.spacing.reset();
  scenario.pattern->lines.overlap = 0.25;
  scenario.pattern->lines.width = 60;
  const SurveyPlan plan = plan_survey(scenario, flat_scene());
  EXPECT_NEAR(plan.spacing, 18, 1e-9);  // 0.75 x 24 m.
  EXPECT_EQ(plan.lines.size(), 4U);     // 60/18 = 3.3.
  EXPECT_NEAR(*plan.sonars[0].overlap, 0.25, 1e-5);
}

TEST(SurveyPlanTest, CountsWhatNoSwathCovers) {
  // 40 m apart over 120 m with swaths of 24 m: three fifths.
  Scenario scenario = side_scan_scenario();
  scenario.pattern->lines.spacing = 40;
  scenario.pattern->lines.width = 120;
  const SurveyPlan plan = plan_survey(scenario, flat_scene());
  EXPECT_NEAR(*plan.sonars[0].covered, 0.6, 1e-9);
  EXPECT_NEAR(*plan.sonars[0].overlap, 1 - 40.0 / 24, 1e-5);
}

TEST(SurveyPlanTest, SwathNarrowsWithTheAltitude) {
  // At a constant height 5 m above the bed where x < 0, and 12 m where x > 1: 12 and 5 m to either side.
  Scenario scenario = side_scan_scenario();
  scenario.pattern->lines.altitude.reset();
  scenario.pattern->lines.height = -15;
  const SurveyPlan plan =
      plan_survey(scenario, testing_surveys::bed_scene(150, [](double x, double) { return x < 0.5 ? -20 : -27; }));
  EXPECT_NEAR(*plan.sonars[0].least_swath, 10, 1e-3);
  EXPECT_NEAR(*plan.sonars[0].most_swath, 24, 1e-3);
  EXPECT_NEAR(plan.lines[1].half_swath.front(), 5, 1e-3);  // Line 2 begins at x = 50.
  EXPECT_NEAR(plan.lines[1].half_swath.back(), 12, 1e-3);
}

TEST(SurveyPlanTest, RefusesAnAltitudeBeyondTheRange) {
  Scenario scenario = side_scan_scenario();
  scenario.pattern->lines.spacing.reset();
  scenario.pattern->lines.overlap = 0.25;
  scenario.pattern->lines.altitude = 14;
  EXPECT_EQ(message_of([&] { (void)plan_survey(scenario, flat_scene()); }),
            "pattern.lines.altitude = 14 m leaves sss no swath: its max_range is 13 m");
}

TEST(SurveyPlanTest, NeedsAPattern) {
  Scenario scenario = survey_scenario(three_lines());
  scenario.pattern.reset();
  EXPECT_EQ(message_of([&] { (void)plan_survey(scenario, flat_scene()); }), "pattern is missing: the survey to plan");
}

TEST(SurveyPlanTest, PictureShowsTheLinesWhereTheyAre) {
  const SurveyPlan plan = plan_survey(survey_scenario(three_lines()), flat_scene());
  const Picture picture = draw_survey_plan(plan, 600);
  EXPECT_EQ(picture.height, 600);
  // Rows of the track's yellow across the middle of the picture: three lines, 10 m apart at one scale.
  std::vector<double> rows;
  for (int y = 0; y < picture.height; ++y) {
    const std::uint8_t* pixel = picture.at(picture.width / 2 - 20, y);
    if (pixel[0] > 180 && pixel[1] > 140 && pixel[2] < 130) {
      if (rows.empty() || y > rows.back() + 4) {
        rows.push_back(y);
      }
    }
  }
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_NEAR(rows[2] - rows[1], rows[1] - rows[0], 1.5);
}

TEST(SurveyPlanTest, SimulatorFliesThePattern) {
  Scenario scenario = survey_scenario(three_lines());
  scenario.sonars[0].beam_count = 8;
  scenario.sonars[0].bin_count = 50;
  Simulator simulator(scenario, flat_scene(-20, 80));
  EXPECT_FALSE(simulator.scenario().pattern);
  const Ping ping = simulator.make_ping(0, 50);  // At 25 s, in the middle of line 1.
  EXPECT_NEAR((ping.world_from_sonar.position - Vec3(0, -10, -15)).norm(), 0, 2e-3);
  // A simulator of its scenario flies the same.
  EXPECT_EQ(flown(simulator.scenario(), Scene()).trajectory.waypoints.size(),
            simulator.scenario().trajectory.waypoints.size());
}

class PatternFileTest : public testing::Test {
 protected:
  Scenario load(const std::string& pattern, const std::vector<std::string>& settings = {}) const {
    folder_.write("survey.yaml",
                  "points: [{position: [5, 0, 0], target_strength_db: 0}]\n"
                  "sonars: [{name: fls}]\n" +
                      pattern);
    return load_scenario("survey.yaml", settings);
  }

  WorkingFolder folder_;
};

TEST_F(PatternFileTest, IsReadAndWrittenAgain) {
  const Scenario scenario = load(
      "pattern:\n  lines: {corner: [3, 4], length: 50, width: 20, yaw_deg: 45, height: -7, spacing: 4, turns: skip}\n"
      "  motion_noise: {roll_deg: 2, heave: 0.1, spectrum: swell, period: 7}\n");
  ASSERT_TRUE(scenario.pattern);
  EXPECT_EQ(scenario.pattern->lines.corner, (std::vector<double>{3, 4}));
  EXPECT_EQ(scenario.pattern->lines.turns, TurnPings::kSkip);
  EXPECT_EQ(scenario.pattern->motion_noise->spectrum, MotionSpectrum::kSwell);
  const Scenario again = parse_scenario(to_yaml(scenario));
  EXPECT_EQ(to_yaml(again), to_yaml(scenario));
  EXPECT_EQ(again.pattern->lines.height, -7);
  // The trajectory of the pattern can be written too, with its spans.
  const Scenario ready = flown(scenario, Scene());
  const Scenario read = parse_scenario(to_yaml(ready));
  EXPECT_EQ(read.trajectory.waypoints.size(), ready.trajectory.waypoints.size());
  EXPECT_EQ(read.ping_spans.size(), 5U);
  EXPECT_EQ(ScenarioRequests(read).ping_count(0), ScenarioRequests(ready).ping_count(0));
}

TEST_F(PatternFileTest, FliesAllUnlessPingsAreGivenAlsoOfOne) {
  const std::string pattern = "pattern: {lines: {center: [0, 0], length: 50, height: -7}}\n";
  EXPECT_TRUE(flown(load(pattern), Scene()).duration);
  EXPECT_FALSE(flown(load(pattern + "pings: 1\n"), Scene()).duration);
  EXPECT_FALSE(flown(load(pattern, {"--pings=1"}), Scene()).duration);
}

TEST_F(PatternFileTest, WarnsOfGapsBetweenLines) {
  folder_.write("gaps.yaml",
                "points: [{position: [5, 0, 0], target_strength_db: 0}]\n"
                "sonars: [{name: sss, type: sss, azimuth_aperture_deg: 1, max_range: 13}]\n"
                "pattern: {lines: {center: [0, 0], width: 90, altitude: 5, spacing: 30}}\n");
  std::string warnings;
  (void)load_scenario("gaps.yaml", {}, [&](Severity, const std::string& text) { warnings += text; });
  EXPECT_NE(warnings.find("gaps.yaml:3:59: pattern.lines.spacing = 30 m is more than the swath of sss, 24 m at this "
                          "altitude: there are gaps between lines"),
            std::string::npos)
      << warnings;
}

TEST_F(PatternFileTest, ErrorsSayWhere) {
  const auto refused = [&](const std::string& pattern) { return message_of([&] { (void)load(pattern); }); };
  EXPECT_EQ(refused("pattern:\n  lines: {centre: [0, 0]}\n"),
            "survey.yaml:4:11: pattern.lines.centre is not a known key; did you mean center?");
  EXPECT_EQ(refused("pattern:\n  lines: {center: [0, 0], altitude: 0}\n"),
            "survey.yaml:4:27: pattern.lines.altitude = 0 m must be greater than 0, at most 100000 m");
  EXPECT_EQ(refused("pattern: {}\n"), "survey.yaml:3:1: pattern.lines must have center or corner: where the area is");
  EXPECT_EQ(refused("trajectory: [{time: 0}]\npattern: {lines: {center: [0, 0], height: 1}}\n"),
            "survey.yaml:4:1: pattern and trajectory both move the vehicle; leave one out");
  const Scenario scenario = load("pattern:\n  lines: {center: [0, 0], altitude: 3}\n");
  EXPECT_EQ(message_of([&] { (void)flown(scenario, Scene()); }),
            "survey.yaml:4:3: pattern.lines: line 1 leaves the terrain at x = -50 m, y = 0 m");
}

}  // namespace
}  // namespace insonify::survey_plan_test
