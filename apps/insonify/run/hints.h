// hints.h -- hints for a run without echoes or with pictures that are nearly black.

#pragma once

#include "insonify/ping.h"
#include "insonify/simulator.h"

namespace insonify {

/// Largest echo of one sonar's pings.
class Loudness {
 public:
  void add(const Ping& ping);

  [[nodiscard]] bool has_echo() const { return loudest_ >= 0; }  ///< Whether there was any echo.
  [[nodiscard]] double loudest() const { return loudest_; }  ///< Intensity of the largest echo; -1 if there was none.
  [[nodiscard]] bool dim() const { return has_echo() && loudest_ < 0.02; }

 private:
  double loudest_ = -1;
};

/// Whether the scenario has echoes without a surface, which have no label: points, the water, or other sonars.
[[nodiscard]] bool receives_more_than_surfaces(const Scenario& scenario);

/// "nothing was received in any ping of fls: ...", with the extent of the world, the sonar's pose, and its
/// settings that silence bins or beams.
[[nodiscard]] std::string silence_text(const Simulator& simulator, int sonar);

/// "the loudest echo of fls is 1.2 % of full scale: ...", with the key that changes it.
[[nodiscard]] std::string dimness_text(const Loudness& loudness, const SonarConfig& sonar);

}  // namespace insonify
