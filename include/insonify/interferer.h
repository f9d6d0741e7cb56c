// interferer.h -- another sonar that sends while this one listens.

#pragma once

#include "insonify/field.h"
#include "insonify/geometry.h"

namespace insonify {

/// Sends pulses of its own at regular times, which this sonar hears straight from there as arcs that jump from ping to
/// ping (calibrated model), if nothing stands between the two.
struct Interferer {
  Vec3 position = Vec3::Zero();  ///< In the world [m], within 1e7.
  double source_level_db = 200;  ///< Within the band that this sonar hears [dB re 1 uPa at 1 m], 0..260.
  double period = 0.25;          ///< From pulse to pulse [s], 1e-3..1e6.
  double first_pulse = 0;        ///< Time of one of them [s], 0..1e6.
  double duration = 1e-4;        ///< Of a pulse [s], in (0, 1].

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"position", "m", coordinate(), "[x, y, z] in the world."}, self.position);
    visit(Field{"source_level_db", "dB", from_to(0, 260), "Re 1 uPa at 1 m, within the band that this sonar hears."},
          self.source_level_db);
    visit(Field{"period", "s", from_to(1e-3, 1e6), "From pulse to pulse."}, self.period);
    visit(Field{"first_pulse", "s", from_to(0, 1e6), "When one of them is sent."}, self.first_pulse);
    visit(Field{"duration", "s", above_to(0, 1), "Of a pulse."}, self.duration);
  }
};

}  // namespace insonify
