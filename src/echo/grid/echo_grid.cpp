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

// Copies neighbouring bins of one beam.
void EchoGrid::take_run(const EchoGrid& other, std::size_t from, int beam, BinRange bins) {
  const auto count = static_cast<std::size_t>(bins.last - bins.first);
  (void)to_fill(1, beam, bins);
  const std::size_t to = start(1, beam) + bins.first;
  const auto copy = [&](const auto& source, auto& target) { std::copy_n(&source[from], count, &target[to]); };
  for (int order = 1; order <= order_count_; ++order) {
    const std::size_t first = start(order, 0);
    std::copy_n(&other.energy_[first + from], count, &energy_[first + to]);
    std::copy_n(&other.weight_[first + from], count, &weight_[first + to]);
  }
  if (!labelled_) {
    return;
  }
  copy(other.surface_, surface_);
  copy(other.label_energy_, label_energy_);
  copy(other.elevation_moment_, elevation_moment_);
  if (!elevation_square_.empty()) {
    copy(other.elevation_square_, elevation_square_);
  }
  std::fill_n(&further_[to], count, 0U);
  const std::vector<FurtherSurface>& surfaces = other.further_surfaces_[from / length()];
  for (std::size_t i = 0; i < count && !surfaces.empty(); ++i) {
    const bool echoed = other.surface_[from + i] != kNoSurface;
    for (std::uint32_t next = echoed ? other.further_[from + i] : 0; next != 0; next = surfaces[next - 1].next) {
      further_surfaces_[beam].push_back({surfaces[next - 1].echo, further_[to + i]});
      further_[to + i] = static_cast<std::uint32_t>(further_surfaces_[beam].size());
    }
  }
}

void EchoGrid::take_cells(const EchoGrid& other, int beam, std::span<const std::int32_t> sources) {
  clear(beam, beam + 1);
  const int bins = static_cast<int>(sources.size());
  for (int first = 0, last = 0; first < bins; first = last) {
    const std::int32_t source = sources[first];
    const int source_beam = source / bin_count_, source_bin = source % bin_count_;
    last = first + 1;
    while (source >= 0 && last < bins && sources[last] == source + (last - first) &&
           source_bin + (last - first) < bin_count_) {
      ++last;
    }
    if (source < 0) {
      continue;
    }
    // Those of the run that the other grid has filled.
    const BinRange filled = other.filled(source_beam);
    const int skipped = std::max(filled.first - source_bin, 0);
    const BinRange run{first + skipped, std::min(last, first + filled.last - source_bin)};
    if (run.first < run.last) {
      take_run(other, other.start(1, source_beam) + source_bin + skipped, beam, run);
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
