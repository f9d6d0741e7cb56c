// interferer.h -- another sonar whose pulses interfere with this one's reception.

#pragma once

#include "insonify/geometry.h"
#include "insonify/settings_table.h"

namespace insonify {

/// Transmits pulses at regular times. This sonar receives them on the direct path, if it is clear, as arcs whose range
/// changes from ping to ping (calibrated model).
struct Interferer {
  Vec3 position = Vec3::Zero();  ///< In the world [m], within 1e7.
  double source_level_db = 200;  ///< Source level within this sonar's receiver bandwidth [dB re 1 uPa at 1 m], 0..260.
  double period = 0.25;          ///< Time between pulses [s], 1e-3..1e6.
  double first_pulse = 0;        ///< Time of one of the pulses [s], 0..1e6.
  double duration = 1e-4;        ///< Pulse duration [s], in (0, 1].

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"position", "m", coordinate(), "[x, y, z] in the world."}, self.position);
    visit(Field{"source_level_db", "dB", from_to(0, 260),
                "Source level re 1 uPa at 1 m, within this sonar's receiver bandwidth."},
          self.source_level_db);
    visit(Field{"period", "s", from_to(1e-3, 1e6), "Time between pulses."}, self.period);
    visit(Field{"first_pulse", "s", from_to(0, 1e6), "Time of one of the pulses."}, self.first_pulse);
    visit(Field{"duration", "s", above_to(0, 1), "Pulse duration."}, self.duration);
  }
};

}  // namespace insonify
