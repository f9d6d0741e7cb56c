// material.h -- acoustic properties of surfaces, and the library of named materials.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "insonify/relief.h"
#include "insonify/scattering.h"
#include "insonify/settings_table.h"

namespace insonify {

/// Greatest density [kg/m^3] and sound speed [m/s] accepted: above those of osmium and diamond, so that values beyond
/// them must be in wrong units.
inline constexpr double kGreatestDensity = 30000;
inline constexpr double kGreatestSoundSpeed = 20000;

/// 10 log10(1/pi): a Lambert surface that scatters back into the water all the energy that falls on it.
inline constexpr double kGreatestLambertDb = -4.971498726941338;

/// Visits the fields that Material and MaterialOverride have in common.
template <typename Self, typename Visit>
void visit_material_fields(Self& self, Visit&& visit) {
  visit(Field{"density", "kg/m^3", above_to(0, kGreatestDensity), "Density."}, self.density);
  visit(Field{"sound_speed", "m/s", above_to(0, kGreatestSoundSpeed), "Speed of compressional waves."},
        self.sound_speed);
  visit(Field{"shear_speed", "m/s", above_to(0, kGreatestSoundSpeed),
              "Speed of shear waves in a solid, below 0.86 of the sound speed, for reflection at oblique incidence "
              "(calibrated model); a fluid when absent.",
              ActsIn::kCalibrated},
        self.shear_speed);
  visit(Field{"loss", "", from_to(0, 1),
              "Absorption in the material: imaginary over real part of the wavenumber (calibrated model).",
              ActsIn::kCalibrated},
        self.loss);
  visit(Field{"reflectivity", "", from_to(0, 1),
              "Amplitude reflectivity of the paper model; from the impedance when absent.", ActsIn::kPaper,
              "reflection for mirrors and glints, lambert_db for diffuse echoes"},
        self.reflectivity);
  visit(Field{"lambert_db", "dB", from_to(-200, kGreatestLambertDb),
              "Diffuse part: 10 log10 of the Lambert parameter mu (calibrated model).", ActsIn::kCalibrated,
              "reflectivity"},
        self.lambert_db);
  visit(Field{"reflection", "", from_to(0, 1),
              "Magnitude of the pressure reflection coefficient at normal incidence (calibrated model); from density, "
              "sound speed and thickness when absent.",
              ActsIn::kCalibrated, "reflectivity"},
        self.reflection);
  visit(Field{"thickness", "m", above_to(0, 1000),
              "Thickness of a plate with water on both sides (calibrated model); solid when absent.",
              ActsIn::kCalibrated, "reflectivity"},
        self.thickness);
  visit(Field{"transmission", "", from_to(0, 1),
              "Magnitude of the pressure transmission coefficient at all angles (calibrated model); when absent that "
              "of a plate of this thickness, none of a solid. At most what reflection and diffuse scattering leave.",
              ActsIn::kCalibrated},
        self.transmission);
  visit(
      Field{
          "open_share", "", from_to(0, 1),
          "Share of the area that is open, as in a net or a grating modelled as one surface: 1 minus its solidity. The "
          "open part transmits all sound (calibrated model); all other properties are those of the rest of the area.",
          ActsIn::kCalibrated},
      self.open_share);
  visit(Field{"rms_slope", "", from_to(0.005, 1),
              "Root mean square slope of small facets along each axis, which sets the width of the specular lobe "
              "(calibrated model).",
              ActsIn::kCalibrated, "reflectivity"},
        self.rms_slope);
  visit(Field{"rms_height", "m", from_to(0, 100),
              "Root mean square height of this roughness: the share exp(-4 k^2 h^2 cos^2) is reflected coherently, the "
              "facets spread the rest (calibrated model); 0: unknown, plane faces have no coherent echo.",
              ActsIn::kCalibrated, "reflectivity"},
        self.rms_height);
  visit(Field{"clutter_shape", "", from_to(0.1, 1000),
              "Shape of K-distributed clutter; a smaller one is patchier (calibrated model, with speckle); none when "
              "absent.",
              ActsIn::kCalibrated},
        self.clutter_shape);
  visit(Field{"clutter_length", "m", above_to(0, 1000),
              "Correlation length of the clutter of a surface; larger resolution cells average it (calibrated model, "
              "with speckle).",
              ActsIn::kCalibrated},
        self.clutter_length);
  visit(Field{"scatterer_density", "1/m^2", above_to(0, 1e9),
              "Equal scatterers per unit area; where a cell holds few, its speckle is not Gaussian (calibrated model, "
              "with speckle); unlimited when absent.",
              ActsIn::kCalibrated},
        self.scatterer_density);
}

/// Acoustic properties of a surface.
struct Material {
  std::string name = {};                     ///< Lower case, as written in scenes.
  double density = 2500;                     ///< [kg/m^3], in (0, 30000].
  double sound_speed = 3000;                 ///< Speed of compressional waves [m/s], in (0, 20000].
  std::optional<double> shear_speed = {};    ///< Speed of shear waves [m/s], in (0, 0.86 sound_speed]; absent: fluid.
  double loss = 0;                           ///< Imaginary over real part of the wavenumber, 0..1.
  std::optional<double> reflectivity = {};   ///< Amplitude reflectivity of the `paper` model, 0..1; absent: |R|.
  double lambert_db = -20;                   ///< 10 log10 of Scattering::lambert [dB], -200..kGreatestLambertDb.
  std::optional<double> reflection = {};     ///< |R| at normal incidence, 0..1; absent: see reflection_at().
  std::optional<double> thickness = {};      ///< Thickness of a plate with water on both sides [m], in (0, 1000];
                                             ///< absent: solid.
  std::optional<double> transmission = {};   ///< |T| at all angles, 0..1; absent: see scattering().
  double open_share = 0;                     ///< Share of the area that is open and transmits all sound, 0..1.
  double rms_slope = 0.1;                    ///< Root mean square slope of small facets, along each axis, 0.005..1.
  double rms_height = 0;                     ///< Root mean square height of that roughness [m], 0..100; 0: not known.
  std::optional<double> clutter_shape = {};  ///< Shape nu of K-distributed clutter, 0.1..1000: smaller is patchier;
                                             ///< absent: none.
  double clutter_length = 1;                 ///< Correlation length of the clutter [m], in (0, 1000].
  std::optional<double> scatterer_density = {};  ///< Equal scatterers per area [1/m^2], in (0, 1e9]; absent: unlimited.
  std::optional<double> sea_wind = {};        ///< Wind speed over it [m/s], in (0, 30], where this is the sea surface.
  std::string source = {};                    ///< Where the numbers come from.
  std::shared_ptr<const Relief> relief = {};  ///< Relief of all surfaces of this material; null: the mesh's, if any.

