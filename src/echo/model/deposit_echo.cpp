// deposit_echo.cpp -- spreads one secondary echo over the cells of its footprint.

#include <algorithm>

#include "echo/grid/lanes.h"
#include "echo/grid/surface_label.h"
#include "echo/model/deposit.h"

namespace insonify {
namespace {

// Interval that an echo is spread over, counted in cells from the first one it touches, and its weight per cell.
struct Spread {
  float low, high, density;
};

// Weight of the echo in the cell with the given near edge, or in kLanes cells if Value is a vector.
template <typename Value>
[[gnu::always_inline]] inline Value weight_in(Value edge, const Spread& spread) {
  const Value zero = {};
  return larger(smaller(edge + 1, spread.high + zero) - larger(edge, spread.low + zero), zero) * spread.density;
}

[[gnu::always_inline]] inline bool any(SurfaceLabel lane) {
  return lane != 0;
}
[[gnu::always_inline]] inline bool any(Labels lanes) {
  return (lanes[0] | lanes[1] | lanes[2] | lanes[3]) != 0;
}

// Adds the echo to cell `i`, or to kLanes cells from `i` on. Where another surface is the strongest so far, only energy
// and weight are added; returns whether there is such a cell.
template <typename Label, typename Value>
[[gnu::always_inline]] inline bool add(const Echo& echo, Value weight, bool labelled, const EchoGrid::Cells& cells,
                                       int i) {
  const Value energy = weight * echo.power;
  add_to(cells.energy + i, energy);
  add_to(cells.weight + i, weight);
  if (!labelled) {
    return false;
  }
  const StrongestSurface<Label, Value> before{load<Label>(cells.surface + i), load<Value>(cells.surface_energy + i),
                                              load<Value>(cells.elevation_moment + i)};
  const auto after = add_to_strongest(before, Label{} | echo.surface, energy, Value(energy * echo.elevation), weight);
  store(cells.surface + i, after.cell.surface);
  store(cells.surface_energy + i, after.cell.energy);
  store(cells.elevation_moment + i, after.cell.moment);
  return any(after.elsewhere);
}

}  // namespace

void deposit(const FlatPlan& plan, const Echo& echo, EchoGrid& grid) {
  const int beam = plan.beam_of(echo.azimuth);
  const float middle = (0.5F * echo.path_length - plan.first_bin_at) * plan.bins_per_metre;
  const auto bins = static_cast<float>(plan.bin_count);
  const float reach = echo.half_length * plan.bins_per_metre + least_half_length(middle);
  const float low = middle - reach, high = middle + reach;
  if (beam < 0 || !(high > 0) || !(low < bins)) {
    return;
  }
  const int first = low > 0 ? static_cast<int>(low) : 0;
  const int last = high < bins ? static_cast<int>(high) + 1 : plan.bin_count;
  const int count = last - first;
  const EchoGrid::Cells cells = grid.to_fill(echo.order, beam, {first, last});
  const auto start = static_cast<float>(first);
  const Spread spread{low - start, high - start, echo.weight / (high - low)};
  const auto weight_of = [&](int i) { return weight_in(static_cast<float>(i), spread); };
  const float from_middle = echo.elevation - plan.middle_elevation;
  const auto square_of = [&](float energy) { return energy * (from_middle * from_middle); };

  // Squares of elevations, before add() changes the strongest surfaces.
  for (int i = 0; i < count && cells.elevation_square != nullptr; ++i) {
    const bool none = cells.surface[i] == kNoSurface;
    if (weight_of(i) > 0 && (none || cells.surface[i] == echo.surface)) {
      cells.elevation_square[i] = (none ? 0.0F : cells.elevation_square[i]) + square_of(weight_of(i) * echo.power);
    }
  }

  // Four cells at a time, if the beam has as many left; the weight in cells from `last` on is zero.
  bool elsewhere = false;
  int i = 0;
  for (; i < count && first + i + kLanes <= plan.bin_count; i += kLanes) {
    elsewhere |=
        add<Labels>(echo, weight_in(static_cast<float>(i) + Floats{0, 1, 2, 3}, spread), grid.labelled(), cells, i);
  }
  for (; i < count; ++i) {
    elsewhere |= add<SurfaceLabel>(echo, weight_of(i), grid.labelled(), cells, i);
  }

  // Labels of the cells where another surface is the strongest so far.
  for (i = 0; i < count && elsewhere; ++i) {
    const float energy = weight_of(i) * echo.power;
    if (weight_of(i) > 0 && cells.surface[i] != echo.surface) {
      grid.add_further(beam, first + i, {echo.surface, energy, energy * echo.elevation, square_of(energy)});
    }
  }
}

}  // namespace insonify
