// sea_surface.h -- the water's surface above the sonar.

#pragma once

#include "insonify/field.h"
#include "insonify/material.h"

namespace insonify {

struct SeaSurface {
  double level = 0;       ///< Height of its mean in the world [m], within 1e7.
  double wind_speed = 0;  ///< 10 m above it [m/s], 0..30; 0 is a flat mirror.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"level", "m", coordinate(), "Height of the mean surface in the world (z)."}, self.level);
    visit(Field{"wind_speed", "m/s", from_to(0, 30), "10 m above the sea: roughness and bubbles; 0 is a flat mirror."},
          self.wind_speed);
  }
};

/// What the surface is to sound of a frequency, as a material of the calibrated model. Slopes after Cox and Munk,
/// J. Opt. Soc. Am. 44(11), 838 (1954), variance 0.003 + 0.00512 U in all, half along each axis; the loss to bubbles
/// and the diffuse echo after TR 9407 (surface_scattering.h) at 20 degrees of grazing, under which a forward-looking
/// sonar mostly meets it. Without wind a mirror that loses nothing.
/// @param frequency  [Hz], > 0.
[[nodiscard]] Material sea_surface_material(const SeaSurface& surface, double frequency);

}  // namespace insonify
