// absorption.cpp -- absorption of sound in water, after Ainslie and McColm and after Francois and Garrison.

#include "insonify/acoustics/absorption.h"

#include <cassert>
#include <cmath>

#include "acoustics/formula.h"
#include "base/square.h"

namespace insonify {
namespace {

// Inside this file frequencies are in kHz and losses in dB/km: the units the formulas were published in, so that each
// constant can be checked against its paper. Depths are in km in Ainslie and McColm's, in m in Francois and Garrison's.

constexpr double kMetresPerKilometre = 1e3;

// Loss to one dissolved salt. Far below its relaxation frequency it grows as the square of the frequency; far above,
// the salt no longer follows the wave and the loss levels off.
double relaxation_loss(double strength, double relaxation, double frequency) {
  if (strength == 0 || frequency == 0) {
    return 0;
  }
  return strength * relaxation * square(frequency) / (square(relaxation) + square(frequency));
}

// ---------------------------------------------------------------- Ainslie and McColm (1998), eqs 2 to 4

double boric_acid_loss(double frequency, const Water& water) {
  const double strength = 0.106 * std::exp((water.ph - 8) / 0.56);
  const double relaxation = 0.78 * std::sqrt(water.salinity / 35) * std::exp(water.temperature_c / 26);
  return relaxation_loss(strength, relaxation, frequency);
}

double magnesium_sulphate_loss(double frequency, const Water& water) {
  const double depth = water.depth / kMetresPerKilometre;
  const double strength = 0.52 * (1 + water.temperature_c / 43) * (water.salinity / 35) * std::exp(-depth / 6);
  const double relaxation = 42 * std::exp(water.temperature_c / 17);
  return relaxation_loss(strength, relaxation, frequency);
}

double viscous_loss(double frequency, const Water& water) {
  const double depth = water.depth / kMetresPerKilometre;
  return 0.00049 * square(frequency) * std::exp(-(water.temperature_c / 27 + depth / 17));
}

// ---------------------------------------------------------------- Francois and Garrison (1982)

struct Relaxation {
  double strength;   // A x P, dB/(km kHz)
  double frequency;  // kHz
};

Relaxation boric_acid(const Water& water, double sound_speed) {
  const double kelvin = 273 + water.temperature_c;
  return {8.86 / sound_speed * std::pow(10, 0.78 * water.ph - 5),
          2.8 * std::sqrt(water.salinity / 35) * std::pow(10, 4 - 1245 / kelvin)};
}

Relaxation magnesium_sulphate(const Water& water, double sound_speed) {
  const double kelvin = 273 + water.temperature_c;
  const double pressure = 1 - 1.37e-4 * water.depth + 6.2e-9 * square(water.depth);
  return {21.44 * water.salinity / sound_speed * (1 + 0.025 * water.temperature_c) * pressure,
          8.17 * std::pow(10, 8 - 1990 / kelvin) / (1 + 0.0018 * (water.salinity - 35))};
}

// Loss of pure water divided by frequency squared; fitted separately below and above 20 degC.
double pure_water_strength(const Water& water) {
  const double t = water.temperature_c;
  const double strength = t <= 20 ? 4.937e-4 + t * (-2.59e-5 + t * (9.11e-7 - t * 1.5e-8))
                                  : 3.964e-4 + t * (-1.146e-5 + t * (1.45e-7 - t * 6.5e-10));
  return strength * (1 - 3.83e-5 * water.depth + 4.9e-10 * square(water.depth));
}

}  // namespace

double francois_garrison_db_per_m(double frequency, const Water& water) {
  assert(frequency >= 0);
  const double f = frequency / kHertzPerKilohertz;
  const double sound_speed = 1412 + 3.21 * water.temperature_c + 1.19 * water.salinity + 0.0167 * water.depth;
  const Relaxation boric = boric_acid(water, sound_speed);
  const Relaxation sulphate = magnesium_sulphate(water, sound_speed);
  return (relaxation_loss(boric.strength, boric.frequency, f) +
          relaxation_loss(sulphate.strength, sulphate.frequency, f) + pure_water_strength(water) * square(f)) /
         kMetresPerKilometre;
}

double absorption_db_per_m(double frequency, const Water& water) {
  assert(frequency >= 0);
  const double f = frequency / kHertzPerKilohertz;
  return (boric_acid_loss(f, water) + magnesium_sulphate_loss(f, water) + viscous_loss(f, water)) / kMetresPerKilometre;
}

}  // namespace insonify
