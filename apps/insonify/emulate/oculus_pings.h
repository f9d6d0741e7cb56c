// oculus_pings.h -- the simulated sonar as an Oculus: what fire messages make of it, and its pings as results.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulate/emulated_sonar.h"
#include "insonify/wire/oculus_sonar.h"
#include "road/road_report.h"

namespace insonify {

class OculusPings {
 public:
  /// What pings are made with.
  struct Settings {
    OculusPlan plan = {};
    MessageLevels levels = {};
    std::vector<std::int16_t> bearings = {};
  };
  /// A ping whose echoes the instrument still listens to.
  struct Heard {
    OculusPing result = {};
    double computing_time = 0;  ///< [s]
    WallClock::time_point transmitted = {};

    /// When the last echo is in.
    [[nodiscard]] WallClock::time_point heard() const;
  };

  explicit OculusPings(EmulatedSonar& sonar);

  [[nodiscard]] const OculusModes& modes() const { return modes_; }

  /// Changes the simulated sonar, between pings.
  /// @param notes  Gets what differs from what is asked.
  /// @throws Error where it refuses; then nothing has changed.
  [[nodiscard]] std::shared_ptr<const Settings> apply(const OculusFire& asked, std::vector<std::string>& notes);

  /// Makes a ping. The settings are those applied last.
  /// @throws Error as EmulatedSonar::ping(); Interrupted at SIGINT.
  [[nodiscard]] Heard make(const Settings& settings);

  /// All but the network's part. May be called while a ping is made.
  [[nodiscard]] OculusStatus status() const;

 private:
  EmulatedSonar& sonar_;
  OculusModes modes_;
  std::optional<OculusFire> applied_;  // The members that act on the simulated sonar.
  std::uint32_t number_ = 0;
};

}  // namespace insonify
