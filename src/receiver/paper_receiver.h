// paper_receiver.h -- turns an EchoGrid into a Ping in the `paper` model.

#pragma once

#include "base/parallel.h"
#include "echo/grid/echo_grid.h"
#include "insonify/paper_model.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "receiver/output_tile.h"

namespace insonify {

struct PaperReceiverSettings {
  PaperModel model = {};
  bool noise = true;
  std::uint64_t seed = 1;
};

/// Receiver of the paper model (docs/concepts/paper-model.md), after Cerqueira et al. (2020), section "Generating the
/// sonar image on CPU". In each beam and bin, I = min(1, mean S over primary echoes + mean S over secondary echoes). To
/// this comes noise, I x eta_m + eta_a, independent for each ping, beam and bin; then the sonar's gain and the
/// near-field ramp; the result is clipped to 0..1.
class PaperReceiver {
 public:
  /// Sizes the tables of `ping`, whose number must be set. All arguments must outlive the receiver.
  PaperReceiver(const EchoGrid& grid, const SonarConfig& sonar, const PaperReceiverSettings& settings, Ping& ping);

  /// Receives all beams of the grid.
  void receive(Workers& workers);

 private:
  void receive_tile(const TilePlace& place);

  const EchoGrid& grid_;
  const SonarConfig& sonar_;
  PaperReceiverSettings settings_;
  Ping& ping_;
};

}  // namespace insonify
