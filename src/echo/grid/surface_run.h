// surface_run.h -- what a run of neighbouring samples on one surface gives to the bins of their beam.

#pragma once

#include <algorithm>
#include <vector>

#include "echo/grid/lanes.h"

namespace insonify {

/// Half the least length of a segment at a position, on either side of bin 0 [bins]: keeps its density finite in single
/// precision.
constexpr float least_half_length(float position) {
  return 1e-7F * std::max(position < 0 ? -position : position, 500.0F);
}

/// Echo spread evenly over an interval of positions [bins, from the near edge of bin 0], its power changing linearly.
struct FootprintSegment {
  float low, high;  ///< Ends. Nothing is spread unless low < high.
  float power;      ///< Of the straight line through the powers, at position 0.
  float half_rise;  ///< Half the change of power per bin.
  float density;    ///< Weight per bin [sr].
  float elevation;  ///< Of the echo [rad].
};

/// Sums over one run, of each bin: little enough to stay in the nearest cache. All zero between runs. The square is
/// that of the elevation's difference from a datum, since squares keep more digits when they are small; it is summed
/// with GroundTruth::kFull only.
struct SurfaceSums {
  std::vector<float> energy, weight, moment, square;  ///< Sums of energy, weight, energy x elevation and x square.

  /// Gets ready for so many bins; allocates only when it needs more memory than any before.
  void prepare(int bins) {
    for (auto* sums : {&energy, &weight, &moment, &square}) {
      sums->resize(std::max(sums->size(), static_cast<std::size_t>(bins) + std::size_t{2} * kLanes), 0.0F);
    }
  }
};

/// Adds segments to sums, and keeps track of where. Held by value in the loop that adds, so that it lives in
/// registers.
/// @tparam kSquares  Whether squares are summed too.
template <bool kSquares>
class SurfaceRun {
 public:
  /// @param datum  [rad]
  SurfaceRun(SurfaceSums& sums, float datum)
      : datum_(datum),
        energy_(sums.energy.data()),
        weight_(sums.weight.data()),
        moment_(sums.moment.data()),
        square_(sums.square.data()) {}

  /// @param segment  With 0 <= low and high within the bins that the sums were prepared for.
  [[gnu::always_inline]] void add(const FootprintSegment& segment) {
    int bin = static_cast<int>(segment.low);
    first_ = std::min(first_, bin);
    do {
      const Floats low_edge = static_cast<float>(bin) + Floats{0, 1, 2, 3};
      const Floats high_edge = low_edge + 1;
      const Floats from = larger(low_edge, segment.low + Floats{});
      const Floats to = smaller(high_edge, segment.high + Floats{});
      const Floats weight = larger(to - from, Floats{}) * segment.density;
      const Floats energy = weight * (segment.power + (from + to) * segment.half_rise);
      add_to(energy_ + bin, energy);
      add_to(weight_ + bin, weight);
      add_to(moment_ + bin, energy * segment.elevation);
      if constexpr (kSquares) {
        const float beyond = segment.elevation - datum_;
        add_to(square_ + bin, energy * (beyond * beyond));
      }
      bin += kLanes;
    } while (static_cast<float>(bin) < segment.high);
    last_ = std::max(last_, bin);
  }

  /// Bins that anything was added to since restart() are in [first, last); none where first is not below last.
  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int last() const { return last_; }
  void restart() {
    first_ = kNone;
    last_ = 0;
  }

 private:
  static constexpr int kNone = 1 << 30;
  float datum_;
  float* __restrict__ energy_, * __restrict__ weight_, * __restrict__ moment_, * __restrict__ square_;
  int first_ = kNone, last_ = 0;
};

}  // namespace insonify
