// survey_plan.cpp -- plan_survey(): lengths, pings, swaths and coverage of a survey.

#include "insonify/survey_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "insonify/bed_heights.h"
#include "insonify/error.h"
#include "insonify/scenario_requests.h"
#include "pattern/survey_flight.h"
#include "pattern/swath.h"

namespace insonify {
namespace {

constexpr int kStations = 200;    // Places along a line at which swaths are worked out.
constexpr int kBedPixels = 1000;  // Along the longer side.

// A line's altitude at one of kStations + 1 places.
double altitude_at(const SurveyFlight& flight, const PathPiece& line, int station) {
  const std::size_t sample = flight.sample_at(line.begin + line.length * station / kStations);
  return flight.has_bed[sample] ? flight.heights[sample] - flight.beds[sample]
                                : std::numeric_limits<double>::quiet_NaN();
}

// Half swaths of a sonar along a line, from its begin.
std::vector<double> half_swaths(const SurveyFlight& flight, const PathPiece& line, const SonarConfig& sonar) {
  std::vector<double> halves;
  for (int i = 0; i <= kStations; ++i) {
    const double altitude = altitude_at(flight, line, i) + sonar.position.z();
    halves.push_back(std::isfinite(altitude) ? half_swath(sonar, altitude).value_or(0) : 0);
  }
  return halves;
}

PlannedLine planned_line(const SurveyFlight& flight, int index, const SonarConfig* sonar) {
  const PathPiece& piece = flight.path.line(index);
  const SurveyPath::Station end = flight.path.at(piece.begin + piece.length * (1 - 1e-12));
  PlannedLine line{.begin = {piece.x, piece.y},
                   .end = {end.x, end.y},
                   .begin_time = piece.begin / flight.speed,
                   .end_time = (piece.begin + piece.length) / flight.speed,
                   .least_altitude = std::numeric_limits<double>::quiet_NaN(),
                   .most_altitude = std::numeric_limits<double>::quiet_NaN()};
  for (int i = 0; i <= kStations; ++i) {
    const double altitude = altitude_at(flight, piece, i);
    line.least_altitude = std::fmin(line.least_altitude, altitude);
    line.most_altitude = std::fmax(line.most_altitude, altitude);
  }
  if (sonar != nullptr) {
    line.half_swath = half_swaths(flight, piece, *sonar);
  }
  return line;
}

// Share of the area that lies within a sonar's swaths: exact across the lines, at stations along them.
double covered_share(const SurveyLines& lines, const SurveyFlight& flight,
                     const std::vector<std::vector<double>>& halves) {
  const int count = flight.path.line_count;
  const double first = 0.5 * (lines.width - (count - 1) * flight.path.spacing);
  double covered = 0;
  for (int station = 0; station <= kStations; ++station) {
    std::vector<std::pair<double, double>> strips;
    for (int i = 0; i < count; ++i) {
      const double half = halves[i][i % 2 == 0 ? station : kStations - station];
      const double middle = first + i * flight.path.spacing;
      strips.emplace_back(std::max(0.0, middle - half), std::min(lines.width, middle + half));
    }
    std::ranges::sort(strips);
    double end = 0;  // Of what is covered so far.
    for (const auto& [low, high] : strips) {
      covered += std::max(0.0, high - std::max(low, end));
      end = std::max(end, high);
    }
  }
  return covered / (lines.width * (kStations + 1));
}

void add_swath(const SurveyLines& lines, const SurveyFlight& flight, const SonarConfig& sonar, PlannedSonar& planned) {
  std::vector<std::vector<double>> halves;
  double sum = 0, least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 0; i < flight.path.line_count; ++i) {
    halves.push_back(half_swaths(flight, flight.path.line(i), sonar));
    for (const double half : halves.back()) {
      sum += half;
      least = std::min(least, half);
      most = std::max(most, half);
    }
  }
  planned.least_swath = 2 * least;
  planned.most_swath = 2 * most;
  const double mean = 2 * sum / static_cast<double>(halves.size() * (kStations + 1));
  if (flight.path.line_count > 1 && mean > 0) {
    planned.overlap = 1 - flight.path.spacing / mean;
  }
  if (lines.width > 0) {
    planned.covered = covered_share(lines, flight, halves);
  }
}

std::vector<PlannedSonar> planned_sonars(const SurveyLines& lines, const SurveyFlight& flight,
                                         const Scenario& scenario) {
  const ScenarioRequests requests(scenario);
  std::vector<PlannedSonar> sonars;
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig sonar = scenario.filled_in(scenario.sonars[i]);
    sonars.push_back({.name = sonar.name,
                      .pings = requests.ping_count(static_cast<int>(i)),
                      .ping_distance = *sonar.ping_period * flight.speed});
    if (half_swath(sonar, 1)) {
      add_swath(lines, flight, sonar, sonars.back());
    }
  }
  return sonars;
}

