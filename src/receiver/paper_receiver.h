// paper_receiver.h -- from an EchoGrid to a Ping in the `paper` model.

#pragma once

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

/// Paper, section "Generating the sonar image on CPU". Each cell reads min(1, mean S over primary echoes + mean S over
/// secondary echoes); then noise, I x eta_m + eta_a, drawn anew for each ping and cell; then the sonar's gain and the
/// ramp of its near field; clipped to 0..1.
class PaperReceiver final : public BeamSink {
 public:
  /// Sizes the tables of `ping`, which are then reused; its number is read. All must outlive the receiver.
  PaperReceiver(const EchoGrid& grid, const SonarConfig& sonar, const PaperReceiverSettings& settings, Ping& ping);

  void take(int first_beam, int last_beam) override;

 private:
  void hear_tile(const TilePlace& place);

  const EchoGrid& grid_;
  const SonarConfig& sonar_;
  PaperReceiverSettings settings_;
  Ping& ping_;
};

}  // namespace insonify
