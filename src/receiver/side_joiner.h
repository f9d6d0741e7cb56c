// side_joiner.h -- makes one ping of those of a side-scan sonar's two sides.

#pragma once

#include <optional>
#include <span>

#include "insonify/engine.h"
#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "receiver/digitizer.h"

namespace insonify {

/// The last steps of a side-scan sonar's receiver, which both sides share: crosstalk, which adds a share of both sides'
/// echoes to each (the sum of fields with speckle, of energies without), then counts. Port becomes beam 0.
class SideJoiner {
 public:
  /// @param receiver  Of the sonar.
  SideJoiner(const SonarConfig& sonar, EchoModel model, const ReceiverConfig& receiver);

  /// Writes all tables of `ping`; allocates only when they need more memory than before.
  /// @param sides         Pings of port and starboard, each of one beam, with fields where there is crosstalk of
  /// fields.
  /// @param covered_bins  Bins in which the transmit leak is above the noise, from the first.
  void join(std::span<const Ping* const, 2> sides, int covered_bins, Ping& ping);

 private:
  void add_crosstalk(const Ping& own, const Ping& other, int beam, Ping& ping) const;

  float depression_;  // [rad]
  float crosstalk_;   // Amplitude; 0: none.
  bool has_field_;
  std::optional<Digitizer> digitizer_;
};

}  // namespace insonify
