// carrier_band.cpp -- fits the width of a cell's frequency bands to the correlation of the pulse.

#include "receiver/pulse/carrier_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace insonify {
namespace {

constexpr double kLobes = 30;  // Equivalent lengths of the pulse, on either side, that are summed.

// Mean of cos(2 pi turns r) over |p(r)|^2, sampled every `step` from the middle.
double mean_cosine(const Pulse& pulse, double turns_per_metre, double step) {
  const double reach = std::min(pulse.reach(), kLobes * pulse.equivalent_length());
  double sum = 0.5, energy = 0.5;
  for (int i = 1; i * step <= reach; ++i) {
    sum += pulse.intensity(i * step) * std::cos(2 * std::numbers::pi * turns_per_metre * i * step);
    energy += pulse.intensity(i * step);
  }
  return sum / energy;
}

double square(double x) {
  return x * x;
}

}  // namespace

double carrier_correlation(const Pulse& pulse, double turns_per_metre) {
  constexpr double kStepsPerPulse = 32;
  return mean_cosine(pulse, turns_per_metre, pulse.equivalent_length() / kStepsPerPulse);
}

double band_correlation(double bands) {
  const double quarter = 0.5 * std::numbers::pi * bands;
  return bands >= 2 ? 0 : (1 - bands / 2) * std::cos(quarter) + std::sin(quarter) / std::numbers::pi;
}

double carrier_band(const Pulse& pulse, double cell_length) {
  // Cells to the longer of cell and pulse; frequencies in c / (2 cell_length), up to where the pulse's correlation
  // ends.
  const double cells = std::max(1.0, cell_length / pulse.equivalent_length());
  constexpr int kFrequencies = 24;
  std::vector<double> at, expected, sum_of_cells;
  for (int i = 1; i <= kFrequencies; ++i) {
    at.push_back(1.5 * cells * i / kFrequencies);
    expected.push_back(square(carrier_correlation(pulse, at.back() / cell_length)));
    sum_of_cells.push_back(mean_cosine(pulse, at.back() / cell_length, cell_length));
  }
  double best = 1, least = std::numeric_limits<double>::infinity();
  for (double band = 0.3 * cells; band < 2 * cells; band += 0.05 * cells) {
    double worst = 0;
    for (int i = 0; i < kFrequencies; ++i) {
      worst = std::max(worst, std::abs(square(sum_of_cells[i] * band_correlation(at[i] / band)) - expected[i]));
    }
    if (worst < least) {
      least = worst;
      best = band;
    }
  }
  return best;
}

}  // namespace insonify
