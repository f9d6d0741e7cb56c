// read_grid.cpp -- from fixed point to the layers of a grid.

#include "echo/gpu/read_grid.h"

#include <algorithm>
#include <span>
#include <vector>

namespace insonify {
namespace {

constexpr double kUnit = 1 / double{shader::kUnits};

float real(std::int64_t fixed) {
  return static_cast<float>(static_cast<double>(fixed) * kUnit);
}

// @param scale  Factor that undoes the scale of the bin.
SurfaceEcho echo_of(const shader::SurfaceSum& sum, double scale) {
  const auto scaled = [&](std::int64_t value) {
    return static_cast<float>(static_cast<double>(value) * kUnit * scale);
  };
  return {sum.key - 1, scaled(sum.energy), scaled(sum.moment), scaled(sum.square)};
}

// Bins of a beam that hold anything.
BinRange bins_in_use(const std::int64_t* weight, int bins, int orders, std::size_t next_order) {
  BinRange used = {bins, 0};
  for (int order = 0; order < orders; ++order) {
    for (int bin = 0; bin < bins; ++bin) {
      if (weight[order * next_order + bin] != 0) {
        used = {std::min(used.first, bin), std::max(used.last, bin + 1)};
      }
    }
  }
  return used;
}

// Fills a cell's label, and adds what further surfaces it has.
void fill_label(std::span<const shader::SurfaceSum> surfaces, double scale, int beam, int bin,
                const EchoGrid::Cells& cells, int at, EchoGrid& grid) {
  const SurfaceEcho one = echo_of(surfaces.front(), scale);
  cells.surface[at] = one.surface;
  cells.surface_energy[at] = one.energy;
  cells.elevation_moment[at] = one.elevation_moment;
  if (cells.elevation_square != nullptr) {
    cells.elevation_square[at] = one.elevation_square;
  }
  for (const shader::SurfaceSum& further : surfaces.subspan(1)) {
    grid.add_further(beam, bin, echo_of(further, scale));
  }
}

}  // namespace

std::span<const shader::SurfaceSum> surfaces_of_list(const shader::SurfaceSum* sums, std::uint32_t first,
                                                     std::vector<shader::SurfaceSum>& found) {
  if (sums[first - 1].next == 0) {
    return {&sums[first - 1], 1};
  }
  found.clear();
  for (std::uint32_t at = first; at != 0; at = sums[at - 1].next) {
    const shader::SurfaceSum& sum = sums[at - 1];
    const auto place = std::ranges::lower_bound(found, sum.key, {}, &shader::SurfaceSum::key);
    if (place == found.end() || place->key != sum.key) {
      found.insert(place, sum);
    } else {
      place->energy += sum.energy;
      place->moment += sum.moment;
      place->square += sum.square;
    }
  }
  return found;
}

void read_beams(const PingMemory& memory, std::span<const float> bin_scale, int first_beam, int last_beam,
                std::vector<shader::SurfaceSum>& scratch, EchoGrid& grid) {
  const int bins = grid.bin_count();
  const std::size_t cells = static_cast<std::size_t>(grid.beam_count()) * bins;
  grid.clear(first_beam, last_beam);
  for (int beam = first_beam; beam < last_beam; ++beam) {
    const std::size_t start = static_cast<std::size_t>(beam) * bins;
    grid.met_before(beam) = real(memory.met_before()[beam]);
    const BinRange used = bins_in_use(memory.weight() + start, bins, grid.order_count(), cells);
    if (used.empty()) {
      continue;
    }
    for (int order = 1; order <= grid.order_count(); ++order) {
      const EchoGrid::Cells to = grid.to_fill(order, beam, used);
      const std::size_t from = (order - 1) * cells + start + used.first;
      for (int i = 0; i < used.last - used.first; ++i) {
        const double scale = 1 / double{bin_scale[used.first + i]};
        to.energy[i] = static_cast<float>(static_cast<double>(memory.energy()[from + i]) * kUnit * scale);
        to.weight[i] = real(memory.weight()[from + i]);
        const std::uint32_t surface =
            grid.labelled() && order == 1 ? memory.first_surface()[start + used.first + i] : 0;
        if (surface != 0) {
          fill_label(surfaces_of_list(memory.surfaces(), surface, scratch), scale, beam, used.first + i, to, i, grid);
        }
      }
    }
  }
}

}  // namespace insonify
