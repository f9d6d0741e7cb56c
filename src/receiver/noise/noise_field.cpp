// noise_field.cpp -- filters white noise along range and forms beams of it.

#include "receiver/noise/noise_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vector_math.h"
#include "receiver/normal_numbers.h"

namespace insonify {
namespace {

constexpr int kLeastTaps = 8, kMostTaps = 64;
constexpr double kTapsPerPulse = 12;  // Length of the filter in equivalent lengths of the pulse.
constexpr int kMostFitted = 32;       // Tones longer than so many bins are filtered by a sum over their length.
constexpr double kReach = 16;         // Orthogonal beams on either side that a beam is formed from.
constexpr int kLeastValues = 32, kMostValues = 128;  // Values that a task forms beams of.

// Bohman's window: 1 at 0 with slope 0, 0 at 1 and beyond. Its transform is non-negative, so that a correlation
// multiplied by it remains positive semidefinite.
double bohman(double x) {
  return x >= 1 ? 0 : (1 - x) * std::cos(std::numbers::pi * x) + std::sin(std::numbers::pi * x) / std::numbers::pi;
}

// Correlation at 0, 1, ... bins. A chirp's is tapered to a few lengths of its resolution.
std::vector<double> correlation_of(const Pulse& pulse, double bin_length) {
  const double wanted = std::ceil(kTapsPerPulse * pulse.equivalent_length() / bin_length);
  const int taps = std::clamp(static_cast<int>(std::min<double>(wanted, kMostTaps)), kLeastTaps, kMostTaps);
  constexpr double kRounding = 1e-6;  // Keeps rounding from adding a tap to a pulse of a whole number of bins.
  const int reach = std::max(1, static_cast<int>(std::ceil(std::min(pulse.reach() / bin_length, 1e6) - kRounding)));
  const int end = std::min(reach, taps);
  const bool has_side_lobes = std::isfinite(pulse.side_lobe_db());  // Cut short, they leave no correlation.
  std::vector<double> correlation;
  for (int k = 0; k < end; ++k) {
    const double taper = has_side_lobes ? bohman(static_cast<double>(k) / end) : 1;
    correlation.push_back(taper * pulse.noise_correlation(k * bin_length));
  }
  return correlation;
}

// Spectral factorisation by Bauer's method: the rows of the Cholesky factor of the Toeplitz matrix of a correlation
// tend to the taps of the minimum-phase filter that gives white noise this correlation.
std::vector<double> filter_of(const std::vector<double>& correlation) {
  constexpr double kRidge = 1e-3;  // Added to the diagonal: a spectrum with zeros is only semidefinite.
  const auto order = static_cast<int>(correlation.size()) - 1;
  const int size = order + 1, steps = 64 * size;
  std::vector<double> factor(static_cast<std::size_t>(size) * size, 0.0);  // [row modulo size][row - column].
  for (int row = 0; row < steps; ++row) {
    double* const here = &factor[static_cast<std::size_t>(row % size) * size];
    for (int k = std::min(row, order); k >= 0; --k) {
      const double* const above = &factor[static_cast<std::size_t>((row - k) % size) * size];
      double rest = correlation[k] + (k == 0 ? kRidge : 0);
      for (int m = k + 1; m <= std::min(row, order); ++m) {
        rest -= here[m] * above[m - k];
      }
      here[k] = k == 0 ? std::sqrt(std::max(rest, kRidge)) : rest / above[0];
    }
  }
  const auto last = factor.begin() + static_cast<std::ptrdiff_t>((steps - 1) % size) * size;
  return {last, last + size};
}

// values[i] = sum over k of taps[k] white[i + taps - 1 - k].
INSONIFY_VECTOR_CLONES
void filter(const float* __restrict__ taps, int tap_count, const float* __restrict__ white, int count,
            float* __restrict__ values) {
  for (int i = 0; i < count; ++i) {
    values[i] = taps[0] * white[i + tap_count - 1];
  }
  for (int k = 1; k < tap_count; ++k) {
    const float* from = white + (tap_count - 1 - k);
    const float tap = taps[k];
    for (int i = 0; i < count; ++i) {
      values[i] += tap * from[i];
    }
  }
}

}  // namespace

std::vector<float> noise_taps(const Pulse& pulse, double bin_length) {
  const double tone = pulse.equivalent_length() * 1.5 / bin_length;  // Length of a matched tone [bins].
  const bool is_long_tone = tone > kMostFitted && pulse.noise_correlation(0.5 * tone * bin_length) > 0.49 &&
                            pulse.noise_correlation(1.01 * tone * bin_length) == 0;
  std::vector<double> taps = is_long_tone ? std::vector<double>(static_cast<std::size_t>(std::lround(tone)), 1.0)
                                          : filter_of(correlation_of(pulse, bin_length));
  double power = 0;
  for (const double tap : taps) {
    power += tap * tap;
  }
  std::vector<float> scaled;
  scaled.reserve(taps.size());
  for (const double tap : taps) {
    scaled.push_back(static_cast<float>(tap / std::sqrt(power)));
  }
  return scaled;
}

NoiseField::NoiseField(const Settings& settings)
    : beams_(settings.beams),
      bins_(settings.bins),
      rows_(settings.beams),
      seed_(settings.seed),
      taps_(noise_taps(settings.pulse, settings.bin_length)) {
  if (settings.array != nullptr && beams_ > 1) {
    const auto [low, high] = std::ranges::minmax(settings.beam_sines);
    const double reach = kReach;
    const auto first = static_cast<int>(std::floor(low * settings.length - reach));
    rows_ = static_cast<int>(std::ceil(high * settings.length + reach)) - first + 1;
    gains_.emplace(beams_, rows_);
    for (int beam = 0; beam < beams_; ++beam) {
      const double place = settings.beam_sines[beam] * settings.length - first;
      const int from = std::max(0, static_cast<int>(std::ceil(place - reach)));
      const int to = std::min(rows_, static_cast<int>(std::floor(place + reach)) + 1);
      double power = 0;
      for (int row = from; row < to; ++row) {
        power += settings.array->intensity(row - place);
      }
      for (int row = from; row < to; ++row) {
        gains_->set(beam, row, static_cast<float>(settings.array->amplitude(row - place).real() / std::sqrt(power)));
      }
      gains_->limit(beam, from, to);
    }
    beam_values_.resize(static_cast<std::size_t>(beams_) * 2 * bins_);
  }
  row_values_.resize(static_cast<std::size_t>(rows_) * 2 * bins_);
}

void draw_filtered_row(std::span<const float> taps, RandomPurpose in_phase, RandomPurpose quadrature, int row,
                       std::uint64_t ping, std::uint64_t seed, std::vector<float>& white, std::span<float> values) {
  const auto tap_count = static_cast<int>(taps.size()), bins = static_cast<int>(values.size()) / 2;
  const int needed = bins + tap_count - 1, blocks = (needed + kTileBins - 1) / kTileBins;
  white.resize(std::max(white.size(), static_cast<std::size_t>(blocks) * kTileBins));
  for (const RandomPurpose part : {in_phase, quadrature}) {
    for (int block = 0; block < blocks; ++block) {
      draw_normals(part, block, row, ping, seed, &white[static_cast<std::size_t>(block) * kTileBins]);
    }
    filter(taps.data(), tap_count, white.data(), bins, values.data() + (part == in_phase ? 0 : bins));
  }
}

static_assert(FlatReceiver::kNoiseBlock == kTileBins);

void NoiseField::draw(std::uint64_t ping, Workers& workers) {
  white_.resize(std::max(white_.size(), static_cast<std::size_t>(workers.count())));
  const auto values_of_row = 2 * static_cast<std::size_t>(bins_);
  workers.for_each(rows_, [&](int row, int worker) {
    draw_filtered_row(taps_, RandomPurpose::kNoiseInPhase, RandomPurpose::kNoiseQuadrature, row, ping, seed_,
                      white_[worker], std::span(row_values_).subspan(row * values_of_row, values_of_row));
  });
  if (gains_) {
    const int values = 2 * bins_;
    const int per_task = workers.part_length(values, kLeastValues, kMostValues);
    workers.for_each((values + per_task - 1) / per_task, [&](int task, int) {
      const int first = task * per_task;
      gains_->multiply(row_values_.data(), beam_values_.data(), values, first, std::min(first + per_task, values));
    });
  }
}

void NoiseField::silence(int bins) {
  std::vector<float>& values = gains_ ? beam_values_ : row_values_;
  for (std::size_t row = 0; row < 2 * static_cast<std::size_t>(beams_); ++row) {
    std::fill_n(&values[row * bins_], bins, 0.0F);
  }
}

}  // namespace insonify
