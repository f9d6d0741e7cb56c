// random_motion.h -- random motion of a vehicle with a given spectrum and rms, as a sum of sinusoids.

#pragma once

#include <cstdint>
#include <vector>

#include "insonify/pattern.h"

namespace insonify {

/// The time scale of a spectrum where none is given [s].
[[nodiscard]] double usual_period(MotionSpectrum spectrum);

/// Shape of a spectrum: power density over frequency, up to a factor. With x = f T, T the period:
/// - swell: x^-5 exp(-5/4 x^-4), W. J. Pierson and L. Moskowitz, J. Geophys. Res. 69(24), 5181 (1964), written with the
///   frequency of its peak, 1/T;
/// - towfish: 1/((1 - x^2)^2 + (2 z x)^2), a damped oscillator of resonance 1/T under white noise, with z = 0.2
///   (S. H. Crandall and W. D. Mark, Random Vibration in Mechanical Systems (1963));
/// - auv: 1/(1 + (2 pi x)^2), the first-order Gauss-Markov process of correlation exp(-t/T) (A. Gelb, ed., Applied
///   Optimal Estimation (1974)).
[[nodiscard]] double motion_spectrum(MotionSpectrum spectrum, double period, double frequency);

/// The frequencies that motions have [Hz]: all of a spectrum but a hundredth or less of its power.
struct MotionBand {
  double low, high;
};
[[nodiscard]] MotionBand motion_band(MotionSpectrum spectrum, double period);

/// A motion: equal amplitudes at frequencies drawn from the spectrum, one in each of as many bands of equal power.
class RandomMotion {
 public:
  /// @param rms        Of the motion, exact over a long time.
  /// @param direction  Motions of other directions are independent.
  RandomMotion(MotionSpectrum spectrum, double period, double rms, std::uint64_t seed, std::uint32_t direction);

  /// The motion at times 0, step, 2 step ...
  [[nodiscard]] std::vector<double> series(std::size_t count, double step) const;

 private:
  struct Wave {
    double rate;   // [rad/s]
    double phase;  // [rad]
  };
  double amplitude_ = 0;
  std::vector<Wave> waves_;  // Empty for an rms of 0.
};

}  // namespace insonify
