// simulated_sonar.h -- one sonar of a simulator: what is worked out from its settings, and its memory between pings.

#pragma once

#include <memory>
#include <optional>
#include <span>

#include "echo/model/ping_plan.h"
#include "insonify/ping_request.h"
#include "insonify/scenario.h"
#include "receiver/calibrated_receiver.h"

namespace insonify {

/// What the plan, the grid and the receiver are made from agrees: one SonarConfig, one water.
struct SimulatedSonar {
  /// @param scenario   Valid; `sonar` need not be one of its sonars.
  /// @param materials  Of the scene, as sound of this sonar's frequency meets them; read only here.
  SimulatedSonar(const Scenario& scenario, const SonarConfig& sonar, std::span<const Material> materials);

  /// @param moves  Whether it moves while it listens.
  /// @throws Error for a request that turns a head which is not there, or that has the vehicle too fast.
  void check(const PingRequest& request, bool moves) const;

  /// Angle of the head at a ping, 0 for a sonar without one [rad].
  [[nodiscard]] double head_angle(const PingRequest& request) const {
    return request.head_angle.value_or(config.head_angle(request.number));
  }

  /// How the transducer moves from transmission until the last echo is back: steady, on the straight way between both
  /// ends.
  [[nodiscard]] PingMotion motion_while_listening(const PingRequest& request, const Pose& vehicle_from_head) const;

  SonarConfig config;  ///< With everything filled in.
  Pose vehicle_from_housing;
  std::shared_ptr<const PingPlan> plan;
  EchoGrid grid;
  std::optional<CalibratedReceiver> receiver;  ///< None in the paper model.
};

/// Turn of the head in its housing.
[[nodiscard]] Pose housing_from_head(double head_angle);

}  // namespace insonify
