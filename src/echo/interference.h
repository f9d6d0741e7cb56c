// interference.h -- what is heard of other sonars.

#pragma once

#include <span>
#include <vector>

#include "echo/ping_plan.h"
#include "insonify/engine.h"
#include "insonify/interferer.h"

namespace insonify {

/// The pulses of other sonars, as lone echoes of a grid of the calibrated model: their source level over this sonar's,
/// less 20 log10 r + alpha r for the one way, heard by the elevation pattern, in the bins of the time when they arrive.
class Interference {
 public:
  explicit Interference(std::span<const Interferer> interferers);

  /// @param time  Of transmission [s].
  void add(const PingPlan& plan, const Pose& world_from_sonar, double time, Engine& engine, EchoGrid& grid);

 private:
  std::span<const Interferer> interferers_;
  std::vector<Ray> rays_;  // From the sonar to each.
  std::vector<Hit> hits_;
};

}  // namespace insonify
