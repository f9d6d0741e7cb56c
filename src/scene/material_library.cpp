// material_library.cpp -- the table of known materials and their other names.

#include "scene/material_library.h"

#include <algorithm>
#include <map>

#include "insonify/material.h"

namespace insonify {
namespace {

constexpr const char* kSelfridge = "Selfridge, IEEE Trans. Sonics Ultrason. SU-32(3), 381 (1985)";
constexpr const char* kHandbook = "CRC Handbook of Chemistry and Physics, Speed of sound in various media";
constexpr const char* kJensen = "Jensen et al., Computational Ocean Acoustics, table 1.3";
constexpr const char* kSediments =
    "APL-UW High-Frequency Ocean Environmental Acoustic Models Handbook TR 9407 (1994), table 2";
constexpr const char* kTypical = "typical value";

Material material(const char* name, double density, double sound_speed, const char* source) {
  return {.name = name, .density = density, .sound_speed = sound_speed, .source = source};
}

// TR 9407 gives ratios to the water above, taken here as kSeaWaterImpedance's: 1026 kg/m^3 and 1500 m/s.
Material sediment(const char* name, double density_ratio, double speed_ratio) {
  return material(name, 1026 * density_ratio, 1500 * speed_ratio, kSediments);
}

std::vector<Material> make_library() {
  std::vector<Material> library = {
      // Gas and metals.
      material("air", 1.204, 343.2, kHandbook),
      material("steel", 7850, 5900, kSelfridge),
      material("stainless_steel", 7890, 5790, kHandbook),
      material("cast_iron", 7200, 4600, kSelfridge),
      material("aluminium", 2700, 6420, kHandbook),
      material("titanium", 4500, 6070, kHandbook),
      material("copper", 8930, 5010, kHandbook),
      material("brass", 8600, 4700, kHandbook),
      material("lead", 11340, 2160, kHandbook),
      // Stone and the like.
      material("glass", 2500, 5660, kSelfridge),
      material("concrete", 2400, 3700, kTypical),
      material("granite", 2650, 5500, kTypical),
      material("basalt", 2700, 5250, kJensen),
      material("limestone", 2400, 3000, kJensen),
      material("chalk", 2200, 2400, kJensen),
      material("moraine", 2100, 1950, kJensen),
      // Plastics and rubbers.
      material("pvc", 1380, 2380, kSelfridge),
      material("acrylic", 1190, 2750, kSelfridge),
      material("hdpe", 960, 2430, kSelfridge),
      material("ldpe", 920, 1950, kSelfridge),
      material("abs", 1050, 2250, kSelfridge),
      material("nylon", 1120, 2600, kSelfridge),
      material("polystyrene", 1050, 2400, kSelfridge),
      material("polyurethane", 1040, 1500, kSelfridge),
      material("grp", 1800, 2900, kTypical),
      material("rubber", 950, 1550, kHandbook),
      material("neoprene", 1310, 1600, kSelfridge),
      material("silicone", 1180, 1050, kSelfridge),
      material("neoprene_foam", 200, 500, kTypical),
      material("syntactic_foam", 600, 2500, kTypical),
      // Grown things and ice.
      material("wood", 1100, 1600, kTypical),
      material("dry_wood", 720, 1500, kTypical),
      material("ice", 917, 3840, kTypical),
      material("tissue", 1060, 1540, kTypical),
      material("bone", 1900, 3500, kTypical),
      // Bottoms, coarse to fine.
      sediment("rock", 2.5, 2.5),
      sediment("gravel", 2.5, 1.8),
      sediment("sandy_gravel", 2.492267, 1.336961),
      sediment("very_coarse_sand", 2.40113425, 1.30670325),
      sediment("coarse_sand", 2.23056425, 1.25025125),
      sediment("sand", 1.84461605, 1.1781937875),
      sediment("fine_sand", 1.451171, 1.1072595625),
      sediment("very_fine_sand", 1.26765715, 1.0567912375),
      sediment("clayey_sand", 1.2236108, 1.0364416),
      sediment("silt", 1.1948309, 1.0178602125),
      sediment("sandy_silt", 1.168912, 0.999931),
      sediment("sandy_mud", 1.1487162, 0.9873056),
      sediment("sandy_clay", 1.1474189, 0.9848732),
      sediment("mud", 1.1461216, 0.9824408),
      sediment("clay", 1.1448243, 0.9800084),
  };
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
      {"pebble", "gravel"},
      {"perspex", "acrylic"},
      {"plexiglas", "acrylic"},
      {"plexiglass", "acrylic"},
      {"pmma", "acrylic"},
      {"polyethylene", "hdpe"},
      {"rough_rock", "rock"},
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
