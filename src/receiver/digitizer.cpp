// digitizer.cpp -- vectorized gamma and logarithmic mappings, both computed from the logarithm of intensity.

#include "receiver/digitizer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr float kRounder = 12582912.0F;  // Adding and subtracting 1.5 x 2^23 rounds a float to the nearest integer.
constexpr float kLeast = 1e-30F;         // Keeps the logarithm of 0 finite.

[[gnu::always_inline]] inline std::uint16_t count_of(float value, float most) {
  const float limited = value < 0 ? 0.0F : value > most ? most : value;
  return static_cast<std::uint16_t>(static_cast<std::int32_t>((limited + kRounder) - kRounder));
}

INSONIFY_VECTOR_CLONES
void map_logarithms(std::size_t count, const float* __restrict__ intensities, float per_full_scale, float most,
                    float slope, std::uint16_t* __restrict__ counts) {
  for (std::size_t i = 0; i < count; ++i) {
    const float level = fast_log(intensities[i] * per_full_scale + kLeast);
    counts[i] = count_of(most + slope * level, most);
  }
}

INSONIFY_VECTOR_CLONES
void map_powers(std::size_t count, const float* __restrict__ intensities, float per_full_scale, float most,
                float exponent, std::uint16_t* __restrict__ counts) {
  for (std::size_t i = 0; i < count; ++i) {
    const float level = fast_log(intensities[i] * per_full_scale + kLeast);
    counts[i] = count_of(most * fast_exp(exponent * (level < 1 ? level : 1.0F)), most);
  }
}

}  // namespace

Digitizer::Digitizer(const SonarConfig& sonar, double full_scale_db, std::optional<double> full_scale_share)
    : mapping_(sonar.mapping),
      max_count_(static_cast<float>((1 << sonar.bits) - 1)),
      per_full_scale_(static_cast<float>(std::pow(10.0, -full_scale_db / 10))),
      share_(full_scale_share),
      histogram_(full_scale_share ? kLevels : 0) {
  const double decibels_per_unit = 10 / std::log(10.0);
  exponent_ =
      static_cast<float>(mapping_ == Mapping::kGamma ? 0.5 * sonar.mapping_exponent
                                                     : double{max_count_} * decibels_per_unit / sonar.mapping_range_db);
}

// Non-negative floats sort like their bit patterns, so a histogram over the upper 16 bits gives the quantile.
void Digitizer::adapt(std::span<const float> intensities) {
  if (!share_) {
    return;
  }
  constexpr int kLowerBits = 15;  // 31 bits without the sign, 16 of which index the histogram.
  std::ranges::fill(histogram_, 0U);
  for (const float intensity : intensities) {
    ++histogram_[std::bit_cast<std::uint32_t>(intensity) >> kLowerBits];
  }
  const auto wanted = std::max(1.0, std::floor(*share_ * static_cast<double>(intensities.size())));
  double reached = 0;
  int level = kLevels;
  while (reached < wanted && level > 0) {
    reached += histogram_[static_cast<std::size_t>(--level)];
  }
  per_full_scale_ = 1 / std::max(std::bit_cast<float>(static_cast<std::uint32_t>(level) << kLowerBits), kLeast);
}

void Digitizer::digitize(std::span<const float> intensities, std::span<std::uint16_t> counts) const {
  assert(intensities.size() == counts.size());
  const auto map = mapping_ == Mapping::kGamma ? map_powers : map_logarithms;
  map(intensities.size(), intensities.data(), per_full_scale_, max_count_, exponent_, counts.data());
}

}  // namespace insonify
