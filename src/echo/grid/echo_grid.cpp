// echo_grid.cpp -- clears cells, adds echoes of further surfaces to them, and copies them.

#include "echo/grid/echo_grid.h"

#include <algorithm>
#include <bit>

#include "base/lane_bits.h"
#include "echo/grid/surface_run.h"

namespace insonify {

EchoGrid::EchoGrid(int beam_count, int bin_count, int order_count, GroundTruth ground_truth, bool labelled)
    : beam_count_(beam_count),
      bin_count_(bin_count),
      order_count_(order_count),
      ground_truth_(ground_truth),
      labelled_(labelled || ground_truth != GroundTruth::kNone),
      energy_(static_cast<std::size_t>(order_count) * beam_count * bin_count),
      weight_(energy_.size()),
      met_before_(beam_count),
      filled_(beam_count) {
  const std::size_t cells = static_cast<std::size_t>(beam_count) * bin_count;
  if (labelled_) {
    surface_ = Layer<std::uint32_t>(cells);
    label_energy_ = Layer<float>(cells);
    elevation_moment_ = Layer<float>(cells);
    further_ = Layer<std::uint32_t>(cells);
    further_surfaces_.resize(beam_count);
    for (std::vector<FurtherSurface>& surfaces : further_surfaces_) {
      surfaces.reserve(static_cast<std::size_t>(bin_count));
    }
  }
  if (ground_truth == GroundTruth::kFull) {
    elevation_square_ = Layer<float>(cells);
  }
}

// Marks cells as having no surface; the other label layers are set by the first echo.
void EchoGrid::set_up(int beam, BinRange bins) {
  if (!labelled_ || bins.empty()) {
    return;
  }
  std::fill_n(&surface_[start(1, beam) + bins.first], bins.last - bins.first, kNoSurface);
  std::fill_n(&further_[start(1, beam) + bins.first], bins.last - bins.first, 0U);
}

void EchoGrid::fill_more(int beam, BinRange bins) {
  const BinRange before = filled_[beam], now = before | bins;
  if (before.empty()) {
    set_up(beam, now);
  } else {
    set_up(beam, {now.first, before.first});
    set_up(beam, {before.last, now.last});
  }
  filled_[beam] = now;
}

EchoGrid::Label EchoGrid::label(int beam, int bin) const {
  if (!labelled_ || !filled_[beam].has(bin)) {
    return {};
  }
  const std::size_t cell = start(1, beam) + bin;
  const float energy = surface_[cell] == kNoSurface ? 0.0F : label_energy_[cell];
  return {instance_of(surface_[cell]), material_of(surface_[cell]),
          energy > 0 ? elevation_moment_[cell] / energy : 0.0F};
}

void EchoGrid::set_strongest(std::size_t cell, const SurfaceEcho& echo) {
  surface_[cell] = echo.surface;
  label_energy_[cell] = echo.energy;
  elevation_moment_[cell] = echo.elevation_moment;
  if (!elevation_square_.empty()) {
    elevation_square_[cell] = echo.elevation_square;
  }
}

// Finds the surface in the cell's list, or appends it, adds the echo, and swaps it with the strongest surface if it has
// become the stronger of the two.
inline void EchoGrid::add_surface(int beam, std::size_t cell, const SurfaceEcho& echo) {
  std::vector<FurtherSurface>& surfaces = further_surfaces_[beam];
  std::uint32_t place = further_[cell];
  while (place != 0 && surfaces[place - 1].echo.surface != echo.surface) {
    place = surfaces[place - 1].next;
  }
  if (place == 0) {
    surfaces.push_back({{echo.surface, 0, 0, 0}, further_[cell]});
    place = further_[cell] = static_cast<std::uint32_t>(surfaces.size());
  }
  SurfaceEcho& sum = surfaces[place - 1].echo;
  sum.energy += echo.energy;
  sum.elevation_moment += echo.elevation_moment;
  sum.elevation_square += echo.elevation_square;
  if (sum.energy > label_energy_[cell] || (sum.energy == label_energy_[cell] && sum.surface < surface_[cell])) {
    const SurfaceEcho before = strongest(cell);
    set_strongest(cell, sum);
    sum = before;
  }
}

void EchoGrid::add_further(int beam, int bin, const SurfaceEcho& echo) {
  add_surface(beam, start(1, beam) + bin, echo);
}

void EchoGrid::add_further(int beam, BinRange bins, SurfaceLabel surface, SurfaceSums& sums) {
  const std::size_t cell = start(1, beam);
  for (int block = bins.first; block < bins.last; block += kLanes) {
    for (unsigned lanes = positive_of_four(&sums.weight[block]); lanes != 0; lanes &= lanes - 1) {
      const int bin = block + std::countr_zero(lanes);
      add_surface(beam, cell + bin, {surface, sums.energy[bin], sums.moment[bin], sums.square[bin]});
      sums.energy[bin] = sums.weight[bin] = sums.moment[bin] = sums.square[bin] = 0;
    }
  }
}

void EchoGrid::keep_spare_surfaces() {
  constexpr std::size_t kLeast = 64;
  for (std::vector<FurtherSurface>& surfaces : further_surfaces_) {
    if (const std::size_t needed = surfaces.size() + surfaces.size() / 2 + kLeast; surfaces.capacity() < needed) {
      surfaces.reserve(2 * needed);
    }
  }
}

void EchoGrid::take_cell(const EchoGrid& other, std::size_t from, int beam, int bin) {
  const std::size_t to = start(1, beam) + bin;
  for (int order = 1; order <= order_count_; ++order) {
    const std::size_t first = start(order, 0);
    energy_[first + to] = other.energy_[first + from];
    weight_[first + to] = other.weight_[first + from];
  }
  if (labelled_) {
    set_strongest(to, other.strongest(from));
    further_[to] = 0;
    const std::vector<FurtherSurface>& surfaces = other.further_surfaces_[from / length()];
    const bool echoed = other.surface_[from] != kNoSurface;
    for (std::uint32_t next = echoed ? other.further_[from] : 0; next != 0; next = surfaces[next - 1].next) {
      further_surfaces_[beam].push_back({surfaces[next - 1].echo, further_[to]});
      further_[to] = static_cast<std::uint32_t>(further_surfaces_[beam].size());
    }
  }
}

void EchoGrid::take_cells(const EchoGrid& other, int beam, std::span<const std::int32_t> sources) {
  clear(beam, beam + 1);
  for (int bin = 0; bin < static_cast<int>(sources.size()); ++bin) {
    if (sources[bin] >= 0 && other.filled(sources[bin] / bin_count_).has(sources[bin] % bin_count_)) {
      (void)to_fill(1, beam, {bin, bin + 1});
      take_cell(other, static_cast<std::size_t>(sources[bin]), beam, bin);
    }
  }
  met_before_[beam] = other.met_before_[beam];
}

void EchoGrid::clear(int first_beam, int last_beam) {
  for (int beam = first_beam; beam < last_beam; ++beam) {
    const BinRange bins = filled_[beam];
    for (int order = 1; order <= order_count_ && !bins.empty(); ++order) {
      std::fill_n(&energy_[start(order, beam) + bins.first], bins.last - bins.first, 0.0F);
      std::fill_n(&weight_[start(order, beam) + bins.first], bins.last - bins.first, 0.0F);
    }
    filled_[beam] = {};
    met_before_[beam] = 0;
    if (labelled_) {
      further_surfaces_[beam].clear();
    }
  }
}

}  // namespace insonify
