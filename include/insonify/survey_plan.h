// survey_plan.h -- a survey before it is flown: its lines, their swaths and what they cover, as numbers and as a
// picture.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/scenario.h"

namespace insonify {

/// A place in plan: x and y in the world [m].
using PlanPoint = Eigen::Vector2d;

struct PlannedLine {
  PlanPoint begin, end;
  double begin_time = 0, end_time = 0;           ///< [s]
  double least_altitude = 0, most_altitude = 0;  ///< Above the bed [m]; NaN where there is none.
  std::vector<double> half_swath = {};           ///< To either side at evenly spaced places from `begin` to `end` [m];
                                                 ///< empty without a sonar that has a swath.
};

struct PlannedSonar {
  std::string name;
  std::uint64_t pings = 0;
  double ping_distance = 0;                ///< Flown between pings [m].
  std::optional<double> least_swath = {};  ///< Full width over all lines [m]; absent for a sonar without a swath.
  std::optional<double> most_swath = {};
  std::optional<double> overlap = {};  ///< Share of the mean swath that the next line covers too; negative: a
                                       ///< gap. Absent for one line.
  std::optional<double> covered = {};  ///< Share of the area within its swaths, 0..1.
};

/// Heights of the bed at the pixels of a picture of the plan, rows from the top (largest y); NaN where there is none.
struct PlannedBed {
  PlanPoint low = PlanPoint::Zero(), high = PlanPoint::Ones();  ///< Corners of the rectangle [m].
  int columns = 0, rows = 0;
  std::vector<float> heights = {};
};

struct SurveyPlan {
  std::string title;                 ///< Of the scenario's file; "" without one.
  std::vector<PlanPoint> area = {};  ///< The corners of the area, beginning beside the start of line 1, along it.
  std::vector<PlannedLine> lines = {};
  std::vector<PlanPoint> track = {};  ///< The path in plan, close enough to draw arcs.
  double spacing = 0;                 ///< Between lines [m]; 0 for one.
  double length = 0;                  ///< Of the path, with turns and run-ins [m].
  double line_length = 0;             ///< Of all lines [m].
  double duration = 0;                ///< [s]
  bool pings_on_turns = true;
  double steepest = 0;                    ///< Greatest climb or descent [rad].
  std::vector<PlannedSonar> sonars = {};  ///< Of the scenario.
  int swath_sonar = -1;                   ///< Index of the one whose swaths the lines have; -1: none.
  PlannedBed bed = {};
};

/// @param scenario  With a pattern.
/// @throws Error as flown(), and without a pattern.
[[nodiscard]] SurveyPlan plan_survey(const Scenario& scenario, const Scene& scene);

/// The plan from above, y upwards: the bed shaded and coloured by depth, the area, the lines with numbers and
/// directions, turns, swaths, parts of the area that no swath covers, a scale and an arrow to the north (y).
/// @param height  Of the picture [pixels], 240..8192.
[[nodiscard]] Picture draw_survey_plan(const SurveyPlan& plan, int height = 900);

}  // namespace insonify
