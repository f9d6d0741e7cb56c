// interference.h -- pulses received from other sonars.

#pragma once

#include <cstdint>
#include <span>

#include "echo/targets/lines_of_sight.h"
#include "insonify/interferer.h"

namespace insonify {

/// A pulse from another source, as one sonar receives it.
struct ArrivingPulse {
  int beam;            ///< Beam of the EchoGrid.
  float bearing_sine;  ///< Sine of the bearing of arrival.
  float intensity;
  double begins;         ///< Arrival of its start after the receiving sonar's transmission [s]; may be negative.
  double duration;       ///< [s]
  std::uint32_t source;  ///< Index of its source. With `number`, selects its random phases, one per bin.
  std::int64_t number;   ///< Index of the pulse.
};

/// Adds a pulse to the EchoGrid's discrete echoes, in all bins that it overlaps.
void add_pulse(const PingPlan& plan, const ArrivingPulse& pulse, EchoGrid& grid);

/// Adds the pulses of other sonars to the EchoGrid as discrete echoes, in the bins of their times of arrival.
/// Calibrated model only. Their level is the other's source level relative to this sonar's, minus the one-way
/// transmission loss 20 log10 r + alpha r, times the receiver's elevation pattern.
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
