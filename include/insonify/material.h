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

/// How a surface scatters sound in the `calibrated` model, see backscatter.
struct Scattering {
  double lambert = 0;     ///< mu: backscattering strength is mu cos^2 of incidence, plus the lobe's [1/sr].
  double reflection = 0;  ///< |R| at normal incidence: drives the lobe and what is sent on.
  double rms_slope = 0;   ///< Of the facets that make the lobe, along each axis.
};

/// 10 log10(1/pi): a Lambert surface that turns back all that it meets.
inline constexpr double kGreatestLambertDb = -4.971498726941338;

/// Visits what a material and a change of one have in common.
template <typename Self, typename Visit>
void visit_material_fields(Self& self, Visit&& visit) {
  visit(Field{"density", "kg/m^3", above_to(0, kGreatestDensity), "Density."}, self.density);
  visit(Field{"sound_speed", "m/s", above_to(0, kGreatestSoundSpeed), "Speed of compressional waves."},
        self.sound_speed);
  visit(Field{"reflectivity", "", from_to(0, 1),
              "Share of the echo amplitude that the paper model keeps; from the impedance when absent."},
        self.reflectivity);
  visit(Field{"lambert_db", "dB", from_to(-200, kGreatestLambertDb),
              "Diffuse part: 10 log10 of backscattering strength head on (calibrated model)."},
        self.lambert_db);
  visit(Field{"reflection", "", from_to(0, 1),
              "|R| of sound that meets it head on (calibrated model); from density, sound speed and thickness when "
              "absent."},
        self.reflection);
  visit(Field{"thickness", "m", above_to(0, 1000),
              "Of a plate with water on both sides (calibrated model); filled with it when absent."},
        self.thickness);
  visit(Field{"rms_slope", "", from_to(0.005, 1),
              "Of its small facets, along each axis: how wide the glint is (calibrated model)."},
        self.rms_slope);
  visit(
      Field{
          "clutter_shape", "", from_to(0.1, 1000),
          "Shape of K-distributed clutter, the less the patchier (calibrated model, with speckle); none when absent."},
      self.clutter_shape);
  visit(
      Field{"scatterer_density", "1/m^2", above_to(0, 1e9),
            "Of equal scatterers: where they are few their echoes glitter (calibrated model, with speckle); countless "
            "when absent."},
      self.scatterer_density);
}

/// Acoustic properties of a surface.
struct Material {
  std::string name = {};      ///< Lower case, as written in scenes.
  double density = 2500;      ///< [kg/m^3], in (0, 30000].
  double sound_speed = 3000;  ///< Of compressional waves [m/s], in (0, 20000].
  std::optional<double> reflectivity =
      {};                   ///< Share of the echo amplitude that the `paper` model keeps, 0..1; |R| when absent.
  double lambert_db = -20;  ///< 10 log10 of Scattering::lambert, -200 to that of a white surface.
  std::optional<double> reflection = {};     ///< |R|, 0..1; see reflection_at() when absent.
  std::optional<double> thickness = {};      ///< Of a plate with water on both sides [m], in (0, 1000]; absent: filled.
  double rms_slope = 0.1;                    ///< Of small facets, along each axis, 0.005..1.
  std::optional<double> clutter_shape = {};  ///< Of K-distributed clutter, 0.1..1000: the less the patchier; or none.
  std::optional<double> scatterer_density = {};  ///< Of equal scatterers [1/m^2], in (0, 1e9]; absent: countless.
  std::string source = {};                       ///< Where the numbers come from.
  std::shared_ptr<const Relief> relief = {};     ///< Of every surface made of it; null: that of the mesh, if any.

  /// Pressure reflection coefficient at normal incidence against water of the given impedance [kg/(m^2 s)], -1..1:
  /// (Z2 - Z1)/(Z2 + Z1).
  [[nodiscard]] double reflection_coefficient(double water_impedance) const;

  /// `reflectivity` if given, else |reflection_coefficient| against sea water.
  [[nodiscard]] double effective_reflectivity() const;

  /// |R| in sea water head on, for the `calibrated` model: `reflection` if given; of a plate of some `thickness` see
  /// plate_reflection(); else |reflection_coefficient|.
  /// @param frequency  [Hz], > 0.
  [[nodiscard]] double reflection_at(double frequency) const;

  /// What the `calibrated` model makes of it at a frequency [Hz].
  [[nodiscard]] Scattering scattering(double frequency) const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit_material_fields(self, visit);
  }
};

/// Impedance of sea water that the library's reflectivities refer to: 1026 kg/m^3 x 1500 m/s.
inline constexpr double kSeaWaterImpedance = 1026.0 * 1500.0;

/// Every material known by name, in alphabetical order. Typical values, +-5 %.
[[nodiscard]] std::span<const Material> material_library();

/// The library's material of that name (case does not matter; '_', '-' and ' ' are alike), or null.
[[nodiscard]] const Material* find_material(std::string_view name);

}  // namespace insonify
