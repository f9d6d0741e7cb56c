// survey_flight.h -- the flight of a survey: its path in plan, the bed below and the height of the vehicle.

#pragma once

#include <span>
#include <vector>

#include "insonify/pattern.h"
#include "insonify/scene.h"
#include "insonify/sonar_config.h"
#include "pattern/bed.h"
#include "pattern/survey_path.h"

namespace insonify {

struct SurveyFlight {
  SurveyPath path;
  double speed = 1;                  ///< Over ground [m/s].
  double step = 1;                   ///< Between samples, along the path [m].
  std::vector<double> beds = {};     ///< [sample] Height of the bed [m]; interpolated where there is none, see has_bed.
  std::vector<bool> has_bed = {};    ///< [sample] Whether there is a bed below.
  std::vector<double> heights = {};  ///< [sample] Height of the vehicle without its unsteadiness [m].

  [[nodiscard]] double duration() const { return path.length() / speed; }  ///< [s]
  [[nodiscard]] std::size_t sample_at(double distance) const;              ///< Nearest to a distance along the path.
};

/// Heights of a vehicle that keeps `altitude` above a bed: the lowest path that is nowhere nearer to it nor steeper
/// than `slope`, so that it climbs ahead of a step and descends after it, averaged over `length`, which rounds its
/// corners by at most slope x length/8. Samples may miss an edge by one step.
/// @param step    Between samples [m].
/// @param slope   Greatest climb, a tangent, > 0.
[[nodiscard]] std::vector<double> followed_heights(std::span<const double> beds, double step, double altitude,
                                                   double slope, double length);

/// The rectangle in plan that a path lies in.
[[nodiscard]] PlanBox extent_of(const SurveyPath& path);

/// @throws Error for a line that leaves the terrain or runs into something, and for a path too long to be sampled.
[[nodiscard]] SurveyFlight survey_flight(const SurveyPattern& pattern, std::span<const SonarConfig> sonars,
                                         const Scene& scene);

/// A pose of a vehicle at a time, with continuous angles.
struct FlightPose {
  double time;    ///< [s]
  Vec3 position;  ///< [m]
  Vec3 rpy;       ///< Roll, pitch, yaw [rad].
};

/// Poses between which linear interpolation stays within 1 mm and 0.01 degrees of the flight with its unsteadiness.
/// @param seed  Of the scenario.
[[nodiscard]] std::vector<FlightPose> flight_poses(const SurveyFlight& flight, const SurveyPattern& pattern,
                                                   std::uint64_t seed);

}  // namespace insonify
