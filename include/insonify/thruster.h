// thruster.h -- a thruster of the vehicle, whose noise the sonars receive.

#pragma once

#include <numbers>
#include <string_view>

#include "insonify/geometry.h"
#include "insonify/settings_table.h"

namespace insonify {

/// Broadband noise of a running propeller on the vehicle. Each sonar receives it in all bins at the bearing of the
/// thruster: a spoke in the picture. Calibrated model only.
///
/// The noise is Gaussian, and its spectrum level changes by `slope`: by -20 dB per decade for cavitation (Ross,
/// Mechanics of Underwater Noise (1976), ch. 8). The passing blades modulate its intensity by the factor 1 + modulation
/// cos(2 pi blade_rate t + blade_phase) (Lourens and du Preez, IEEE J. Oceanic Eng. 23(4), 448 (1998)).
struct Thruster {
  Vec3 position = Vec3::Zero();  ///< Position on the vehicle [m], within 1e7; at least 1 cm from every sonar.
  double level_db = 110;         ///< Source spectrum level at `frequency` [dB re 1 uPa^2/Hz at 1 m], -100..260.
  double frequency = 10e3;       ///< Frequency of level_db [Hz], in (0, 1e8].
  double slope = -20;            ///< Change of that level towards higher frequencies [dB/decade], -100..100.
  double blade_rate = 0;         ///< Blades passing per second [Hz], 0..1e4; 0: no modulation.
  double modulation = 0;         ///< Depth of the intensity's modulation, 0..1.
  double blade_phase = 0;        ///< Phase of the modulation at time 0 [rad], within 1e6 deg.

  /// Spectrum level at a frequency [dB re 1 uPa^2/Hz at 1 m].
  [[nodiscard]] double spectrum_db(double at) const;

  /// @param object  Its name in messages.
  /// @throws Error if one of blade_rate and modulation is given without the other.
  void validate(std::string_view object) const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"position", "m", coordinate(), "[x, y, z] on the vehicle."}, self.position);
    visit(Field{"level_db", "dB", from_to(-100, 260), "Source spectrum level at `frequency`, re 1 uPa^2/Hz at 1 m."},
          self.level_db);
    visit(Field{"frequency", "Hz", above_to(0, 1e8), "Frequency of level_db."}, self.frequency);
    visit(Field{"slope", "dB/decade", from_to(-100, 100), "Change of the spectrum towards higher frequencies."},
          self.slope);
    visit(Field{"blade_rate", "Hz", from_to(0, 1e4), "Blades passing per second, which modulate the noise; 0: none."},
          self.blade_rate);
    visit(Field{"modulation", "", from_to(0, 1), "Depth of the intensity's modulation."}, self.modulation);
    visit(Field{"blade_phase", "rad", turn(), "Phase of the modulation at time 0."}, self.blade_phase);
  }
};

}  // namespace insonify
