// surface_run.h -- what a run of neighbouring samples on one surface gives to the bins of their beam.

#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

namespace insonify {

/// Half the least length of a stretch [bins]: keeps its density finite.
inline constexpr float kShortestStretch = 5e-5F;

/// Sums over one run, bin by bin, small enough to stay in the nearest cache; four neighbouring bins at a time.
/// Neighbouring samples add to different ones of kSets sets of sums: a sum that was just stored elsewhere in the same
/// few bins would have to be waited for. Positions are in bins, from the near edge of bin 0.
class SurfaceRun {
 public:
  /// Gets ready for so many bins; allocates only when it needs more memory than any before.
  void prepare(int bins) {
    bins_ = static_cast<float>(bins);
    stride_ = std::max(stride_, (bins + 2 * kLanes - 1) / kLanes * kLanes);
    sums_.resize(std::max(sums_.size(), static_cast<std::size_t>(kSets) * 3 * stride_), 0.0F);
  }

  /// Spreads a stretch of surface evenly over the positions from `low` to `high`, which differ; the power rises
  /// linearly from `power_low`. What lies outside the bins is dropped.
  /// @param sample   Number in the column.
  /// @param rise     Change of power per bin.  @param density  Weight per bin.
  void add_stretch(int sample, float low, float high, float power_low, float rise, float density, float elevation) {
    const float end = std::min(high, bins_);
    if (!(high > 0 && low < bins_)) {
      return;
    }
    int bin = static_cast<int>(std::max(low, 0.0F));
    first_ = std::min(first_, bin);
    float* sums = &sums_[static_cast<std::size_t>(sample % kSets) * 3 * stride_];
    do {
      const Floats low_edge = static_cast<float>(bin) + Floats{0, 1, 2, 3};
      const Floats high_edge = low_edge + 1;
      const Floats from = low_edge > low ? low_edge : low + Floats{};
      const Floats to = high_edge < end ? high_edge : end + Floats{};
      const Floats weight = (to > from ? to - from : Floats{}) * density;
      const Floats energy = weight * (power_low + (0.5F * (from + to) - low) * rise);
      add(sums + bin, energy);
      add(sums + stride_ + bin, weight);
      add(sums + 2 * stride_ + bin, energy * elevation);
      bin += kLanes;
    } while (static_cast<float>(bin) < end);
    last_ = std::max(last_, bin);
  }

  /// Bins that anything was added to are in [first, last); none where first is not below last.
  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int last() const { return std::min(last_, static_cast<int>(bins_)); }

  /// Sums of one set, of each bin. Whoever takes them leaves zeros there.
  [[nodiscard]] float* energy(int set) { return &sums_[static_cast<std::size_t>(set) * 3 * stride_]; }
  [[nodiscard]] float* weight(int set) { return energy(set) + stride_; }
  [[nodiscard]] float* moment(int set) { return energy(set) + 2 * stride_; }  ///< Sum of energy x elevation [rad].
  static constexpr int kSets = 4;

  /// After the sums were taken.
  void restart() {
    first_ = kNone;
    last_ = 0;
  }

 private:
  static constexpr int kLanes = 4;
  static constexpr int kNone = 1 << 30;
  using Floats = float __attribute__((vector_size(16)));

  static void add(float* sums, Floats values) {
    Floats lanes;
    std::memcpy(&lanes, sums, sizeof lanes);
    lanes += values;
    std::memcpy(sums, &lanes, sizeof lanes);
  }

  std::vector<float> sums_;  // [set][energy, weight, moment][bin]
  int stride_ = 0;
  float bins_ = 0;
  int first_ = kNone, last_ = 0;
};

}  // namespace insonify
