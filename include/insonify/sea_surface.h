// sea_surface.h -- the sea surface above the sonar: level, wind, and its acoustic properties as a material.

#pragma once

#include "insonify/material.h"
#include "insonify/settings_table.h"

namespace insonify {

/// A horizontal sea surface, roughened by wind.
struct SeaSurface {
  double level = 0;       ///< Height of the mean surface in the world [m], within 1e7.
  double wind_speed = 0;  ///< Wind speed 10 m above it [m/s], 0..30; 0 is a flat mirror.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"level", "m", coordinate(), "Height of the mean surface in the world (z)."}, self.level);
    visit(Field{"wind_speed", "m/s", from_to(0, 30),
                "Wind speed 10 m above the sea, which sets roughness and bubbles; 0 is a flat mirror."},
          self.wind_speed);
  }
};

/// The sea surface at one frequency, as a material of the calibrated model. The rms slope is that of Cox and Munk, J.
/// Opt. Soc. Am. 44(11), 838 (1954): a total variance of 0.003 + 0.00512 U, half of it along each axis, and the rms
/// height a quarter of the significant wave height 0.21 U^2/g of Pierson and Moskowitz, J. Geophys. Res. 69(24), 5181
/// (1964): at sonar frequencies waves leave no coherent reflection but near grazing incidence. Backscatter and the loss
/// to bubbles are those of TR 9407 (acoustics/surface_scattering.h) at every angle; Material::reflection is that
/// straight up. Without wind the surface is a lossless mirror.
/// @param frequency  [Hz], > 0.
[[nodiscard]] Material sea_surface_material(const SeaSurface& surface, double frequency);

}  // namespace insonify
