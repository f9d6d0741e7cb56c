// hints.h -- what to tell of a run that nobody will like: silence, or pictures that are nearly black.

#pragma once

#include "insonify/ping.h"
#include "insonify/simulator.h"

namespace insonify {

/// How loud one sonar's pings are.
class Loudness {
 public:
  void add(const Ping& ping);

  [[nodiscard]] bool heard() const { return loudest_ >= 0; }  ///< Whether anything echoed.
  [[nodiscard]] double loudest() const { return loudest_; }   ///< Intensity of the loudest echo; -1 for silence.
  [[nodiscard]] bool dim() const { return heard() && loudest_ < 0.02; }

 private:
  double loudest_ = -1;
};

/// Whether there are echoes without a surface, which no label tells: of points, of the water, or of other sonars.
[[nodiscard]] bool hears_more_than_surfaces(const Scenario& scenario);

/// "nothing was heard in any ping of fls: ...", with where the world is and where the sonar looked.
[[nodiscard]] std::string silence_text(const Simulator& simulator, int sonar);

/// "the loudest echo of fls is 1.2 % of full scale: ...", with the key that changes it.
[[nodiscard]] std::string dimness_text(const Loudness& loudness, const SonarConfig& sonar);

}  // namespace insonify
