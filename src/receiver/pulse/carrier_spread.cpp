// carrier_spread.cpp -- fits the spread of scatterers to the correlation of the pulse.

#include "receiver/pulse/carrier_spread.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/square.h"

namespace insonify {
namespace {

constexpr double kLobes = 30;  // Sums extend over this many equivalent lengths of the pulse on either side.

// Mean of cos(2 pi turns r) weighted by |p(r)|^2, sampled every `step`.
double mean_cosine(const Pulse& pulse, double turns_per_metre, double step) {
  const double reach = std::min(pulse.reach(), kLobes * pulse.equivalent_length());
  double sum = 0.5, energy = 0.5;
  for (int i = 1; i * step <= reach; ++i) {
    sum += pulse.intensity(i * step) * std::cos(2 * std::numbers::pi * turns_per_metre * i * step);
    energy += pulse.intensity(i * step);
  }
  return sum / energy;
}

double sinc(double x) {
  return x == 0 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
}

}  // namespace

double carrier_correlation(const Pulse& pulse, double turns_per_metre) {
  constexpr double kStepsPerPulse = 32;
  return mean_cosine(pulse, turns_per_metre, pulse.equivalent_length() / kStepsPerPulse);
}

CarrierSpread carrier_spread(const Pulse& pulse, double bin_length, double window) {
  // Grid of the fit: frequencies in units of c / (2 window) up to the pulse's decorrelation, shares, lengths.
  constexpr int kFrequencies = 24, kShares = 15, kLengths = 8;
  std::vector<double> at, expected, sum_of_bins;
  for (int i = 1; i <= kFrequencies; ++i) {
    at.push_back(1.5 / window * i / kFrequencies);
    expected.push_back(square(carrier_correlation(pulse, at.back())));
    sum_of_bins.push_back(mean_cosine(pulse, at.back(), bin_length) * sinc(at.back() * window));
  }
  CarrierSpread best;
  double least = std::numeric_limits<double>::infinity();
  for (int share = 0; share <= kShares; ++share) {
    for (int length = 1; length <= kLengths; ++length) {
      const CarrierSpread spread{.share = 0.02 * share, .length = length * window};
      double worst = 0;
      for (int i = 0; i < kFrequencies; ++i) {
        const double one = 1 - spread.share + spread.share * sinc(at[i] * spread.length);
        worst = std::max(worst, std::abs(square(sum_of_bins[i] * one) - expected[i]));
      }
      if (worst < 0.99 * least) {
        least = worst;
        best = spread;
      }
    }
  }
  return best;
}

}  // namespace insonify
