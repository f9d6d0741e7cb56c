// calibrated_receiver.h -- from an EchoGrid to a Ping in the `calibrated` model.

#pragma once

#include "insonify/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "receiver/heard_tile.h"

namespace insonify {

/// Each cell reads the sum of the echo intensities that arrive in it, relative to the source's at 1 m, over all path
/// orders: 10 log10 of it is the echo level less the source level. Times the ramp of the near field.
class CalibratedReceiver final : public BeamSink {
 public:
  /// Sizes the tables of `ping`, which are then reused. All must outlive the receiver.
  CalibratedReceiver(const EchoGrid& grid, const SonarConfig& sonar, Ping& ping);

  void take(int first_beam, int last_beam) override;

 private:
  void hear_tile(const TilePlace& place);

  const EchoGrid& grid_;
  const SonarConfig& sonar_;
  Ping& ping_;
};

}  // namespace insonify
