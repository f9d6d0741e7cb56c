// material.cpp -- reflection coefficients of materials, and look-up of library materials by name.

#include "insonify/material.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/canonical_name.h"
#include "insonify/acoustics/reflection.h"
#include "scene/material_library.h"
#include "scene/sea_scattering.h"

namespace insonify {

double reflectance_left(double lambert_db) {
  return std::max(0.0, 1 - std::numbers::pi * std::pow(10.0, lambert_db / 10));
}

double Material::reflection_coefficient(double water_impedance) const {
  return insonify::reflection_coefficient(water_impedance, density * sound_speed);
}

double Material::effective_reflectivity() const {
  return reflectivity ? *reflectivity : std::abs(reflection_coefficient(kSeaWaterImpedance));
}

double Material::reflection_at(double frequency) const {
  if (reflection) {
    return *reflection;
  }
  const double whole = thickness ? plate_reflection(kSeaWaterImpedance, density, sound_speed, *thickness, frequency)
                                 : std::abs(reflection_coefficient(kSeaWaterImpedance));
  return std::min(whole, std::sqrt(reflectance_left(lambert_db)));
}

Scattering Material::scattering(double frequency) const {
  Scattering scattering{
      .lambert = std::pow(10.0, lambert_db / 10), .reflection = reflection_at(frequency), .rms_slope = rms_slope};
  const double phase = 2 * std::numbers::pi * frequency / kSeaWaterSoundSpeed * rms_height;
  scattering.roughness = 4 * phase * phase;
  if (sea_wind) {
    scattering.by_angle = sea_scattering(*sea_wind, frequency, scattering.reflection, rms_slope);
  }
  return scattering;
}

const Material* find_material(std::string_view name) {
  const std::string wanted = canonical_name(name);
  const std::string& own_name = resolve_alias(wanted);
  const std::span<const Material> library = material_library();
  const auto found = std::ranges::lower_bound(library, own_name, {}, &Material::name);
  return found != library.end() && found->name == own_name ? &*found : nullptr;
}

}  // namespace insonify
