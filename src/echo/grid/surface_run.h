// surface_run.h -- sums the echoes of a run of neighbouring samples on one surface, by range bin.

#pragma once

#include <algorithm>
#include <vector>

#include "echo/grid/lanes.h"
#include "echo/laws/laws.h"

namespace insonify {

/// Sums over one run, per bin: four short arrays that stay in the first-level cache. All zero between runs.
struct SurfaceSums {
  std::vector<float> energy, weight;
  std::vector<float> moment;  ///< Sum of energy x elevation [rad].
  std::vector<float> square;  ///< Sum of energy x (elevation - datum)^2 [rad^2]; with GroundTruth::kFull only. The
                              ///< datum keeps the squares small, so that they lose fewer digits.

  /// Prepares for a number of bins. Allocates only if it needs more memory than ever before.
  void prepare(int bins) {
    for (auto* sums : {&energy, &weight, &moment, &square}) {
      sums->resize(std::max(sums->size(), static_cast<std::size_t>(bins) + std::size_t{2} * kLanes), 0.0F);
    }
  }
};

/// Adds segments to sums, and keeps track of the bins. A local variable of the loop that adds, so that its members are
/// held in registers.
/// @tparam kSquares  Whether to sum squares.
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

  /// @param segment  0 <= low, and high at most the number of bins that the sums were prepared for.
  [[gnu::always_inline]] void add(const FootprintSegment& segment) {
    lowest_ = std::min(lowest_, segment.low);
    highest_ = std::max(highest_, segment.high);
    int bin = static_cast<int>(segment.low);
    Floats low_edge = static_cast<float>(bin) + Floats{0, 1, 2, 3};
    do {
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
      low_edge += kLanes;
    } while (low_edge[0] < segment.high);
  }

  /// Bins added to since restart(): [first, last), empty if first >= last.
  [[nodiscard]] int first() const { return static_cast<int>(lowest_); }
  [[nodiscard]] int last() const {
    const int whole = static_cast<int>(highest_);
    return whole + (static_cast<float>(whole) < highest_ ? 1 : 0);
  }
  void restart() {
    lowest_ = kNone;
    highest_ = 0;
  }

 private:
  static constexpr float kNone = 1 << 30;
  float datum_;
  float* __restrict__ energy_, * __restrict__ weight_, * __restrict__ moment_, * __restrict__ square_;
  float lowest_ = kNone, highest_ = 0;  // As positions.
};

}  // namespace insonify
