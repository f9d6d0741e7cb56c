// interference.h -- what is heard of other sonars.

#pragma once

#include <span>

#include "echo/targets/lines_of_sight.h"
#include "insonify/interferer.h"

namespace insonify {

/// The pulses of other sonars, as discrete echoes of a grid of the calibrated model: their source level over this
/// sonar's, less 20 log10 r + alpha r for the one way, heard by the elevation pattern, in the bins of the time when
/// they arrive.
class Interference {
 public:
  explicit Interference(std::span<const Interferer> interferers);

  /// Adds to the grid's discrete echoes.
  /// @param time  Of transmission [s].
  void add(const PingPlan& plan, const Pose& world_from_sonar, double time, Engine& engine, EchoGrid& grid);

 private:
  void add_pulses(const PingPlan& plan, std::size_t index, const LinesOfSight::Sight& sight, double time,
                  EchoGrid& grid);

  std::span<const Interferer> interferers_;
  LinesOfSight ways_;
};

}  // namespace insonify
