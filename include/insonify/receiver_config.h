// receiver_config.h -- what a receiver makes of what arrives.

#pragma once

#include <optional>

#include "insonify/field.h"

namespace insonify {

/// What the receiver adds. The calibrated model's part of it says so.
struct ReceiverConfig {
  bool noise = true;  ///< Whether noise is drawn at all: the paper model's, or the calibrated model's thermal noise.

  /// Calibrated model: X of the gain X log10(r) + 2 alpha r [dB] that the recording is raised by, r in metres and alpha
  /// the water's absorption; 0..60. None: raw. 40 evens out point targets, 30 floors, 20 water's reverberation.
  std::optional<double> time_varied_gain = {};

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"noise", "", {}, "Whether noise is drawn: the paper model's own, or thermal noise (calibrated)."},
          self.noise);
    visit(Field{"time_varied_gain", "dB/decade", from_to(0, 60),
                "X of the gain X log10(r / 1 m) + 2 alpha r that intensities are recorded with (calibrated); none for "
                "raw."},
          self.time_varied_gain);
  }
};

}  // namespace insonify
