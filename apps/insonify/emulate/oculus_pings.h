// oculus_pings.h -- the simulated sonar as an Oculus: settings from fire messages, pings as results.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulate/emulated_sonar.h"
#include "insonify/wire/oculus_sonar.h"
#include "transport/transport_report.h"

namespace insonify {

class OculusPings {
 public:
  /// Settings of pings.
  struct Settings {
    OculusPlan plan = {};
    MessageLevels levels = {};
    std::vector<std::int16_t> bearings = {};
  };
  /// A ping whose echoes the instrument still listens to.
  struct Received {
    OculusPing result = {};
    double computing_time = 0;  ///< [s]
    WallClock::time_point transmitted = {};

    /// Arrival time of the last echo.
    [[nodiscard]] WallClock::time_point received_at() const;
  };

  explicit OculusPings(EmulatedSonar& sonar);

  [[nodiscard]] const OculusModes& modes() const { return modes_; }

  /// Changes the simulated sonar, between pings.
  /// @param notes  Receives deviations from the request.
  /// @throws Error for an invalid request; then nothing has changed.
  [[nodiscard]] std::shared_ptr<const Settings> apply(const OculusFire& asked, std::vector<std::string>& notes);

  /// Makes a ping. The settings are those applied last.
  /// @throws Error as EmulatedSonar::ping(); Interrupted at SIGINT.
  [[nodiscard]] Received make(const Settings& settings);

  /// Everything except the network's part. May be called while a ping is made.
  [[nodiscard]] OculusStatus status() const;

 private:
  EmulatedSonar& sonar_;
  OculusModes modes_;
  std::optional<OculusFire> applied_;  // The members that act on the simulated sonar.
  std::uint32_t number_ = 0;
};

}  // namespace insonify
