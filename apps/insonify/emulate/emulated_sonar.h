// emulated_sonar.h -- one sonar of a scenario that pings on a protocol's request, in real time.

#pragma once

#include <cstdint>
#include <optional>

#include "emulate/emulate.h"
#include "insonify/channels.h"
#include "insonify/messages.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "transport/transport_report.h"

namespace insonify {

class EmulatedSonar {
 public:
  /// @param instrument  For messages: "ping360".
  /// @throws InputError for an invalid scenario, or one without such a sonar.
  EmulatedSonar(const EmulateOptions& options, Product product, std::string_view instrument);

  /// The sonar as given in the scenario.
  [[nodiscard]] const SonarConfig& given() const { return given_; }
  [[nodiscard]] const Scenario& scenario() const { return scenario_; }
  /// The sonar named by EmulateOptions::high; null if none is.
  [[nodiscard]] const SonarConfig* high() const {
    return high_ < 0 ? nullptr : &scenario_.sonars[static_cast<std::size_t>(high_)];
  }
  /// As Simulator::sonar(), with the changes of set().
  [[nodiscard]] const SonarConfig& config() const { return simulator_.sonar(index_); }
  [[nodiscard]] double sound_speed() const { return *config().assumed_sound_speed; }
  /// Levels of the darkest and the brightest value of images.
  [[nodiscard]] MessageLevels levels() const;

  /// Changes the sonar, from the next ping on. @throws Error as Simulator::set_sonar().
  void set(const SonarConfig& config) { simulator_.set_sonar(index_, config); }

  /// Makes a ping from the vehicle's current place on the scenario's trajectory.
  /// @return  Valid until the next call. @throws Error as Simulator::ping(); Interrupted at SIGINT.
  const Ping& ping(std::optional<double> head_angle = {});

  /// Looks along a fan from the vehicle's current place, as look_along_fan(), without sound.
  [[nodiscard]] Channels look(const SonarConfig& fan, int columns, int rows);

  /// Time on the trajectory: time since the start [s].
  [[nodiscard]] double time_at(WallClock::time_point time) const {
    return std::chrono::duration<double>(time - start_).count();
  }

  /// Computing time of the last ping or look [s].
  [[nodiscard]] double computing_time() const { return computing_time_; }

 private:
  Scenario scenario_;
  int index_;
  SonarConfig given_;
  int high_;  // -1: none.
  Simulator simulator_;
  ScenarioRequests requests_;
  WallClock::time_point start_ = WallClock::now();
  std::uint64_t number_ = 0;
  Ping ping_;
  double computing_time_ = 0;
};

}  // namespace insonify
