// sea_surface.cpp -- the sea surface as a material: slope, reflection loss and backscatter from wind speed.

#include "insonify/sea_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "insonify/acoustics/backscatter.h"
#include "insonify/acoustics/surface_scattering.h"
#include "scene/sea_scattering.h"

namespace insonify {
namespace {

constexpr double kLowestFrequency = 10e3;  // Lowest frequency of TR 9407 [Hz].
constexpr double kStraightUp = 0.5 * std::numbers::pi;
constexpr double kFlattest = 0.005;  // Smallest rms slope of a material.

// Rms height of a fully developed sea over the square of the wind speed [s^2/m]: a quarter of the significant wave
// height 0.21 U^2/g of Pierson and Moskowitz, J. Geophys. Res. 69(24), 5181 (1964).
constexpr double kHeightPerSquaredWind = 0.25 * 0.21 / 9.81;

}  // namespace

Material sea_surface_material(const SeaSurface& surface, double frequency) {
  Material material;
  material.name = "sea_surface";
  material.source = "Cox and Munk (1954); Pierson and Moskowitz (1964); APL-UW TR 9407 (1994)";
  material.density = 1.204;
  material.sound_speed = 343.2;
  material.reflectivity = 1;
  material.reflection = 1;
  material.lambert_db = -200;
  material.rms_slope = kFlattest;
  if (surface.wind_speed > 0) {
    material.sea_wind = surface.wind_speed;
    material.reflection =
        sea_surface_reflection(kStraightUp, std::max(frequency, kLowestFrequency), surface.wind_speed);
    material.rms_height = kHeightPerSquaredWind * surface.wind_speed * surface.wind_speed;
    material.rms_slope = std::sqrt(0.5 * (0.003 + 0.00512 * surface.wind_speed));
  }
  return material;
}

// The facet lobe of the plain laws is taken off the report's backscatter, so that the sum of both is the report's.
std::shared_ptr<const AngularScattering> sea_scattering(double wind_speed, double frequency, double reflection,
                                                        double rms_slope) {
  const double f = std::max(frequency, kLowestFrequency);
  const auto grazing = [](double cosine) { return std::min(std::asin(cosine), kStraightUp); };
  AngularScattering sea;
  sea.reflectance = AngleTable(
      [&](double cosine) { return std::pow(10, -surface_bubble_loss_db(grazing(cosine), f, wind_speed) / 10); });
  sea.backscatter = AngleTable([&](double cosine) {
    const double lobe = facet_backscatter(reflection, rms_slope, std::acos(cosine));
    return (sea_surface_backscatter(grazing(cosine), f, wind_speed) - lobe) / cosine;
  });
  sea.diffuse = AngleTable([&](double cosine) {
    return std::sqrt(sea_surface_diffuse_backscatter(grazing(cosine), f, wind_speed)) / cosine;
  });
  return std::make_shared<const AngularScattering>(std::move(sea));
}

}  // namespace insonify
