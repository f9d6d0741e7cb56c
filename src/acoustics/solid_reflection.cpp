// solid_reflection.cpp -- normal impedances of solids, and the reflection coefficients that follow from them.

#include "acoustics/solid_reflection.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

using Complex = std::complex<double>;

constexpr Complex kI{0, 1};

// One kind of wave in the medium, driven from the water at an angle of incidence.
struct Wave {
  Complex speed;   // Relative to that of the water.
  Complex cosine;  // Cosine of its angle to the normal; of the branch that decays into the medium.

  Wave(double speed_ratio, double loss, double sine) : speed(speed_ratio / Complex{1, loss}) {
    const Complex own_sine = speed * sine;
    cosine = std::sqrt(1.0 - own_sine * own_sine);
    if ((cosine / speed).imag() < 0) {
      cosine = -cosine;
    }
    if (std::abs(cosine) < kLeast) {
      cosine = kLeast;  // At a critical angle, where the impedance is infinite.
    }
  }
  static constexpr double kLeast = 1e-9;

  [[nodiscard]] Complex impedance(double density) const { return density * speed / cosine; }
};

// Parts of the impedance by compression and by shear: Z_l cos^2(2 theta_t) and Z_t sin^2(2 theta_t).
struct Impedances {
  Wave compression, shear;
  Complex by_compression, by_shear = 0;

  Impedances(const ReflectingMedium& medium, double sine)
      : compression(medium.sound_speed, medium.loss, sine),
        shear(std::max(medium.shear_speed, 1e-9), medium.loss, sine) {
    by_compression = compression.impedance(medium.density);
    if (medium.shear_speed > 0) {
      const Complex shear_sine = shear.speed * sine;
      const Complex twice_cosine = 1.0 - 2.0 * shear_sine * shear_sine;
      by_compression *= twice_cosine * twice_cosine;
      by_shear = shear.impedance(medium.density) * (1.0 - twice_cosine * twice_cosine);
    }
  }
};

// Reflection coefficient of an impedance in units of the water's, or of its inverse if that is finite.
Complex coefficient(Complex impedance, double cosine) {
  return (impedance * cosine - 1.0) / (impedance * cosine + 1.0);
}

double sine_of(double cosine) {
  assert(cosine > 0 && cosine <= 1);
  return std::sqrt(1 - cosine * cosine);
}

// Coefficients of both parts of a plate's motion.
struct PlateCoefficients {
  Complex symmetric, antisymmetric;
};

PlateCoefficients plate_coefficients(const ReflectingMedium& medium, double turns, double cosine) {
  assert(turns > 0);
  const Impedances impedances(medium, sine_of(cosine));
  // Tangent of k cos(theta) d/2; it tends to i for a wave that decays within the plate.
  const auto tangent = [turns](const Wave& wave) {
    constexpr double kDead = 20;
    const Complex phase = std::numbers::pi * turns * wave.cosine / wave.speed;
    if (phase.imag() > kDead) {
      return kI;
    }
    const Complex tangent_of = std::tan(phase);
    return std::abs(tangent_of) > Wave::kLeast ? tangent_of : Complex{Wave::kLeast, 0};
  };
  const Complex by_compression = tangent(impedances.compression);
  const Complex by_shear = impedances.by_shear == 0.0 ? 1.0 : tangent(impedances.shear);
  const Complex symmetric = kI * (impedances.by_compression / by_compression + impedances.by_shear / by_shear);
  const Complex antisymmetric = -kI * (impedances.by_compression * by_compression + impedances.by_shear * by_shear);
  return {coefficient(symmetric, cosine), coefficient(antisymmetric, cosine)};
}

}  // namespace

Complex half_space_reflection(const ReflectingMedium& medium, double cosine) {
  const Impedances impedances(medium, sine_of(cosine));
  return coefficient(impedances.by_compression + impedances.by_shear, cosine);
}

Complex plate_reflection(const ReflectingMedium& medium, double turns, double cosine) {
  const PlateCoefficients parts = plate_coefficients(medium, turns, cosine);
  return 0.5 * (parts.symmetric + parts.antisymmetric);
}

Complex plate_transmission(const ReflectingMedium& medium, double turns, double cosine) {
  const PlateCoefficients parts = plate_coefficients(medium, turns, cosine);
  return 0.5 * (parts.symmetric - parts.antisymmetric);
}

}  // namespace insonify
