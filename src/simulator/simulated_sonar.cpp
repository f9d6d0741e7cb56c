// simulated_sonar.cpp -- makes the apertures of a sonar, and checks what is asked of it.

#include "simulator/simulated_sonar.h"

#include <fmt/format.h>

#include "insonify/error.h"
#include "sonar/stabilise.h"

namespace insonify {
namespace {

// Pose after a time of constant linear and angular velocity.
Pose moved_on(const Pose& pose, const Twist& twist, double time) {
  const double rate = twist.angular.norm();
  Pose moved = pose;
  moved.position += time * twist.linear;
  if (rate > 0) {
    moved.orientation = Eigen::AngleAxisd(rate * time, twist.angular / rate) * pose.orientation;
  }
  return moved;
}

}  // namespace

Pose housing_from_head(double head_angle) {
  return {Vec3::Zero(), orientation_from_rpy(0, 0, head_angle)};
}

SimulatedSonar::SimulatedSonar(const Scenario& scenario, const SonarConfig& sonar, std::span<const Material> materials)
    : config(scenario.filled_in(sonar)), vehicle_from_housing(config.vehicle_from_sonar()) {
  for (int index = 0; index < config.aperture_count(); ++index) {
    apertures.emplace_back(scenario, config, index, materials);
  }
  if (config.is_multibeam()) {
    const Pulse pulse(config.transmitted(scenario.receiver_of(config)), *config.assumed_sound_speed,
                      config.bin_length());
    detector.emplace(config, BottomDetectionOptions{.resolution = pulse.equivalent_length()});
  }
  if (apertures.size() > 1) {
    joiner.emplace(config, scenario.model, scenario.receiver_of(config));
  }
}

void SimulatedSonar::check(const PingRequest& request, bool moves) const {
  if (request.head_angle && !config.scans()) {
    throw Error(fmt::format("head_angle = {:.10g} rad belongs to a scanning sonar; this one's type is {}",
                            *request.head_angle, word_of(config.type)));
  }
  // Motion in a ping is computed to first order in speed over sound speed.
  constexpr double kMost = 100;  // [m/s]: a fifteenth of the speed of sound.
  if (const double speed = request.twist.linear.norm(); moves && speed > kMost) {
    throw Error(fmt::format("twist.linear comes to {:.4g} m/s; with motion_in_ping at most {} m/s", speed, kMost));
  }
  // Motion follows from the poses at start and end, which do not distinguish a turn from one the other way round.
  constexpr double kHalfTurn = std::numbers::pi * (1 + 1e-9);
  const double turned = request.twist.angular.norm() * listening_time();
  if (moves && turned > kHalfTurn) {
    throw Error(
        fmt::format("twist.angular turns the sonar by {:.4g} deg while it listens; with motion_in_ping at most 180",
                    degrees_from_radians(turned)));
  }
}

PingMotion SimulatedSonar::motion_while_listening(const PingRequest& request, const Pose& vehicle_from_head) const {
  const double time = listening_time();
  const auto beams = [&](const Pose& world_from_vehicle) {
    return stabilised(config, world_from_vehicle * vehicle_from_head, request.twist.linear);
  };
  return motion_between(beams(request.world_from_vehicle),
                        beams(moved_on(request.world_from_vehicle, request.twist, time)), time);
}

Pose SimulatedSonar::world_from_beams(const PingRequest& request) const {
  return stabilised(config, request.world_from_vehicle * vehicle_from_housing, request.twist.linear);
}

}  // namespace insonify
