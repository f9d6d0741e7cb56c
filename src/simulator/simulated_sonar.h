// simulated_sonar.h -- one sonar of a simulator: its apertures, and where they are.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "insonify/ping_request.h"
#include "insonify/scenario.h"
#include "insonify/survey/bottom_detection.h"
#include "receiver/ping_motion.h"
#include "receiver/side_joiner.h"
#include "simulator/aperture.h"

namespace insonify {

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

  /// Pose of the housing at a ping; of a stabilised multibeam that of its beams: stabilised().
  [[nodiscard]] Pose world_from_beams(const PingRequest& request) const;

  /// Motion of the transducer from transmission to the last echo, steady and straight between the poses at both times.
  [[nodiscard]] PingMotion motion_while_listening(const PingRequest& request, const Pose& vehicle_from_head) const;

  /// From transmission to the last echo, by the sound speed that the sonar assumes [s].
  [[nodiscard]] double listening_time() const { return config.shortest_ping_period(*config.assumed_sound_speed); }

  SonarConfig config;  ///< With defaults filled in: see Scenario::filled_in().
  Pose vehicle_from_housing;
  std::vector<Aperture> apertures;         ///< Those of config; their pings are made together.
  std::optional<SideJoiner> joiner;        ///< With several: makes one ping of theirs.
  std::optional<BottomDetector> detector;  ///< Of a multibeam.
};

/// Pose of the head in its housing, turned about z.
[[nodiscard]] Pose housing_from_head(double head_angle);

}  // namespace insonify
