// random_motion.cpp -- spectra of motion, and the drawing of frequencies and phases from them.

#include "pattern/random_motion.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/philox.h"

namespace insonify {
namespace {

constexpr double kTwoPiMotion = 2 * std::numbers::pi;
constexpr int kWaves = 64;
constexpr double kDamping = 0.2;  // Of a towfish, as a share of the critical one.

// Power of a spectrum up to each of a list of frequencies, as a share of all in the band.
struct PowerBelow {
  std::vector<double> frequencies, shares;

  PowerBelow(MotionSpectrum spectrum, double period) {
    constexpr int kSteps = 4096;
    const MotionBand band = motion_band(spectrum, period);
    const double ratio = std::log(band.high / band.low);
    double power = 0, last = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double frequency = band.low * std::exp(ratio * i / kSteps);
      const double density = motion_spectrum(spectrum, period, frequency);
      power += i > 0 ? 0.5 * (density + last) * (frequency - frequencies.back()) : 0;
      frequencies.push_back(frequency);
      shares.push_back(power);
      last = density;
    }
    for (double& share : shares) {
      share /= power;
    }
  }

  [[nodiscard]] double frequency_at(double share) const {
    std::size_t i = 1;
    while (i + 1 < shares.size() && shares[i] < share) {
      ++i;
    }
    const double within = (share - shares[i - 1]) / (shares[i] - shares[i - 1]);
    return frequencies[i - 1] + within * (frequencies[i] - frequencies[i - 1]);
  }
};

}  // namespace

double usual_period(MotionSpectrum spectrum) {
  return spectrum == MotionSpectrum::kSwell ? 8 : 5;
}

double motion_spectrum(MotionSpectrum spectrum, double period, double frequency) {
  const double x = frequency * period;
  switch (spectrum) {
    case MotionSpectrum::kSwell:
      return std::pow(x, -5) * std::exp(-1.25 * std::pow(x, -4));
    case MotionSpectrum::kTowfish:
      return 1 / (std::pow(1 - x * x, 2) + std::pow(2 * kDamping * x, 2));
    case MotionSpectrum::kAuv:
      break;
  }
  return 1 / (1 + std::pow(kTwoPiMotion * x, 2));
}

// Power beyond the bands, from the integrals: swell 1 - exp(-5/4 5^-4) = .2 % above and exp(-5/4 0.5^-4) = 2e-9 below;
// towfish .2 % above; auv 2/pi atan(1/(2 pi 10)) = 1 % above and .06 % below.
MotionBand motion_band(MotionSpectrum spectrum, double period) {
  switch (spectrum) {
    case MotionSpectrum::kSwell:
      return {0.5 / period, 5 / period};
    case MotionSpectrum::kTowfish:
      return {0.001 / period, 5 / period};
    case MotionSpectrum::kAuv:
      break;
  }
  return {0.0002 / period, 10 / period};
}

RandomMotion::RandomMotion(MotionSpectrum spectrum, double period, double rms, std::uint64_t seed,
                           std::uint32_t direction) {
  if (!(rms > 0)) {
    return;
  }
  amplitude_ = rms * std::sqrt(2.0 / kWaves);
  const PowerBelow power(spectrum, period);
  for (std::uint32_t i = 0; i < kWaves; ++i) {
    const PhiloxCounter words =
        philox({i, direction, 0, static_cast<std::uint32_t>(RandomPurpose::kVehicleMotion)}, philox_key(seed));
    waves_.push_back({kTwoPiMotion * power.frequency_at((i + static_cast<double>(uniform_open(words[0]))) / kWaves),
                      kTwoPiMotion * static_cast<double>(uniform_open(words[1]))});
  }
}

// Each wave is a vector that turns by a constant angle; sine and cosine are taken once per block.
std::vector<double> RandomMotion::series(std::size_t count, double step) const {
  constexpr std::size_t kBlock = 1024;
  std::vector<double> sums(count, 0.0);
  for (const Wave& wave : waves_) {
    const std::complex<double> turn = std::polar(1.0, wave.rate * step);
    for (std::size_t begin = 0; begin < count; begin += kBlock) {
      std::complex<double> at = std::polar(amplitude_, wave.rate * step * static_cast<double>(begin) + wave.phase);
      for (std::size_t i = begin; i < std::min(count, begin + kBlock); ++i) {
        sums[i] += at.imag();
        at = {at.real() * turn.real() - at.imag() * turn.imag(), at.real() * turn.imag() + at.imag() * turn.real()};
      }
    }
  }
  return sums;
}

}  // namespace insonify
