// survey_flight_test.cpp -- terrain following over planes and steps, trajectories, and what is refused.

#include "pattern/survey_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "insonify/error.h"
#include "insonify/scenario_requests.h"
#include "pattern/pattern_scenes.h"
#include "support/message_of.h"

namespace insonify::survey_flight_test {
namespace {

using testing_surveys::bed_scene;
using testing_surveys::flat_scene;
using testing_surveys::survey_scenario;
using testing_surveys::three_lines;

constexpr double kTolerance = 1.1e-3;  // Of interpolation between waypoints [m].

TEST(SurveyFlightTest, KeepsItsAltitudeAboveATiltedPlane) {
  // 6 degrees up along x: the vehicle climbs as steeply, with its nose up.
  const double slope = std::tan(radians_from_degrees(6));
  const Scenario scenario =
      flown(survey_scenario(three_lines()), bed_scene(150, [&](double x, double) { return -20 + slope * x; }));
  for (double time = 1; time < 49; time += 0.37) {  // Line 1, 50 s long.
    const Pose pose = scenario.trajectory.at(time);
    EXPECT_NEAR(pose.position.z() - (-20 + slope * pose.position.x()), 5, kTolerance) << time;
    EXPECT_NEAR(rpy_from_orientation(pose.orientation).y(), -radians_from_degrees(6), 2e-4);
  }
  EXPECT_NEAR(scenario.trajectory.at(25).position.x(), 0, kTolerance);
  EXPECT_NEAR(scenario.trajectory.at(25).position.y(), -10, kTolerance);
  EXPECT_NEAR(rpy_from_orientation(scenario.trajectory.at(49).orientation).z(), 0, 1e-4);
}

TEST(SurveyFlightTest, ClimbsAheadOfAStepAndDescendsAfterIt) {
  // A ledge 4 m high beyond x = 10, a metre wide. At most 20 degrees: the climb begins 4/tan(20 deg) = 10.99 m before
  // its upper edge at x = 10.
  SurveyPattern pattern = three_lines();
  pattern.lines.vehicle_length = 0.8;
  const Scenario scenario =
      flown(survey_scenario(pattern), bed_scene(150, [](double x, double) { return x < 9.5 ? -20.0 : -16.0; }));
  const double slope = std::tan(radians_from_degrees(20));
  const auto height = [&](double x) { return scenario.trajectory.at((x + 50) / 2).position.z(); };
  // Averaging rounds corners by slope x length/8 = 0.036 m, and samples 0.1 m apart may miss the edge by as much.
  constexpr double kMissed = 0.037, kRounding = 2 * kMissed;
  for (double x = -40; x < 40; x += 0.31) {
    const double right = x > 10 ? -11 : std::max(-15.0, -11 - slope * (10 - x));
    EXPECT_NEAR(height(x), right, kRounding) << x;
  }
  EXPECT_NEAR(height(4), -11 - slope * 6, kMissed);  // Amid the climb.
}

TEST(SurveyFlightTest, StaysLevelWhereAsked) {
  SurveyPattern pattern = three_lines();
  pattern.lines.pitch = PitchControl::kLevel;
  const Scenario scenario =
      flown(survey_scenario(pattern), bed_scene(150, [](double x, double) { return -20 + 0.1 * x; }));
  EXPECT_NEAR(rpy_from_orientation(scenario.trajectory.at(20).orientation).y(), 0, 1e-12);
}

TEST(SurveyFlightTest, FliesAtAConstantHeightAlsoInOpenWater) {
  SurveyPattern pattern = three_lines();
  pattern.lines.altitude.reset();
  pattern.lines.height = -7;
  for (const Scene& scene : {flat_scene(), Scene()}) {
    for (const Waypoint& waypoint : flown(survey_scenario(pattern), scene).trajectory.waypoints) {
      EXPECT_EQ(waypoint.position.z(), -7);
    }
  }
}

TEST(SurveyFlightTest, WaypointsAreAsFewAsTheToleranceAllows) {
  // Straight lines need their ends; half circles of 5 m a waypoint for each 2 acos(1 - .5 mm/5 m) = 1.62 deg.
  const Scenario scenario = flown(survey_scenario(three_lines()), flat_scene());
  EXPECT_LT(scenario.trajectory.waypoints.size(), 500U);
  // On the arc between lines 1 and 2, about (50, -5), every pose is 5 m from its centre.
  for (double time = 50; time < 50 + 2.5 * std::numbers::pi; time += 0.01) {
    const Vec3 place = scenario.trajectory.at(time).position;
    EXPECT_NEAR(std::hypot(place.x() - 50, place.y() + 5), 5, kTolerance) << time;
  }
}

TEST(SurveyFlightTest, WholePatternIsFlownUnlessPingsOrDurationAreGiven) {
  // 300 m + 10 pi m at 2 m/s = 165.708 s: 332 pings every 0.5 s, the last at 165.5 s.
  Scenario scenario = survey_scenario(three_lines());
  const Scene scene = flat_scene();
  EXPECT_NEAR(*flown(scenario, scene).duration, 150 + 5 * std::numbers::pi, 1e-9);
  EXPECT_EQ(ScenarioRequests(flown(scenario, scene)).ping_count(0), 332U);
  scenario.pings = 7;
  EXPECT_EQ(ScenarioRequests(flown(scenario, scene)).ping_count(0), 7U);
  scenario.pings = 1;
  scenario.duration = 3;
  EXPECT_EQ(ScenarioRequests(flown(scenario, scene)).ping_count(0), 6U);
}

TEST(SurveyFlightTest, PingsOnLinesOnlyWhereTurnsAreSkipped) {
  SurveyPattern pattern = three_lines();
  pattern.lines.turns = TurnPings::kSkip;
  const ScenarioRequests requests(flown(survey_scenario(pattern), flat_scene()));
  ASSERT_EQ(requests.ping_count(0), 300U);     // 100 on each line of 50 s.
  const double turn = 2.5 * std::numbers::pi;  // [s]
  EXPECT_NEAR(requests.time_of(0, 99), 49.5, 1e-9);
  EXPECT_NEAR(requests.time_of(0, 100), 50 + turn, 1e-9);
  EXPECT_NEAR(requests.at(0, 200).world_from_vehicle.position.x(), -50, kTolerance);
  EXPECT_NEAR(requests.at(0, 200).world_from_vehicle.position.y(), 10, kTolerance);
}

TEST(SurveyFlightTest, MotionNoiseHasItsRmsAndFollowsTheSeed) {
  SurveyPattern pattern = three_lines();
  pattern.lines.length = 280;
  pattern.lines.width = 200;
  pattern.motion_noise = MotionNoise{.roll = 0.02, .sway = 0.3, .heave = 0.2, .spectrum = MotionSpectrum::kSwell};
  Scenario scenario = survey_scenario(pattern);
  const Scene scene = flat_scene(-20);
  const Trajectory one = flown(scenario, scene).trajectory;
  double heave = 0, roll = 0, sway = 0;
  int count = 0;
  for (double time = 0; time < 140; time += 0.1, ++count) {
    const Pose pose = one.at(time);
    heave += std::pow(pose.position.z() + 15, 2);
    sway += std::pow(pose.position.y() + 95, 2);
    roll += std::pow(rpy_from_orientation(pose.orientation).x(), 2);
  }
  // 140 s hold 18 waves of 8 s, of random heights: within a quarter.
  EXPECT_NEAR(std::sqrt(heave / count), 0.2, 0.05);
  EXPECT_NEAR(std::sqrt(sway / count), 0.3, 0.075);
  EXPECT_NEAR(std::sqrt(roll / count), 0.02, 0.005);
  const Trajectory again = flown(scenario, scene).trajectory;
  ASSERT_EQ(one.waypoints.size(), again.waypoints.size());
  for (std::size_t i = 0; i < one.waypoints.size(); ++i) {
    ASSERT_EQ(one.waypoints[i].position, again.waypoints[i].position);
  }
  scenario.seed = 2;
  EXPECT_GT((flown(scenario, scene).trajectory.at(7).position - one.at(7).position).norm(), 1e-3);
  scenario.pattern->motion_noise->seed = 1;  // That of the first.
  EXPECT_EQ(flown(scenario, scene).trajectory.at(7).position, one.at(7).position);
}

std::string refused(const SurveyPattern& pattern, const Scene& scene) {
  return message_of([&] { (void)flown(survey_scenario(pattern), scene); });
}

TEST(SurveyFlightTest, SaysWhereALineLeavesTheTerrain) {
  SurveyPattern pattern = three_lines();
  pattern.lines.center = {0, 3};
  // The bed ends at y = 10: line 3 is at y = 13 and begins at x = -50. Samples are 0.25 m apart or less.
  const Scene scene = bed_scene(60, [](double, double y) { return y > 10 ? std::nan("") : -20.0; });
  EXPECT_EQ(refused(pattern, scene), "pattern.lines: line 3 leaves the terrain at x = -49.96 m, y = 13 m");
}

TEST(SurveyFlightTest, CrossesTurnsWithoutATerrain) {
  // The bed ends with the lines; turns of 5 m are beyond it.
  const Scenario scenario = flown(survey_scenario(three_lines()), flat_scene(-20, 51));
  EXPECT_NEAR(scenario.trajectory.at(54).position.z(), -15, kTolerance);
  EXPECT_GT(scenario.trajectory.at(54).position.x(), 54);
}

TEST(SurveyFlightTest, SaysWhatALineRunsInto) {
  SurveyPattern pattern = three_lines();
  pattern.lines.altitude.reset();
  pattern.lines.height = -17;
  const Scene scene = bed_scene(150, [](double x, double y) { return x == 20 && y == 0 ? -14.0 : -20.0; });
  // The peak is a pyramid 6 m high and a metre to each side: its face reaches -17 m half a metre before x = 20.
  EXPECT_TRUE(refused(pattern, scene).starts_with("pattern.lines.height = -17 m: line 2 runs into bed, which is -16."))
      << refused(pattern, scene);
}

TEST(SurveyFlightTest, LooksForTheBedBelowACeiling) {
  Scene scene = flat_scene();
  Mesh roof = make_plane(Vec3::UnitZ(), 400, 400);
  scene.instances.push_back({.name = "roof",
                             .mesh = std::make_shared<const Mesh>(std::move(roof)),
                             .world_from_mesh = {Vec3(0, 0, 2), Eigen::Quaterniond::Identity()}});
  assign_materials(scene, {});
  SurveyPattern pattern = three_lines();
  EXPECT_NEAR(flown(survey_scenario(pattern), scene).trajectory.at(10).position.z(), 7, kTolerance);  // Above the roof.
  pattern.lines.ceiling = 1;
  EXPECT_NEAR(flown(survey_scenario(pattern), scene).trajectory.at(10).position.z(), -15, kTolerance);
  pattern.lines.altitude = 21.5;
  EXPECT_EQ(refused(pattern, scene), "pattern.lines.ceiling = 1 m: line 1 climbs to 1.5 m at x = -50 m, y = -10 m");
}

TEST(SurveyFlightTest, RefusesWhatIsSaidTwiceOrNotAtAll) {
  const auto with = [](const auto& change) {
    SurveyPattern pattern = three_lines();
    change(pattern.lines);
    return refused(pattern, flat_scene());
  };
  EXPECT_EQ(with([](SurveyLines& lines) { lines.altitude = -3; }),
            "pattern.lines.altitude = -3 m must be greater than 0, at most 100000 m");
  EXPECT_EQ(with([](SurveyLines& lines) { lines.speed = std::nan(""); }),
            "pattern.lines.speed = nan m/s must be greater than 0, at most 50 m/s");
  EXPECT_EQ(with([](SurveyLines& lines) { lines.altitude.reset(); }),
            "pattern.lines must have altitude or height: how high the vehicle is");
  EXPECT_EQ(with([](SurveyLines& lines) { lines.height = 3; }),
            "pattern.lines.altitude and height both say how high the vehicle is; leave one out");
  EXPECT_EQ(with([](SurveyLines& lines) { lines.center.clear(); }),
            "pattern.lines must have center or corner: where the area is");
  EXPECT_EQ(with([](SurveyLines& lines) {
              lines.center = {1, 2, 3};
            }),
            "pattern.lines.center has 3 numbers, must have two: [x, y]");
  EXPECT_EQ(with([](SurveyLines& lines) { lines.spacing.reset(); }),
            "pattern.lines must have spacing or overlap: how far lines are apart");
  EXPECT_EQ(
      with([](SurveyLines& lines) {
        lines.spacing.reset();
        lines.overlap = 0.2;
      }),
      "pattern.lines.overlap = 0.2 needs a sonar with a swath on both sides (type sss or mbes); give spacing instead");
  EXPECT_EQ(with([](SurveyLines& lines) { lines.width = 1e6; }),
            "pattern.lines.width = 1000000 m holds 1e+05 lines 10 m apart; at most 10000");
  EXPECT_EQ(with([](SurveyLines& lines) { lines.length = 1e6, lines.width = 1000; }).substr(0, 26),
            "pattern.lines: a path of 1");
}

TEST(SurveyFlightTest, RefusesATrajectoryBesideThePattern) {
  Scenario scenario = survey_scenario(three_lines());
  scenario.trajectory.waypoints = {{}};
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "pattern and trajectory both move the vehicle; leave one out");
  EXPECT_EQ(message_of([] { (void)ScenarioRequests(survey_scenario(three_lines())); }),
            "pattern has no trajectory before flown() lays it over a scene");
}

TEST(SurveyFlightTest, PingSpansFollowEachOther) {
  Scenario scenario = survey_scenario(three_lines());
  scenario.ping_spans = {{.begin = 4, .end = 9}, {.begin = 8, .end = 10}};
  EXPECT_EQ(message_of([&] { scenario.validate(); }),
            "ping_spans[1].begin = 8 s must be at least ping_spans[0].end = 9 s");
  scenario.ping_spans[0].end = 3;
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "ping_spans[0].end = 3 s must be greater than begin = 4 s");
}

}  // namespace
}  // namespace insonify::survey_flight_test
