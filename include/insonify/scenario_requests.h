// scenario_requests.h -- ping requests from a scenario: its trajectory, motions and head steps.

#pragma once

#include "insonify/ping_request.h"
#include "insonify/scenario.h"

namespace insonify {

/// Pings of one sonar follow each other at its period, from time 0 or within the scenario's ping_spans. The vehicle and
/// the objects of motions follow their trajectories, and a scanning head turns by its steps.
class ScenarioRequests {
 public:
  /// @param scenario  May be destroyed afterwards.
  /// @throws Error if a sonar would be above the water's surface, and for a pattern that is not flown() yet.
  explicit ScenarioRequests(const Scenario& scenario);

  /// Number of pings of one sonar: Scenario::ping_count().
  /// @throws Error for an index out of range, as all functions here.
  [[nodiscard]] std::uint64_t ping_count(int sonar) const;
  /// Number of pings of the sonar with most.
  [[nodiscard]] std::uint64_t most_pings() const;
  /// Number of pings of all sonars together.
  [[nodiscard]] std::uint64_t total_pings() const;
  [[nodiscard]] int sonar_count() const { return static_cast<int>(sonars_.size()); }

  /// Ping `number` of a sonar; numbers beyond ping_count(sonar) are valid too.
  [[nodiscard]] PingRequest at(int sonar, std::uint64_t number) const;

  /// The same at another time [s], with vehicle and objects placed as at that time.
  /// @throws Error for a time out of PingRequest's limits.
  [[nodiscard]] PingRequest at(int sonar, std::uint64_t number, double time) const;

  /// at(sonar, number); allocates nothing if the request was filled by this before.
  void fill(int sonar, std::uint64_t number, PingRequest& request) const;

  /// Adds a waypoint to the end of the trajectory, for a vehicle that is steered while its pings are made. A ping
  /// depends on the trajectory until the sonar has listened: reach().
  /// @throws Error as Scenario::validate() and the constructor for an invalid waypoint; the trajectory is
  ///         unchanged.
  void extend(const Waypoint& waypoint);

  /// Time until which ping `number` of a sonar depends on the trajectory [s].
  [[nodiscard]] double reach(int sonar, std::uint64_t number) const;

  /// The vehicle's trajectory, with the waypoints of extend().
  [[nodiscard]] const Trajectory& trajectory() const { return trajectory_; }

  /// The time of a sonar's ping [s].
  [[nodiscard]] double time_of(int sonar, std::uint64_t number) const;

 private:
  void fill_at(const SonarConfig& config, std::uint64_t number, double time, PingRequest& request) const;

  std::vector<std::uint64_t> ping_counts_;  // Pings of each sonar.
  std::vector<SonarConfig> sonars_;         // Filled in.
  Trajectory trajectory_;
  std::vector<Motion> motions_;
  std::optional<SeaSurface> surface_;
  bool motion_in_ping_ = false;
  std::vector<PingSpan> ping_spans_;
};

}  // namespace insonify
