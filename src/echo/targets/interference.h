// interference.h -- pulses received from other sonars.

#pragma once

#include <cstdint>
#include <span>

#include "echo/batch/echo_source.h"
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

/// Adds a pulse to the discrete echoes, in all bins that it overlaps.
void add_pulse(const FlatPlan& plan, const ArrivingPulse& pulse, EchoList& echoes);

/// Pulses of other sonars, as discrete echoes in the bins of their times of arrival.
/// Calibrated model only. Their level is the other's source level relative to this sonar's, minus the one-way
/// transmission loss 20 log10 r + alpha r, times the receiver's elevation pattern.
class Interference final : public EchoSource {
 public:
  /// @param has_array  Whether the receiving beams have side lobes across bearings, through which the sonar receives
  ///                   sound from beside its fan.
  Interference(std::span<const Interferer> interferers, bool has_array);

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  void add_pulses(const FlatPlan& plan, std::size_t index, const LinesOfSight::Sight& sight, double time,
                  EchoList& found);

  std::span<const Interferer> interferers_;
  bool has_array_;
  LinesOfSight lines_;
};

}  // namespace insonify
