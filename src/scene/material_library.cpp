// material_library.cpp -- the table of library materials and their aliases.

#include "scene/material_library.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

#include "insonify/acoustics/sediment.h"
#include "insonify/material.h"

namespace insonify {
namespace {

constexpr const char* kSelfridge = "Selfridge, IEEE Trans. Sonics Ultrason. SU-32(3), 381 (1985)";
constexpr const char* kHandbook = "CRC Handbook of Chemistry and Physics, Speed of sound in various media";
constexpr const char* kJensen = "Jensen et al., Computational Ocean Acoustics, table 1.3";
constexpr const char* kSediments =
    "APL-UW High-Frequency Ocean Environmental Acoustic Models Handbook TR 9407 (1994), table 2";
constexpr const char* kTypical = "typical value";

// lambert_db and rms_slope of materials other than sediments are typical values at imaging frequencies for smooth (-25
// to -35 dB, slopes of 0.02 to 0.1) and for rough or fouled surfaces (-12 to -18 dB, 0.2 to 0.4); confidence low.
//
// rms_height: painted steel 30 um, a fifth of the peak-to-valley height of 150 um (over 50 mm) of new antifouling
// paint, and overgrown steel 1 mm, between medium and heavy calcareous fouling, 3 to 10 mm peak to valley (Schultz,
// Biofouling 23(5), 331 (2007), table 1; confidence medium). Others are typical: rolled metal and plastic a few um,
// cast iron and corroded steel 0.1 to 0.2 mm, concrete as cast 0.3 mm, broken stone and ice mm (confidence low).
// Coherent reflection needs less than an eighth of a wavelength, 0.26 mm at 720 kHz, so that only those between 0.05
// and 0.5 mm matter.
Material material(const char* name, double density, double sound_speed, double lambert_db, double rms_slope,
                  double rms_height, const char* source) {
  return {.name = name,
          .density = density,
          .sound_speed = sound_speed,
          .lambert_db = lambert_db,
          .rms_slope = rms_slope,
          .rms_height = rms_height,
          .source = source};
}

// Adds the speed of shear waves. Of metals and glass it is as well known as the other speed (same sources, confidence
// high), of rocks that of Jensen et al., of concrete, granite, plastics, ice and bone typical (confidence medium: +-10
// %). Plastics absorb; their loss, some 0.005, hardly matters to half-spaces.
Material solid(Material material, double shear_speed, double loss = 0) {
  material.shear_speed = shear_speed;
  material.loss = loss;
  return material;
}

// rms slope of bottoms for which the fit gives no facet lobe: so large that the lobe is weak.
constexpr double kWithoutLobe = 0.5;

// Rms height of a bottom across a patch of 10 cm [m], the size of a Fresnel zone at imaging ranges: the integral of the
// report's spectrum w K^-gamma beyond the patch's wavenumber, h^2 = 2 pi w K^(2 - gamma)/(gamma - 2), in cm.
double bottom_height(const Sediment& sediment) {
  constexpr double kPatch = 10, kMetresPerCentimetre = 0.01;
  const double above = sediment.spectral_exponent - 2;
  const double variance =
      2 * std::numbers::pi * sediment.spectral_strength * std::pow(2 * std::numbers::pi / kPatch, -above) / above;
  return kMetresPerCentimetre * std::sqrt(variance);
}

// A bottom from sediment_table(). TR 9407 gives ratios to the water above, for which the values of kSeaWaterImpedance
// are used: 1026 kg/m^3 and 1500 m/s. The scattering parameters, fitted at 100 kHz, are also used above.
Material bottom(const char* name, const char* sediment_name) {
  const Sediment& sediment = *find_sediment(sediment_name);
  Material bottom =
      material(name, 1026 * sediment.density_ratio, 1500 * sediment.sound_speed_ratio, sediment.lambert_mu_db,
               sediment.rms_slope.value_or(kWithoutLobe), bottom_height(sediment), kSediments);
  bottom.loss = sediment.loss;
  return bottom;
}

// Coarse to fine.
std::vector<Material> make_bottoms() {
  return {
      bottom("rock", "rock"),
      bottom("gravel", "gravel"),
      bottom("sandy_gravel", "sandy_gravel"),
      bottom("very_coarse_sand", "very_coarse_sand"),
      bottom("coarse_sand", "coarse_sand"),
      bottom("sand", "medium_sand"),
      bottom("fine_sand", "fine_sand"),
      bottom("very_fine_sand", "very_fine_sand"),
      bottom("clayey_sand", "clayey_sand"),
      bottom("silt", "coarse_silt"),
      bottom("sandy_silt", "sandy_silt"),
      bottom("sandy_mud", "sandy_mud"),
      bottom("sandy_clay", "sandy_clay"),
      bottom("mud", "silty_clay"),
      bottom("clay", "clay"),
  };
}

std::vector<Material> make_library() {
  std::vector<Material> library = {
      // Gas and metals.
      material("air", 1.204, 343.2, -30, 0.05, 0, kHandbook),
      solid(material("steel", 7850, 5900, -30, 0.05, 3e-5, kSelfridge), 3200),
      solid(material("corroded_steel", 7850, 5900, -18, 0.2, 2e-4, kSelfridge), 3200),
      solid(material("fouled_steel", 7850, 5900, -14, 0.3, 1e-3, kSelfridge), 3200),
      solid(material("stainless_steel", 7890, 5790, -32, 0.04, 2e-6, kHandbook), 3100),
      solid(material("cast_iron", 7200, 4600, -20, 0.15, 1e-4, kSelfridge), 2600),
      solid(material("aluminium", 2700, 6420, -30, 0.05, 2e-6, kHandbook), 3040),
      solid(material("titanium", 4500, 6070, -32, 0.04, 2e-6, kHandbook), 3125),
      solid(material("copper", 8930, 5010, -30, 0.05, 2e-6, kHandbook), 2270),
      solid(material("brass", 8600, 4700, -30, 0.05, 2e-6, kHandbook), 2110),
      solid(material("lead", 11340, 2160, -28, 0.08, 2e-5, kHandbook), 700),
      // Stone and the like.
      solid(material("glass", 2500, 5660, -35, 0.02, 1e-7, kSelfridge), 3420),
      solid(material("concrete", 2400, 3700, -18, 0.15, 3e-4, kTypical), 2250),
      solid(material("granite", 2650, 5500, -12, 0.3, 5e-3, kTypical), 3200),
      solid(material("basalt", 2700, 5250, -12, 0.3, 5e-3, kJensen), 2500, 0.0018),
      solid(material("limestone", 2400, 3000, -12, 0.3, 5e-3, kJensen), 1500, 0.0018),
      solid(material("chalk", 2200, 2400, -13, 0.3, 5e-3, kJensen), 1000, 0.0037),
      solid(material("moraine", 2100, 1950, -12, 0.4, 2e-2, kJensen), 600, 0.0073),
      // Plastics and rubbers.
      solid(material("pvc", 1380, 2380, -32, 0.04, 2e-6, kSelfridge), 1060),
      solid(material("acrylic", 1190, 2750, -35, 0.03, 1e-7, kSelfridge), 1400),
      solid(material("hdpe", 960, 2430, -32, 0.05, 5e-6, kSelfridge), 950),
      solid(material("ldpe", 920, 1950, -32, 0.05, 5e-6, kSelfridge), 540),
      solid(material("abs", 1050, 2250, -32, 0.05, 2e-6, kSelfridge), 930),
      solid(material("nylon", 1120, 2600, -30, 0.06, 5e-6, kSelfridge), 1100),
      solid(material("polystyrene", 1050, 2400, -30, 0.05, 5e-6, kSelfridge), 1150),
      material("polyurethane", 1040, 1500, -30, 0.06, 5e-6, kSelfridge),
      solid(material("grp", 1800, 2900, -28, 0.08, 3e-5, kTypical), 1500),
      material("rubber", 950, 1550, -28, 0.08, 1e-5, kHandbook),
      material("neoprene", 1310, 1600, -28, 0.08, 1e-5, kSelfridge),
      material("silicone", 1180, 1050, -30, 0.06, 5e-6, kSelfridge),
      material("neoprene_foam", 200, 500, -25, 0.1, 1e-4, kTypical),
      material("syntactic_foam", 600, 2500, -25, 0.1, 1e-4, kTypical),
      // Organic materials and ice.
      material("wood", 1100, 1600, -22, 0.15, 2e-4, kTypical),
      material("dry_wood", 720, 1500, -20, 0.15, 2e-4, kTypical),
      solid(material("ice", 917, 3840, -20, 0.2, 2e-3, kTypical), 1930),
      material("tissue", 1060, 1540, -25, 0.3, 2e-4, kTypical),
      solid(material("bone", 1900, 3500, -20, 0.2, 2e-4, kTypical), 1800),
  };
  std::ranges::move(make_bottoms(), std::back_inserter(library));
  std::ranges::sort(library, {}, &Material::name);
  return library;
}

const std::map<std::string, std::string>& aliases() {
  static const std::map<std::string, std::string> kAliases = {
      {"aluminum", "aluminium"},
      {"boulder", "rock"},
      {"cement", "concrete"},
      {"coarse_silt", "silt"},
      {"cobble", "gravel"},
      {"fiberglass", "grp"},
      {"fibreglass", "grp"},
      {"fish", "tissue"},
      {"flesh", "tissue"},
      {"gfrp", "grp"},
      {"iron", "cast_iron"},
      {"medium_sand", "sand"},
      {"mild_steel", "steel"},
      {"oak", "dry_wood"},
      {"painted_steel", "steel"},
      {"pebble", "gravel"},
      {"perspex", "acrylic"},
      {"plexiglas", "acrylic"},
      {"plexiglass", "acrylic"},
      {"pmma", "acrylic"},
      {"polyethylene", "hdpe"},
      {"rough_rock", "rock"},
      {"rusty_steel", "corroded_steel"},
      {"silty_clay", "mud"},
      {"stainless", "stainless_steel"},
      {"stone", "rock"},
      {"waterlogged_wood", "wood"},
  };
  return kAliases;
}

}  // namespace

const std::string& resolve_alias(const std::string& name) {
  const auto alias = aliases().find(name);
  return alias == aliases().end() ? name : alias->second;
}

const std::vector<std::string>& known_material_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Material& entry : material_library()) {
      names.push_back(entry.name);
    }
    for (const auto& [alias, name] : aliases()) {
      names.push_back(alias);
    }
    return names;
  }();
  return kNames;
}

std::span<const Material> material_library() {
  static const std::vector<Material> kLibrary = make_library();
  return kLibrary;
}

}  // namespace insonify
