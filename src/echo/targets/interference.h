// interference.h -- pulses received from other sonars.

#pragma once

#include <cstdint>
#include <span>

#include "echo/targets/lines_of_sight.h"
#include "insonify/interferer.h"

namespace insonify {

/// A pulse that arrives from elsewhere, as one sonar receives it.
struct ArrivingPulse {
  int beam;            ///< Cell of the grid.
  float bearing_sine;  ///< Sine of the bearing that it arrives from.
  float intensity;
  double begins;         ///< After transmission of the sonar that receives it [s]; may be negative.
  double duration;       ///< [s]
  std::uint32_t source;  ///< Number of its source, and of ...
  std::int64_t number;   ///< ... the pulse: start of its random phases, which differ from bin to bin.
};

/// Adds a pulse to a grid's discrete echoes, in the bins of its time.
void add_pulse(const PingPlan& plan, const ArrivingPulse& pulse, EchoGrid& grid);

/// Adds the pulses of other sonars to a grid of the calibrated model as discrete echoes, in the bins of their times of
/// arrival. Their level is the other's source level relative to this sonar's, less the one-way transmission loss 20
/// log10 r
/// + alpha r, times the elevation pattern of reception.
class Interference {
 public:
  explicit Interference(std::span<const Interferer> interferers);

  /// Adds to the grid's discrete echoes.
  /// @param time       Time of this sonar's transmission [s].
  /// @param has_array  Whether its beams have side lobes across bearings, through which it hears beside its fan.
  void add(const PingPlan& plan, const Pose& world_from_sonar, double time, bool has_array, Engine& engine,
           EchoGrid& grid);

 private:
  void add_pulses(const PingPlan& plan, std::size_t index, const LinesOfSight::Sight& sight, double time,
                  EchoGrid& grid);

  std::span<const Interferer> interferers_;
  LinesOfSight lines_;
};

}  // namespace insonify
