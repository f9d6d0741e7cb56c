// random_motion_test.cpp -- rms and spectra of random motions, against the formulas they are named after.

#include "pattern/random_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace insonify::random_motion_test {
namespace {

// Power of a series within a band, from its Fourier sum at the multiples of 1/duration.
double power_between(const std::vector<double>& series, double step, double low, double high) {
  const double duration = step * static_cast<double>(series.size());
  double power = 0;
  for (int k = static_cast<int>(std::ceil(low * duration)); k < high * duration; ++k) {
    const std::complex<double> turn = std::polar(1.0, -2 * std::numbers::pi * k / static_cast<double>(series.size()));
    std::complex<double> sum = 0, at = 1;
    for (const double value : series) {
      sum += value * at;
      at *= turn;
    }
    power += 2 * std::norm(sum / static_cast<double>(series.size()));
  }
  return power;
}

// Share of a spectrum's power below a frequency, by closed forms and quadrature.
double swell_below(double f, double period) {
  return std::exp(-1.25 * std::pow(f * period, -4));  // The integral of x^-5 exp(-5/4 x^-4) is exp(-5/4 x^-4)/5.
}
double auv_below(double f, double period) {
  return 2 / std::numbers::pi * std::atan(2 * std::numbers::pi * f * period);
}
double towfish_below(double f, double period) {
  const auto integral = [](double to) {
    double sum = 0;
    constexpr double kStep = 1e-3;
    for (double x = 0.5 * kStep; x < to; x += kStep) {
      sum += kStep / ((1 - x * x) * (1 - x * x) + 0.16 * x * x);
    }
    return sum;
  };
  return integral(f * period) / integral(200);
}

struct SpectrumCase {
  MotionSpectrum spectrum;
  double (*below)(double f, double period);
};
constexpr SpectrumCase kSpectra[] = {{MotionSpectrum::kSwell, swell_below},
                                     {MotionSpectrum::kTowfish, towfish_below},
                                     {MotionSpectrum::kAuv, auv_below}};

constexpr double kPeriod = 6, kStep = 0.1;
constexpr std::size_t kCount = 60'000;  // 6000 s: lines of the spectrum are 1/64 of its power, and resolved.

TEST(RandomMotionTest, HasTheRmsThatIsAskedFor) {
  for (const SpectrumCase& test : kSpectra) {
    const std::vector<double> series = RandomMotion(test.spectrum, kPeriod, 1.7, 5, 0).series(kCount, kStep);
    const double power = std::inner_product(series.begin(), series.end(), series.begin(), 0.0) / kCount;
    // Neighbouring lines beat over the 6000 s: within 3 %.
    EXPECT_NEAR(std::sqrt(power), 1.7, 0.05) << word_of(test.spectrum);
  }
}

TEST(RandomMotionTest, HasThePowerOfTheNamedFormulaInEachBand) {
  for (const SpectrumCase& test : kSpectra) {
    const std::vector<double> series = RandomMotion(test.spectrum, kPeriod, 1, 11, 2).series(kCount, kStep);
    const double edges[] = {0.2 / kPeriod, 0.7 / kPeriod, 0.9 / kPeriod, 1.0 / kPeriod, 1.2 / kPeriod, 2.5 / kPeriod};
    for (std::size_t i = 1; i < std::size(edges); ++i) {
      const double right = test.below(edges[i], kPeriod) - test.below(edges[i - 1], kPeriod);
      // One of 64 lines may fall on either side of an edge: 1/64 each, and leakage.
      EXPECT_NEAR(power_between(series, kStep, edges[i - 1], edges[i]), right, 2.5 / 64)
          << word_of(test.spectrum) << " " << edges[i - 1] * kPeriod;
    }
  }
}

TEST(RandomMotionTest, SpectraPeakWhereTheyAreNamedFor) {
  // dS/dx = 0 at x = 1 for swell; for the oscillator at x^2 = 1 - 2 z^2.
  const auto peak = [](MotionSpectrum spectrum) {
    double best = 0;
    for (double f = 0.01; f < 1; f += 1e-4) {
      best = motion_spectrum(spectrum, 5, f) > motion_spectrum(spectrum, 5, best + 1e-9) ? f : best;
    }
    return best * 5;
  };
  EXPECT_NEAR(peak(MotionSpectrum::kSwell), 1, 2e-3);
  EXPECT_NEAR(peak(MotionSpectrum::kTowfish), std::sqrt(1 - 2 * 0.04), 2e-3);
  // At f = 1/(2 pi T) a Gauss-Markov process has half of its density at 0.
  EXPECT_NEAR(motion_spectrum(MotionSpectrum::kAuv, 5, 1 / (10 * std::numbers::pi)), 0.5, 1e-12);
}

TEST(RandomMotionTest, DependsOnSeedAndDirectionAlone) {
  const auto series = [](std::uint64_t seed, std::uint32_t direction) {
    return RandomMotion(MotionSpectrum::kAuv, 5, 1, seed, direction).series(3000, 0.1);
  };
  EXPECT_EQ(series(3, 1), series(3, 1));
  EXPECT_NE(series(3, 1), series(4, 1));
  const std::vector<double> roll = RandomMotion(MotionSpectrum::kAuv, 5, 1, 3, 0).series(kCount, kStep);
  const std::vector<double> pitch = RandomMotion(MotionSpectrum::kAuv, 5, 1, 3, 1).series(kCount, kStep);
  EXPECT_LT(std::abs(std::inner_product(roll.begin(), roll.end(), pitch.begin(), 0.0) / kCount), 0.1);
}

TEST(RandomMotionTest, IsNothingForAnRmsOfZero) {
  EXPECT_EQ(RandomMotion(MotionSpectrum::kSwell, 8, 0, 1, 0).series(3, 1), std::vector<double>(3, 0.0));
}

}  // namespace
}  // namespace insonify::random_motion_test
