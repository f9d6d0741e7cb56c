// read_grid.cpp -- copies the layers of a grid.

#include "echo/gpu/read_grid.h"

#include <algorithm>
#include <span>

namespace insonify {
namespace {

// Copies some bins of one beam of one layer; nothing where the grid does not have it.
template <typename Value>
void copy_bins(const PingMemory& memory, std::uint64_t shader::GridLayers::*layer, std::size_t first, int count,
               Value* to) {
  if (to != nullptr) {
    std::copy_n(memory.on_host<Value>(layer) + first, count, to);
  }
}

}  // namespace

void read_beams(const PingMemory& memory, int first_beam, int last_beam, EchoGrid& grid) {
  const int bins = grid.bin_count();
  const std::size_t cells = static_cast<std::size_t>(grid.beam_count()) * bins;
  const auto* const used = memory.on_host<std::uint32_t>(&shader::GridLayers::used);
  const auto* const met_before = memory.on_host<float>(&shader::GridLayers::met_before);
  grid.clear(first_beam, last_beam);
  for (int beam = first_beam; beam < last_beam; ++beam) {
    grid.met_before(beam) = met_before[beam];
    const std::uint32_t* const ends = &used[2 * static_cast<std::size_t>(beam)];
    const int last = static_cast<int>(ends[1]), first = bins - static_cast<int>(ends[0]);
    if (last == 0) {
      continue;
    }
    const std::size_t start = static_cast<std::size_t>(beam) * bins + first;
    for (int order = 1; order <= grid.order_count(); ++order) {
      const EchoGrid::Cells to = grid.to_fill(order, beam, {first, last});
      const std::size_t of_order = (order - 1) * cells + start;
      copy_bins(memory, &shader::GridLayers::energy, of_order, last - first, to.energy);
      copy_bins(memory, &shader::GridLayers::weight, of_order, last - first, to.weight);
      if (order == 1) {
        copy_bins(memory, &shader::GridLayers::surface, start, last - first, to.surface);
        copy_bins(memory, &shader::GridLayers::surface_energy, start, last - first, to.surface_energy);
        copy_bins(memory, &shader::GridLayers::moment, start, last - first, to.elevation_moment);
        copy_bins(memory, &shader::GridLayers::square, start, last - first, to.elevation_square);
      }
    }
  }
}

void read_further_surfaces(const PingMemory& memory, EchoGrid& grid) {
  const auto bins = static_cast<std::uint32_t>(grid.bin_count());
  for (const shader::FurtherSum& sum : std::span(memory.further(), memory.counters().further)) {
    grid.add_further(static_cast<int>(sum.cell / bins), static_cast<int>(sum.cell % bins),
                     {sum.surface, sum.energy, sum.moment, sum.square});
  }
}

}  // namespace insonify
