// gamma_quantiles.cpp -- integrates the gamma density and inverts the integral at evenly spaced points.

#include "base/gamma_quantiles.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

constexpr float kStepsPerUnit = 16;  // Table entries per unit of v = log(u / (1 - u)).
constexpr float kGreatest = 16.6F;   // v of the greatest random number u below 1.

}  // namespace

// Integrates the density of y = log x, which is proportional to exp(nu (y - e^y)) and smooth for every nu > 0, by the
// trapezoidal rule; then inverts the integral at evenly spaced v, with linear interpolation in y.
GammaQuantiles::GammaQuantiles(double shape) {
  const double lowest = std::min(-18.5 / shape, -10 / std::sqrt(shape));
  const double highest = std::log(1 + 40 / shape + 10 / std::sqrt(shape));
  constexpr int kSteps = 16384;
  const double step = (highest - lowest) / kSteps;
  std::vector<double> below(kSteps + 1, 0.0);
  double before = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double y = lowest + i * step, density = std::exp(shape * (y - std::exp(y) + 1));
    below[i] = i == 0 ? 0 : below[i - 1] + 0.5 * step * (before + density);
    before = density;
  }
  const auto count = static_cast<int>(2 * kGreatest * kStepsPerUnit) + 3;
  int i = 0;
  for (int k = 0; k < count; ++k) {
    const double share = below.back() / (1 + std::exp(double{kGreatest} - k / double{kStepsPerUnit}));
    while (i + 2 < static_cast<int>(below.size()) && below[i + 1] < share) {
      ++i;
    }
    const double part = std::clamp((share - below[i]) / (below[i + 1] - below[i]), 0.0, 1.0);
    values_.push_back(static_cast<float>(std::exp(lowest + (i + part) * step)));
  }
}

float GammaQuantiles::at(float v) const {
  const float place = (std::clamp(v, -kGreatest, kGreatest) + kGreatest) * kStepsPerUnit;
  const auto below = static_cast<int>(place);
  return values_[below] + (place - static_cast<float>(below)) * (values_[below + 1] - values_[below]);
}

}  // namespace insonify
