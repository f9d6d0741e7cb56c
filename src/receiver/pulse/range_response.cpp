// range_response.cpp -- convolves rows of bins with the pulse directly, not by FFT: pulses are short.

#include "receiver/pulse/range_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr int kOutputBlock = 64;  // Output bins computed together.
constexpr int kTaps = 64;         // Taps applied together.

constexpr int kLanes = 16;  // Floats of a vector register of AVX-512; others take several.

// sums[v] += sum over taps of gains[tap] x values[v + tap], for kOutputBlock bins of kWidth floats each (1: real, 2:
// complex). Sums stay in registers over all taps: the innermost loop is one vector instruction, and must not be
// unrolled before it is.
template <int kWidth>
[[gnu::always_inline]] inline void add_taps(const float* __restrict__ gains, int taps, const float* __restrict__ values,
                                            float* __restrict__ sums) {
  constexpr int kRegisters = 4, kTogether = kRegisters * kLanes;
  for (int start = 0; start < kOutputBlock * kWidth; start += kTogether) {
    float own[kRegisters][kLanes] = {};
    for (int tap = 0; tap < taps; ++tap) {
      const float* const at = values + start + static_cast<std::ptrdiff_t>(tap) * kWidth;
#pragma GCC unroll 4
      for (int i = 0; i < kRegisters; ++i) {
#pragma GCC unroll 1
        for (int v = 0; v < kLanes; ++v) {
          own[i][v] += gains[tap] * at[i * kLanes + v];
        }
      }
    }
    for (int i = 0; i < kRegisters; ++i) {
      for (int v = 0; v < kLanes; ++v) {
        sums[start + i * kLanes + v] += own[i][v];
      }
    }
  }
}

INSONIFY_VECTOR_CLONES
void add_energy_taps(const float* gains, int taps, const float* values, float* sums) {
  add_taps<1>(gains, taps, values, sums);
}

INSONIFY_VECTOR_CLONES
void add_field_taps(const float* gains, int taps, const float* values, float* sums) {
  add_taps<2>(gains, taps, values, sums);
}

// Copies the cell number `phase` of each of the bins [first, first + count) to consecutive values; zeros beyond the
// ends of the row.
template <typename Value>
void gather(std::span<const Value> cells, int cells_per_bin, int phase, int first, int count, Value* values) {
  const int bins = static_cast<int>(cells.size()) / cells_per_bin;
  const int begin = std::clamp(-first, 0, count);
  const int end = std::clamp(bins - first, begin, count);
  std::fill(values, values + begin, Value{});
  if (cells_per_bin == 1) {
    std::copy(cells.begin() + first + begin, cells.begin() + first + end, values + begin);
  }
  for (int i = begin; cells_per_bin > 1 && i < end; ++i) {
    values[i] = cells[static_cast<std::size_t>(first + i) * cells_per_bin + phase];
  }
  std::fill(values + end, values + count, Value{});
}

// Convolves a row of cells with the pulse, into one value per bin. The cells of one phase (the i-th cell of every bin)
// are gathered into consecutive values and convolved as if each bin had only that cell; the results of all phases add.
// @param first, count  Bins that contribute to each bin, relative to it: [first, first + count).
// @param gains         Taps, [phase][count].
template <typename Value, typename AddTaps>
void convolve(std::span<const Value> cells, std::span<Value> bins, int cells_per_bin, int first, int count,
              const std::vector<float>& gains, const AddTaps& add) {
  assert(cells.size() == bins.size() * cells_per_bin);
  alignas(64) Value values[kOutputBlock + kTaps];
  alignas(64) Value sums[kOutputBlock];
  for (int start = 0; start < static_cast<int>(bins.size()); start += kOutputBlock) {
    std::fill_n(sums, kOutputBlock, Value{});
    for (int phase = 0; phase < cells_per_bin; ++phase) {
      for (int tap = 0; tap < count; tap += kTaps) {
        const int taps = std::min(kTaps, count - tap);
        gather(cells, cells_per_bin, phase, start + first + tap, kOutputBlock + taps - 1, values);
        add(&gains[static_cast<std::size_t>(phase) * count + tap], taps, reinterpret_cast<const float*>(values),
            reinterpret_cast<float*>(sums));
      }
    }
    std::copy_n(sums, std::min(kOutputBlock, static_cast<int>(bins.size()) - start), &bins[start]);
  }
}

// Distance, in cells, from the pulse's middle to its last cell with an energy of at least `floor`.
int reach_of(const Pulse& pulse, double cell_length, double floor) {
  auto reach = static_cast<int>(std::ceil(pulse.reach() / cell_length));
  while (reach > 0 && pulse.intensity(reach * cell_length) < floor) {
    --reach;
  }
  return reach;
}

// Integer division, rounded towards minus infinity.
int divide_down(int number, int divisor) {
  return number >= 0 ? number / divisor : -((divisor - 1 - number) / divisor);
}

}  // namespace

RangeResponse::RangeResponse(const Pulse& pulse, double bin_length, int cells_per_bin, double floor_db)
    : cells_per_bin_(cells_per_bin) {
  assert(cells_per_bin % 2 == 1);
  const double cell_length = bin_length / cells_per_bin;
  const int reach = reach_of(pulse, cell_length, std::pow(10, floor_db / 10));
  const int middle = cells_per_bin / 2;
  taps_ = 2 * reach + 1;
  first_ = divide_down(middle - reach, cells_per_bin);
  count_ = divide_down(middle + reach, cells_per_bin) - first_ + 1;
  energy_.resize(static_cast<std::size_t>(cells_per_bin) * count_);
  amplitude_.resize(energy_.size());
  for (int tap = -reach; tap <= reach; ++tap) {
    const int cell = middle + tap;
    const int bin = divide_down(cell, cells_per_bin);
    const std::size_t place = static_cast<std::size_t>(cell - bin * cells_per_bin) * count_ + (bin - first_);
    amplitude_[place] = static_cast<float>(pulse.amplitude(tap * cell_length));
    energy_[place] = static_cast<float>(pulse.intensity(tap * cell_length));
    equivalent_cells_ += pulse.intensity(tap * cell_length);
  }
}

float RangeResponse::amplitude(int bins_away) const {
  const int tap = bins_away - first_;
  const std::size_t row = static_cast<std::size_t>(cells_per_bin_ / 2) * count_;
  return tap >= 0 && tap < count_ ? amplitude_[row + tap] : 0.0F;
}

BinRange RangeResponse::reached_from(BinRange filled, int bin_count) const {
  const BinRange received{filled.first - (first_ + count_ - 1), filled.last - first_};
  return filled.empty() ? filled : received & BinRange{0, bin_count};
}

void RangeResponse::receive_energy(std::span<const float> cells, std::span<float> bins) const {
  convolve(cells, bins, cells_per_bin_, first_, count_, energy_, add_energy_taps);
}

void RangeResponse::receive_field(std::span<const std::complex<float>> cells,
                                  std::span<std::complex<float>> bins) const {
  convolve(cells, bins, cells_per_bin_, first_, count_, amplitude_, add_field_taps);
}

}  // namespace insonify