  /// Pressure reflection coefficient at normal incidence against water of the given impedance [kg/(m^2 s)], -1..1:
  /// (Z2 - Z1)/(Z2 + Z1).
  [[nodiscard]] double reflection_coefficient(double water_impedance) const;

  /// `reflectivity` if given, else |reflection_coefficient| against sea water.
  [[nodiscard]] double effective_reflectivity() const;

  /// |R| in sea water at normal incidence, for the `calibrated` model: `reflection` if given; plate_reflection() where
  /// there is a `thickness`; else |reflection_coefficient|. Where it is not given, at most sqrt(1 - pi mu): what is
  /// scattered diffusely is not reflected.
  /// @param frequency  [Hz], > 0.
  [[nodiscard]] double reflection_at(double frequency) const;

  /// |T| of the closed part in sea water at normal incidence, for the `calibrated` model: see scattering().
  /// @param frequency  [Hz], > 0.
  [[nodiscard]] double transmission_at(double frequency) const;

  /// The scattering parameters of the `calibrated` model at a frequency [Hz]. Reflection depends on the angle as that
  /// of a half-space or plate with these speeds, unless `reflection` is given: then |R| is the same at all angles.
  /// |T|^2 is that of the plate, 0 without a thickness, or `transmission` squared, at most 1 - |R|^2 - pi mu. The open
  /// part of the area transmits all sound; |R|^2, |T|^2 and mu of the rest are multiplied by 1 - open_share. With a
  /// `sea_wind`, backscatter and reflection are those of acoustics/surface_scattering.h at every angle, without
  /// transmission.
  [[nodiscard]] Scattering scattering(double frequency) const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit_material_fields(self, visit);
  }

  [[nodiscard]] bool operator==(const Material&) const = default;
};

/// Sea water to which reflection refers: density [kg/m^3], sound speed [m/s] and their product, its impedance.
inline constexpr double kSeaWaterDensity = 1026;
inline constexpr double kSeaWaterSoundSpeed = 1500;
inline constexpr double kSeaWaterImpedance = kSeaWaterDensity * kSeaWaterSoundSpeed;

/// Every material known by name, in alphabetical order. Typical values, +-5 %.
[[nodiscard]] std::span<const Material> material_library();

/// The library's material of that name (case does not matter; '_', '-' and ' ' are alike), or null.
[[nodiscard]] const Material* find_material(std::string_view name);

}  // namespace insonify
