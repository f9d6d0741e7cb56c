// water.h -- properties of the water: temperature, salinity, depth, sound speed, absorption, volume backscatter.

#pragma once

#include <optional>
#include <vector>

#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/settings_table.h"

namespace insonify {

/// A body of water, homogeneous but for its sound speed where that has a profile. Limits are those of the absorption
/// formula (acoustics/absorption.h) and, for salinity 0, of the sound-speed formula (acoustics/sound_speed.h).
struct Water {
  double temperature_c = 10.0;             ///< Temperature [degC], -6..35.
  double salinity = 35.0;                  ///< Practical salinity [PSU], 0..50. Zero is fresh water.
  double ph = 8.0;                         ///< Acidity [pH], 6.5..8.5 (the formula was fitted from 7.7 to 8.3).
  double depth = 0.0;                      ///< Depth of the sonar below the surface [m], 0..7000.
  std::optional<double> sound_speed = {};  ///< True sound speed [m/s], 1300..1700; absent: from the above.
  bool absorption = true;                  ///< Whether the water absorbs sound at all.
  std::optional<double> absorption_db_per_m =
      {};  ///< One way, at all frequencies [dB/m], 0..10; absent: from the above.

  std::optional<double> volume_backscatter_db = {};  ///< S_v, volume backscattering strength [dB re 1/m], -150..-20;
                                                     ///< absent: no volume reverberation.
  std::vector<ProfilePoint> profile = {};            ///< Sound speed by depth; empty: the same everywhere.

  /// The sound speed of the profile at this depth; else the given one; else that of Chen and Millero at this
  /// temperature, salinity and depth [m/s].
  [[nodiscard]] double true_sound_speed() const;

  /// One-way absorption: the given one, else after Ainslie and McColm; 0 when switched off [dB/m].
  /// @param frequency [Hz], > 0.
  [[nodiscard]] double absorption_db_per_m_at(double frequency) const;

  /// @throws Error on the first field out of limits, also of the profile, and for both a profile and a sound speed.
  void validate() const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"temperature_c", "degC", from_to(-6, 35), "Water temperature."}, self.temperature_c);
    visit(Field{"salinity", "PSU", from_to(0, 50), "Practical salinity; 0 is fresh water."}, self.salinity);
    visit(Field{"ph", "pH", from_to(6.5, 8.5), "Acidity."}, self.ph);
    visit(Field{"depth", "m", from_to(0, 7000), "Depth of the sonar below the surface."}, self.depth);
    visit(Field{"sound_speed", "m/s", from_to(1300, 1700),
                "True sound speed; from temperature, salinity and depth when absent."},
          self.sound_speed);
    visit(Field{"absorption", "", {}, "Whether the water absorbs sound."}, self.absorption);
    visit(Field{"absorption_db_per_m", "dB/m", from_to(0, 10),
                "Absorption one way; by frequency from temperature, salinity, pH and depth when absent."},
          self.absorption_db_per_m);
    visit(Field{"volume_backscatter_db", "dB", from_to(-150, -20),
                "Volume backscattering strength S_v re 1/m: -85 in clear, -70 in coastal, -50 in turbid water; no "
                "volume reverberation when absent (calibrated model).",
                ActsIn::kCalibrated},
          self.volume_backscatter_db);
  }

  template <typename Self, typename Visit>
  static void visit_parts(Self& self, Visit&& visit) {
    visit(Part{"profile", "list of points", "Sound speed by depth, which bends rays: see `profile`.",
               "One entry for each point of the profile, from the surface down: `{depth: 5, sound_speed: 1500}`, or "
               "with `temperature_c` and `salinity`. Speed is linear between them. Instead of the list, a file: "
               "`profile: cast.svp` ([formats](../concepts/sound-speed-profile.md#files))."},
          self.profile);
  }
};

}  // namespace insonify
