// coarse_bins.cpp -- separates compact from extended echoes and transforms the distribution of one look.

#include "receiver/pulse/coarse_bins.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr float kTimesNeighbours = 2;  // Energy above this multiple of its neighbours' is compact.

}  // namespace

CoarseBins::CoarseBins(const Pulse& pulse, double bin_length, const RangeResponse& response, Decimation decimation)
    : decimation_(decimation), looks_(std::max(1.0, bin_length / pulse.equivalent_length())) {
  share_ = static_cast<float>(pulse.equivalent_length() / bin_length / response.equivalent_cells());
  if (looks_ > 1) {
    discrete_ = decimation == Decimation::kMean ? static_cast<float>(1 / looks_) : 1;
    if (decimation == Decimation::kMean) {
      mean_of_looks_.emplace(looks_);
    }
  }
}

void CoarseBins::receive(std::span<float> energy) const {
  if (decimation_ == Decimation::kMean && looks_ > 1) {
    for (float& value : energy) {
      value *= share_;
    }
    return;
  }
  float before = 0;
  for (std::size_t i = 0; i < energy.size(); ++i) {
    const float here = energy[i], after = i + 1 < energy.size() ? energy[i + 1] : 0;
    const float extended = std::min(here, kTimesNeighbours * std::max(before, after));
    energy[i] = (here - extended) + share_ * extended;
    before = here;
  }
}

void CoarseBins::receive(std::span<float> energy, std::span<float> extended) const {
  std::ranges::copy(energy, extended.begin());
  receive(energy);
  for (std::size_t i = 0; i < energy.size(); ++i) {
    // energy = compact + share extended, extended here = compact + extended.
    const float whole = extended[i];
    extended[i] = share_ < 1 ? std::max(0.0F, whole - energy[i]) * share_ / (1 - share_) : whole;
  }
}

// Greatest of n exponentially distributed numbers: P(y) = (1 - e^-y)^n, so that y = -ln(1 - (1 - e^-x)^(1/n)) has it
// where x is exponentially distributed. The mean of n has a gamma distribution of shape n.
float CoarseBins::kept(float intensity, float mean, float extended) const {
  constexpr float kFar = 12;  // Beyond this, e^-x is lost to rounding: y = x + ln n.
  constexpr float kNear = 1e-3F;
  const float x = intensity / mean;
  if (!(x > 0) || !has_looks()) {
    return intensity;
  }
  const float below = x < kNear ? x - 0.5F * x * x : 1 - fast_exp(-std::min(x, kFar));  // Probability of less than x.
  if (decimation_ == Decimation::kMean) {
    const float odds = x > kFar ? x : fast_log(below) + x;  // Logarithm of below / (1 - below).
    return mean * (extended * mean_of_looks_->at(odds) + (1 - extended) * x);
  }
  const float looks = 1 + (static_cast<float>(looks_) - 1) * extended;
  return mean * (x > kFar ? x + fast_log(looks) : -fast_log(std::max(1 - fast_exp(fast_log(below) / looks), 1e-7F)));
}

}  // namespace insonify
