// material.h -- what a surface is made of, as far as sound can tell.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "insonify/field.h"
#include "insonify/relief.h"

namespace insonify {

/// Somewhat above osmium [kg/m^3] and diamond [m/s]: what is beyond is a slip in units.
inline constexpr double kGreatestDensity = 30000;
inline constexpr double kGreatestSoundSpeed = 20000;

/// Acoustic properties of a surface.
struct Material {
  std::string name = {};      ///< Lower case, as written in scenes.
  double density = 2500;      ///< [kg/m^3], in (0, 30000].
  double sound_speed = 3000;  ///< Of compressional waves [m/s], in (0, 20000].
  std::optional<double> reflectivity =
      {};                   ///< Share of the echo amplitude that the `paper` model keeps, 0..1; |R| when absent.
  std::string source = {};  ///< Where the numbers come from.
  std::shared_ptr<const Relief> relief = {};  ///< Of every surface made of it; null: that of the mesh, if any.

  /// Pressure reflection coefficient at normal incidence against water of the given impedance [kg/(m^2 s)], -1..1:
  /// (Z2 - Z1)/(Z2 + Z1).
  [[nodiscard]] double reflection_coefficient(double water_impedance) const;

  /// `reflectivity` if given, else |reflection_coefficient| against sea water.
  [[nodiscard]] double effective_reflectivity() const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"density", "kg/m^3", above_to(0, kGreatestDensity), "Density."}, self.density);
    visit(Field{"sound_speed", "m/s", above_to(0, kGreatestSoundSpeed), "Speed of compressional waves."},
          self.sound_speed);
    visit(Field{"reflectivity", "", from_to(0, 1),
                "Share of the echo amplitude that the paper model keeps; from the impedance when absent."},
          self.reflectivity);
  }
};

/// Impedance of sea water that the library's reflectivities refer to: 1026 kg/m^3 x 1500 m/s.
inline constexpr double kSeaWaterImpedance = 1026.0 * 1500.0;

/// Every material known by name, in alphabetical order. Typical values, +-5 %.
[[nodiscard]] std::span<const Material> material_library();

/// The library's material of that name (case does not matter; '_', '-' and ' ' are alike), or null.
[[nodiscard]] const Material* find_material(std::string_view name);

}  // namespace insonify
