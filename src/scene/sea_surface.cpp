// sea_surface.cpp -- the sea surface as a material: slope, reflection loss and diffuse echo from wind speed.

#include "insonify/sea_surface.h"

#include <algorithm>
#include <cmath>

#include "insonify/acoustics/surface_scattering.h"
#include "insonify/geometry.h"

namespace insonify {
namespace {

constexpr double kGrazing = radians_from_degrees(20);  // Grazing angle at which loss and echo are taken.
constexpr double kLowestFrequency = 10e3;              // Lowest frequency of TR 9407 [Hz].
constexpr double kFlattest = 0.005;                    // Smallest rms slope of a material.

}  // namespace

Material sea_surface_material(const SeaSurface& surface, double frequency) {
  Material material;
  material.name = "sea_surface";
  material.source = "Cox and Munk (1954); APL-UW TR 9407 (1994)";
  material.density = 1.204;
  material.sound_speed = 343.2;
  material.reflectivity = 1;
  material.reflection = 1;
  material.lambert_db = -200;
  material.rms_slope = kFlattest;
  if (surface.wind_speed > 0) {
    const double clamped_frequency = std::max(frequency, kLowestFrequency), sine = std::sin(kGrazing);
    const double echo = sea_surface_backscatter(kGrazing, clamped_frequency, surface.wind_speed);
    material.reflection = sea_surface_reflection(kGrazing, clamped_frequency, surface.wind_speed);
    material.rms_slope = std::sqrt(0.5 * (0.003 + 0.00512 * surface.wind_speed));
    material.lambert_db = std::clamp(10 * std::log10(echo / (sine * sine)), -200.0, kGreatestLambertDb);
  }
  return material;
}

}  // namespace insonify