std::vector<PlanPoint> track_of(const SurveyPath& path) {
  std::vector<PlanPoint> track;
  for (const PathPiece& piece : path.pieces) {
    constexpr double kTurn = radians_from_degrees(4);
    const int parts = std::max(1, static_cast<int>(std::ceil(piece.length * std::abs(piece.curvature) / kTurn)));
    for (int i = 0; i < parts; ++i) {
      const SurveyPath::Station at = path.at(piece.begin + piece.length * i / parts);
      track.emplace_back(at.x, at.y);
    }
  }
  const SurveyPath::Station end = path.at(path.length());
  track.emplace_back(end.x, end.y);
  return track;
}

// The bed around the area, the track and the swaths.
PlannedBed planned_bed(const SurveyPlan& plan, const Scene& scene, const std::optional<double>& ceiling) {
  PlannedBed bed{.low = plan.area.front(), .high = plan.area.front()};
  const auto include = [&](const PlanPoint& point, double reach) {
    bed.low = bed.low.cwiseMin(PlanPoint(point.array() - reach));
    bed.high = bed.high.cwiseMax(PlanPoint(point.array() + reach));
  };
  for (const PlanPoint& corner : plan.area) {
    include(corner, 0);
  }
  for (const PlanPoint& point : plan.track) {
    include(point, 0);
  }
  for (const PlannedLine& line : plan.lines) {
    const double reach = line.half_swath.empty() ? 0 : *std::ranges::max_element(line.half_swath);
    include(line.begin, reach);
    include(line.end, reach);
  }
  const double margin = std::max(1.0, 0.05 * (bed.high - bed.low).maxCoeff());
  bed.low.array() -= margin;
  bed.high.array() += margin;
  // A single line is drawn on a field of some width.
  const PlanPoint missing =
      (PlanPoint::Constant(0.6 * (bed.high - bed.low).maxCoeff()) - (bed.high - bed.low)).cwiseMax(0.0);
  bed.low -= 0.5 * missing;
  bed.high += 0.5 * missing;
  const PlanPoint size = bed.high - bed.low;
  bed.columns = static_cast<int>(std::lround(kBedPixels * size.x() / size.maxCoeff()));
  bed.rows = static_cast<int>(std::lround(kBedPixels * size.y() / size.maxCoeff()));
  bed.heights = bed_heights(scene, {bed.low, bed.high, bed.columns, bed.rows}, {.ceiling = ceiling});
  return bed;
}

std::vector<PlanPoint> area_of(const SurveyLines& lines) {
  const PlanPoint corner = area_corner(lines);
  const PlanPoint along(std::cos(lines.yaw), std::sin(lines.yaw)), port(-along.y(), along.x());
  return {corner, corner + lines.length * along, corner + lines.length * along + lines.width * port,
          corner + lines.width * port};
}

double steepest_of(const SurveyFlight& flight) {
  double slope = 0;
  for (std::size_t i = 1; i < flight.heights.size(); ++i) {
    slope = std::max(slope, std::abs(flight.heights[i] - flight.heights[i - 1]) / flight.step);
  }
  return std::atan(slope);
}

}  // namespace

SurveyPlan plan_survey(const Scenario& scenario, const Scene& scene) {
  if (!scenario.pattern) {
    throw Error("", "pattern", " is missing: the survey to plan").located(scenario.places);
  }
  const Scenario ready = flown(scenario, scene);
  const SurveyLines& lines = scenario.pattern->lines;
  const SurveyFlight flight = survey_flight(*scenario.pattern, scenario.sonars, scene);
  const SonarConfig* sonar = swath_sonar(scenario.sonars);
  SurveyPlan plan{.title = scenario.file.stem().string(),
                  .area = area_of(lines),
                  .track = track_of(flight.path),
                  .spacing = flight.path.spacing,
                  .length = flight.path.length(),
                  .line_length = flight.path.line_count * lines.length,
                  .duration = flight.duration(),
                  .pings_on_turns = lines.turns == TurnPings::kPing,
                  .steepest = steepest_of(flight),
                  .sonars = planned_sonars(lines, flight, ready),
                  .swath_sonar = sonar == nullptr ? -1 : static_cast<int>(sonar - scenario.sonars.data())};
  for (int i = 0; i < flight.path.line_count; ++i) {
    plan.lines.push_back(planned_line(flight, i, sonar));
  }
  plan.bed = planned_bed(plan, scene, lines.ceiling);
  return plan;
}

}  // namespace insonify
