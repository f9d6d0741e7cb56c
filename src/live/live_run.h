// live_run.h -- a run of pings between two changes: its schedule, the vehicle's path and the scenario that repeats
// it.

#pragma once

#include <string>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/scenario_requests.h"

namespace insonify {

/// Start of a run.
struct LiveStart {
  bool follows = true;      ///< Whether the vehicle follows the scenario's trajectory.
  Pose world_from_vehicle;  ///< Used if not.
  double time = 0;          ///< Time on the scenario's trajectory at time 0 of the run [s].
};

/// The scenario of a run: its trajectory begins at `start`. If objects move by themselves, their trajectories and the
/// vehicle's restart at time 0, since they are relative to the poses at time 0.
[[nodiscard]] Scenario scenario_from(Scenario scenario, const LiveStart& start);

/// Pings from 0 on, in order of time.
class LiveRun {
 public:
  /// @param scenario  From scenario_from().
  LiveRun(Scenario scenario, const LiveStart& start);

  /// Time of the next pings [s].
  [[nodiscard]] double next_time() const;
  /// Sonars that ping next, at the same time up to rounding.
  [[nodiscard]] std::vector<int> next_sonars() const;

  /// Extends the flown path to a time [s] at constant velocity.
  /// @return  "", or why the vehicle cannot continue; it then stays in place.
  std::string fly_until(double time, const LiveVelocity& velocity);
  /// Extends it to the end of the next pings.
  std::string fly_to_next(const LiveVelocity& velocity);

  /// Ends the path at the next pings, with a pose from another program.
  /// @return  "", or why the vehicle cannot be there.
  std::string drive_to_next(const Pose& world_from_vehicle);

  /// The next ping of a sonar. The path must reach it.
  void fill(int sonar, PingRequest& request) const;
  /// Counts the next ping of a sonar as made.
  void made(int sonar) { ++numbers_[static_cast<std::size_t>(sonar)]; }

  /// Pose of the vehicle at the next pings, as far as the path is known.
  [[nodiscard]] Pose next_pose() const;
  [[nodiscard]] std::uint64_t made_in_all() const;

  /// The scenario that makes exactly the pings made so far.
  /// @throws Error for a path of more than kLongestLivePath waypoints.
  [[nodiscard]] Scenario saved() const;

  [[nodiscard]] const Scenario& scenario() const { return scenario_; }
  [[nodiscard]] const LiveStart& start() const { return start_; }

 private:
  void extend(double time);

  Scenario scenario_;
  LiveStart start_;
  ScenarioRequests requests_;
  std::vector<std::uint64_t> numbers_;  // Number of the next ping of each sonar.
  Pose pose_;                           // At the end of the path, not rounded.
  std::size_t steps_ = 0;               // Steps of the path.
};

}  // namespace insonify
