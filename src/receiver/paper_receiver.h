// paper_receiver.h -- from an EchoGrid to a Ping in the `paper` model.

#pragma once

#include "base/parallel.h"
#include "insonify/echo_grid.h"
#include "insonify/paper_model.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

struct PaperReceiverSettings {
  PaperModel model = {};
  bool noise = true;
  std::uint64_t seed = 1;
};

/// Paper, section "Generating the sonar image on CPU". Each cell reads min(1, mean S over primary echoes + mean S over
/// secondary echoes); then noise, I x eta_m + eta_a, drawn anew for each ping and cell; then the sonar's gain and the
/// ramp of its near field; clipped to 0..1. Tables of `ping` are resized once and then reused; its number is read.
void receive_paper(const EchoGrid& grid, const SonarConfig& sonar, const PaperReceiverSettings& settings,
                   Workers& workers, Ping& ping);

}  // namespace insonify
