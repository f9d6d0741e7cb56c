// live_run.h -- the pings between two changes: which is next, where the vehicle is then, and the scenario that repeats
// them.

#pragma once

#include <string>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/scenario_requests.h"

namespace insonify {

/// Where a run begins.
struct LiveStart {
  bool follows = true;      ///< The scenario's trajectory.
  Pose world_from_vehicle;  ///< Where it is not followed.
  double time = 0;          ///< Time on the scenario's trajectory at time 0 of the run [s].
};

/// The scenario of a run: its trajectory begins at `start`. Where objects move by themselves, theirs and the vehicle's
/// begin at time 0 again, as they are told from their poses at time 0.
[[nodiscard]] Scenario scenario_from(Scenario scenario, const LiveStart& start);

/// Pings from 0 on, in the order of time.
class LiveRun {
 public:
  /// @param scenario  Of scenario_from().
  LiveRun(Scenario scenario, const LiveStart& start);

  /// Time of the next pings [s].
  [[nodiscard]] double next_time() const;
  /// Sonars that ping next: those whose pings are at the same time but for rounding.
  [[nodiscard]] std::vector<int> next_sonars() const;

  /// Extends the flown path to a time [s] with the velocities of now.
  /// @return  "" or why the vehicle cannot go on; it then stays where it is.
  std::string fly_until(double time, const LiveVelocity& velocity);
  /// Extends it as far as the next pings reach.
  std::string fly_to_next(const LiveVelocity& velocity);

  /// Ends the path at the next pings, with a pose that another program tells.
  /// @return  "" or why the vehicle cannot be there.
  std::string drive_to_next(const Pose& world_from_vehicle);

  /// The next ping of a sonar. The path must reach it.
  void fill(int sonar, PingRequest& request) const;
  /// Counts the next ping of a sonar as made.
  void made(int sonar) { ++numbers_[static_cast<std::size_t>(sonar)]; }

  /// Where the vehicle is at the next pings, as far as the path is known.
  [[nodiscard]] Pose next_pose() const;
  [[nodiscard]] std::uint64_t made_in_all() const;

  /// The scenario that makes the pings made, and no others.
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
