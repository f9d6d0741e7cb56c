// material.cpp -- reflection coefficients of materials, and look-up of library materials by name.

#include "insonify/material.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "acoustics/solid_reflection.h"
#include "base/names.h"
#include "insonify/acoustics/reflection.h"
#include "scene/material_library.h"
#include "scene/sea_scattering.h"

namespace insonify {
namespace {

ReflectingMedium medium_of(const Material& material) {
  return {.density = material.density / kSeaWaterDensity,
          .sound_speed = material.sound_speed / kSeaWaterSoundSpeed,
          .shear_speed = material.shear_speed.value_or(0) / kSeaWaterSoundSpeed,
          .loss = material.loss};
}

// Thickness over the wavelength in water; 0 of a solid.
double turns_of(const Material& material, double frequency) {
  return material.thickness.value_or(0) * frequency / kSeaWaterSoundSpeed;
}

// |R|^2 of what is not open, by impedances: at most what is not scattered diffusely.
double reflectance_of(const Material& material, double frequency, double cosine) {
  const ReflectingMedium medium = medium_of(material);
  const double turns = turns_of(material, frequency);
  const std::complex<double> reflection =
      turns > 0 ? plate_reflection(medium, turns, cosine) : half_space_reflection(medium, cosine);
  return std::min(std::norm(reflection), reflectance_left(material.lambert_db));
}

std::shared_ptr<const AngularScattering> reflectance_by_angle(const Material& material, double frequency) {
  AngularScattering scattering;
  scattering.reflectance = AngleTable(
      [&](double cosine) { return (1 - material.open_share) * reflectance_of(material, frequency, cosine); });
  return std::make_shared<const AngularScattering>(std::move(scattering));
}

// |T|^2 of what is not open: at most what is neither reflected nor scattered diffusely.
// @param reflectance  |R|^2
double transmittance_of(const Material& material, double frequency, double cosine, double reflectance) {
  const double turns = turns_of(material, frequency);
  const double whole = material.transmission ? *material.transmission * *material.transmission
                       : turns > 0           ? std::norm(plate_transmission(medium_of(material), turns, cosine))
                                             : 0.0;
  return std::clamp(whole, 0.0, std::max(reflectance_left(material.lambert_db) - reflectance, 0.0));
}

// Share of the energy that passes, at every angle; null where nothing does.
std::shared_ptr<const AngleTable> transmittance_by_angle(const Material& material, double frequency) {
  const double open = material.open_share;
  if (open == 0 && !material.thickness && material.transmission.value_or(0) == 0) {
    return nullptr;
  }
  return std::make_shared<const AngleTable>([&](double cosine) {
    const double reflectance =
        material.reflection ? *material.reflection * *material.reflection : reflectance_of(material, frequency, cosine);
    return open + (1 - open) * transmittance_of(material, frequency, cosine, reflectance);
  });
}

}  // namespace

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

double Material::transmission_at(double frequency) const {
  const double reflected = reflection_at(frequency);
  return std::sqrt(transmittance_of(*this, frequency, 1, reflected * reflected));
}

// Facets of a greater rms slope spread sound by more than 11 degrees: no ghost is visible there. Those of the sea are
// followed whatever their slope, since it reflects all and is above everything.
constexpr double kSteepestMirror = 0.1;

Scattering Material::scattering(double frequency) const {
  const double closed = 1 - open_share;
  Scattering scattering{.lambert = closed * std::pow(10.0, lambert_db / 10),
                        .reflection = std::sqrt(closed) * reflection_at(frequency),
                        .rms_slope = rms_slope};
  const double phase = 2 * std::numbers::pi * frequency / kSeaWaterSoundSpeed * rms_height;
  scattering.roughness = 4 * phase * phase;
  scattering.facets_mirror = sea_wind || rms_slope <= kSteepestMirror;
  if (sea_wind) {
    scattering.by_angle = sea_scattering(*sea_wind, frequency, scattering.reflection, rms_slope);
  } else if (!reflection) {
    scattering.by_angle = reflectance_by_angle(*this, frequency);
  }
  if (!sea_wind) {
    scattering.passed = transmittance_by_angle(*this, frequency);
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
