// deposit_echo.cpp -- an echo by itself, spread over the few cells that its footprint touches.

#include <algorithm>

#include "echo/grid/label_vote.h"
#include "echo/grid/lanes.h"
#include "echo/grid/surface_tally.h"
#include "echo/model/deposit.h"

namespace insonify {
namespace {

// In cells from the first it touches; its weight is even over them.
struct Spread {
  float low, high, density;
};

// In cells whose near edges are given: of one, or of as many as vectors have lanes.
template <typename Value>
[[gnu::always_inline]] inline Value weight_in(Value edge, const Spread& spread) {
  const Value zero = {};
  return larger(smaller(edge + 1, spread.high + zero) - larger(edge, spread.low + zero), zero) * spread.density;
}

// To the cells from `i` on.
template <typename Label, typename Value>
[[gnu::always_inline]] inline void add(const Echo& echo, Value weight, bool labelled, const EchoGrid::Cells& cells,
                                       int i) {
  const Value energy = weight * echo.power;
  add_to(cells.energy + i, energy);
  add_to(cells.weight + i, weight);
  if (labelled) {
    const LabelVote<Label, Value> before{load<Label>(cells.surface + i), load<Value>(cells.lead + i),
                                         load<Value>(cells.label_energy + i), load<Value>(cells.elevation_moment + i)};
    const auto after = counted(before, Label{} | echo.surface, energy, Value(energy * echo.elevation), weight);
    store(cells.surface + i, after.surface);
    store(cells.lead + i, after.lead);
    store(cells.label_energy + i, after.energy);
    store(cells.elevation_moment + i, after.moment);
  }
}

}  // namespace

void deposit(const PingPlan& plan, const Echo& echo, EchoGrid& grid) {
  const int beam = plan.beam_of(echo.azimuth);
  const float middle = (0.5F * echo.path_length - plan.first_bin_at) * plan.bins_per_metre;
  const auto bins = static_cast<float>(plan.sonar.bin_count);
  const float reach = echo.half_length * plan.bins_per_metre + least_half_length(middle);
  const float low = middle - reach, high = middle + reach;
  if (beam < 0 || !(high > 0) || !(low < bins)) {
    return;
  }
  const int first = low > 0 ? static_cast<int>(low) : 0;
  const int last = high < bins ? static_cast<int>(high) + 1 : plan.sonar.bin_count;
  const int count = last - first;
  const EchoGrid::Cells cells = grid.to_fill(echo.order, beam, {first, last});
  const auto start = static_cast<float>(first);
  const Spread spread{low - start, high - start, echo.weight / (high - low)};
  if (grid.ground_truth() == GroundTruth::kFull) {
    const float elevation = echo.elevation - plan.middle_elevation;
    for (int i = 0; i < count; ++i) {
      const float weight = weight_in(static_cast<float>(i), spread), energy = weight * echo.power;
      tally({echo.surface, energy, energy * elevation, energy * elevation * elevation}, weight, cells.surface[i],
            cells.tallies[i]);
    }
  }
  int i = 0;
  for (; i < count && first + i + kLanes <= plan.sonar.bin_count; i += kLanes) {  // What is beyond `last` gets nothing.
    add<Labels>(echo, weight_in(static_cast<float>(i) + Floats{0, 1, 2, 3}, spread), grid.labelled(), cells, i);
  }
  for (; i < count; ++i) {
    add<SurfaceLabel>(echo, weight_in(static_cast<float>(i), spread), grid.labelled(), cells, i);
  }
}

}  // namespace insonify
