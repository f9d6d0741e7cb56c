// sampling_error.cpp -- differences of levels between images.

#include "benchmark/sampling_error.h"

#include <algorithm>
#include <cmath>

namespace insonify {

void SamplingError::add(std::span<const float> image, std::span<const float> converged, float full_scale) {
  constexpr double kSpot = 6;  // [dB]
  if (!(full_scale > 0)) {
    return;
  }
  const double floor = double{full_scale} * std::pow(10, -range_db_ / 10);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double here = image[i], there = converged[i];
    sum_ += here;
    converged_sum_ += there;
    if (std::max(here, there) < floor) {
      continue;
    }
    const double difference = 10 * std::log10(std::max(here, floor) / std::max(there, floor));
    squares_ += difference * difference;
    ++cells_;
    spots_ += difference > kSpot ? 1 : 0;
    holes_ += difference < -kSpot ? 1 : 0;
  }
}

double SamplingError::rms_db() const {
  return cells_ > 0 ? std::sqrt(squares_ / static_cast<double>(cells_)) : 0;
}

double SamplingError::spots() const {
  return cells_ > 0 ? static_cast<double>(spots_) / static_cast<double>(cells_) : 0;
}

double SamplingError::holes() const {
  return cells_ > 0 ? static_cast<double>(holes_) / static_cast<double>(cells_) : 0;
}

double SamplingError::level_db() const {
  return sum_ > 0 && converged_sum_ > 0 ? 10 * std::log10(sum_ / converged_sum_) : 0;
}

}  // namespace insonify
