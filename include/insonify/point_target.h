// point_target.h -- an ideal point target: no extent, the same target strength from every direction.

#pragma once

#include "insonify/geometry.h"
#include "insonify/settings_table.h"

namespace insonify {

/// Echoes with its target strength in the calibrated model, where the line of sight is clear.
struct PointTarget {
  Vec3 position = Vec3::Zero();   ///< In the world [m], within 1e7.
  double target_strength_db = 0;  ///< TS [dB re 1 m^2], -200..100.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"position", "m", coordinate(), "[x, y, z] in the world."}, self.position);
    visit(Field{"target_strength_db", "dB", from_to(-200, 100), "Target strength re 1 m^2, the same from every side."},
          self.target_strength_db);
  }
};

}  // namespace insonify
