// calibrated_receiver.h -- from an EchoGrid to a Ping in the `calibrated` model.

#pragma once

#include <vector>

#include "base/parallel.h"
#include "insonify/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "insonify/water.h"
#include "receiver/heard_tile.h"

namespace insonify {

/// Each cell reads the sum of the echo intensities that arrive in it, over all path orders, relative to the source's at
/// 1 m: 10 log10 of it is EL - SL. Thermal noise, a complex Gaussian field drawn anew for each ping and cell, is added
/// to the field before it is detected: intensities gain its mean. Then the ramp of the near field and time-varied gain.
class CalibratedReceiver {
 public:
  CalibratedReceiver(const SonarConfig& sonar, const Water& water, const ReceiverConfig& config, std::uint64_t seed);

  /// Fills the tables of a ping, whose number is read; allocates only when they need more memory than before.
  void hear(const EchoGrid& grid, Workers& workers, Ping& ping) const;

  /// Mean intensity of the noise in a cell, relative to the source's at 1 m: NL + 10 log10 B - DI - SL.
  [[nodiscard]] double noise_intensity() const { return noise_intensity_; }

 private:
  void hear_tile(const EchoGrid& grid, const TilePlace& place, Ping& ping) const;

  std::vector<float> gain_;  // Of each bin: near field and time-varied gain.
  double noise_intensity_ = 0;
  bool noisy_;
  std::uint64_t seed_;
};

}  // namespace insonify
