// coarse_bins.cpp -- separates compact from extended echoes and transforms the distribution of one look.

#include "receiver/pulse/coarse_bins.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/vector_math.h"
#include "echo/laws/laws.h"

namespace insonify {
namespace {

constexpr int kBlock = 128;  // Bins computed together.

// Energy of one look in bins [0, count).
// @param pairs   Share of what two bins have above their neighbours that counts as compact.
// @param energy  From two bins before the first to two after the last.
INSONIFY_VECTOR_CLONES
void take_look(int count, float share, float pairs, const float* __restrict__ energy, float* __restrict__ look) {
  for (int i = 0; i < count; ++i) {
    look[i] = one_look({energy[i], energy[i + 1], energy[i + 2], energy[i + 3], energy[i + 4]}, share, pairs);
  }
}

}  // namespace

CoarseBins::CoarseBins(const Pulse& pulse, double bin_length, const RangeResponse& response, Decimation decimation)
    : decimation_(decimation), looks_(std::max(1.0, bin_length / pulse.equivalent_length())) {
  share_ = static_cast<float>(pulse.equivalent_length() / bin_length / response.equivalent_cells());
  if (looks_ > 1) {
    pairs_ = static_cast<float>(std::log(looks_) / (looks_ - 1));
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
  constexpr int kBeside = 2;  // Bins on each side that each is compared with.
  float block[kBlock + 2 * kBeside] = {};
  const auto size = static_cast<int>(energy.size());
  for (int start = 0; start < size; start += kBlock) {
    const int count = std::min(kBlock, size - start), with_next = std::min(count + kBeside, size - start);
    std::copy_n(&energy[start], with_next, block + kBeside);
    std::fill(block + kBeside + with_next, std::end(block), 0.0F);  // Beyond the end.
    take_look(count, share_, pairs_, block, &energy[start]);
    std::copy_n(block + kBlock, kBeside, block);
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
