// fly_pattern.cpp -- flown(): makes the trajectory and the length of a scenario from its pattern.

#include "insonify/error.h"
#include "insonify/scenario.h"
#include "pattern/survey_flight.h"

namespace insonify {
namespace {

Scenario with_flight(Scenario scenario, const SurveyPattern& pattern, const Scene& scene) {
  const SurveyFlight flight = survey_flight(pattern, scenario.sonars, scene);
  for (const FlightPose& pose : flight_poses(flight, pattern, scenario.seed)) {
    scenario.trajectory.waypoints.push_back({pose.time, pose.position, pose.rpy});
  }
  const bool has_pings = scenario.pings != Scenario().pings || scenario.places.contains("pings");
  if (!has_pings && !scenario.duration && !scenario.turns) {
    scenario.duration = flight.duration();
  }
  if (pattern.lines.turns == TurnPings::kSkip) {
    for (int i = 0; i < flight.path.line_count; ++i) {
      const PathPiece& line = flight.path.line(i);
      scenario.ping_spans.push_back({line.begin / flight.speed, (line.begin + line.length) / flight.speed});
    }
  }
  return scenario;
}

}  // namespace

Scenario flown(Scenario scenario, const Scene& scene) {
  if (!scenario.pattern) {
    return scenario;
  }
  const Places places = scenario.places;
  try {
    scenario.validate();
    const SurveyPattern pattern = *scenario.pattern;
    scenario.pattern.reset();
    return with_flight(std::move(scenario), pattern, scene);
  } catch (const Error& error) {
    throw error.located(places);
  }
}

}  // namespace insonify
