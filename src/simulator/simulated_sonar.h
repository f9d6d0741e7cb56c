// simulated_sonar.h -- one sonar of a simulator: its plan, and the sources and receivers that pings reuse.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "echo/batch/source_set.h"
#include "echo/model/flat_plan.h"
#include "echo/walks/random_walks.h"
#include "insonify/ping_request.h"
#include "insonify/scenario.h"
#include "receiver/calibrated_receiver.h"

namespace insonify {

/// Plan and receivers are made from the same SonarConfig and Water, so that they agree.
struct SimulatedSonar {
  /// @param scenario   Valid; `sonar` need not be one of its sonars.
  /// @param materials  The scene's materials at this sonar's frequency; not kept.
  SimulatedSonar(const Scenario& scenario, const SonarConfig& sonar, std::span<const Material> materials);

  /// @param moves  Whether motion during a ping is simulated (motion_in_ping).
  /// @throws Error for a head angle where there is no head, and for too high a speed where motion is simulated.
  void check(const PingRequest& request, bool moves) const;

  /// Angle of the head at a ping, 0 for a sonar without one [rad].
  [[nodiscard]] double head_angle(const PingRequest& request) const {
    return request.head_angle.value_or(config.head_angle(request.number));
  }

  /// Motion of the transducer from transmission to the last echo, steady and straight between the poses at both times.
  [[nodiscard]] PingMotion motion_while_listening(const PingRequest& request, const Pose& vehicle_from_head) const;

  /// From transmission to the last echo, by the sound speed that the sonar assumes [s].
  [[nodiscard]] double listening_time() const { return config.shortest_ping_period(*config.assumed_sound_speed); }

  /// Makes receivers for so many threads, where there are fewer. None in the paper model.
  void add_receivers(const Scenario& scenario, std::span<const Material> materials, std::size_t threads);

  SonarConfig config;  ///< With defaults filled in: see Scenario::filled_in().
  Pose vehicle_from_housing;
  SonarConfig steered;  ///< With the beams' true bearings.
  BearingCells cells;
  std::shared_ptr<const FlatPlan> plan;
  GridLayers layers;
  std::optional<RandomWalks::Settings> walks;                  ///< Where the scenario has random_walks.
  std::vector<std::unique_ptr<SourceSet>> sources;             ///< For each view of a batch.
  std::vector<std::unique_ptr<CalibratedReceiver>> receivers;  ///< For each thread.
};

/// Pose of the head in its housing, turned about z.
[[nodiscard]] Pose housing_from_head(double head_angle);

}  // namespace insonify
