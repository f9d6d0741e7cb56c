// echo_grid.cpp -- the cells of one ping.

#include "insonify/echo_grid.h"

#include <algorithm>

#include "echo/grid/echo.h"

namespace insonify {

EchoGrid::EchoGrid(int beam_count, int bin_count, int order_count, GroundTruth ground_truth, bool labelled)
    : beam_count_(beam_count),
      bin_count_(bin_count),
      order_count_(order_count),
      ground_truth_(ground_truth),
      labelled_(labelled || ground_truth != GroundTruth::kNone),
      energy_(static_cast<std::size_t>(order_count) * beam_count * bin_count),
      weight_(energy_.size()),
      filled_(beam_count) {
  const std::size_t cells = static_cast<std::size_t>(beam_count) * bin_count;
  if (labelled_) {
    surface_ = Layer<std::uint32_t>(cells);
    lead_ = Layer<float>(cells);
    label_energy_ = Layer<float>(cells);
    elevation_moment_ = Layer<float>(cells);
  }
  if (ground_truth == GroundTruth::kFull) {
    tallies_ = Layer<SurfaceTally>(cells);
    met_before_.resize(beam_count);
  }
}

// Where nothing leads, the rest of the label and the tally mean nothing.
void EchoGrid::set_up(int beam, BinRange bins) {
  if (!labelled_ || bins.empty()) {
    return;
  }
  std::fill_n(&surface_[start(1, beam) + bins.first], bins.last - bins.first, kNoSurface);
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

void EchoGrid::take_cell(const EchoGrid& other, std::size_t from, std::size_t to) {
  for (int order = 1; order <= order_count_; ++order) {
    const std::size_t first = start(order, 0);
    energy_[first + to] = other.energy_[first + from];
    weight_[first + to] = other.weight_[first + from];
  }
  if (labelled_) {
    surface_[to] = other.surface_[from];
    lead_[to] = other.lead_[from];
    label_energy_[to] = other.label_energy_[from];
    elevation_moment_[to] = other.elevation_moment_[from];
  }
  if (ground_truth_ == GroundTruth::kFull) {
    tallies_[to] = other.tallies_[from];
  }
}

void EchoGrid::take_cells(const EchoGrid& other, int beam, std::span<const std::int32_t> sources) {
  clear(beam, beam + 1);
  for (int bin = 0; bin < static_cast<int>(sources.size()); ++bin) {
    if (sources[bin] >= 0 && other.filled(sources[bin] / bin_count_).has(sources[bin] % bin_count_)) {
      (void)to_fill(1, beam, {bin, bin + 1});
      take_cell(other, static_cast<std::size_t>(sources[bin]), start(1, beam) + bin);
    }
  }
  if (ground_truth_ == GroundTruth::kFull) {
    met_before_[beam] = other.met_before_[beam];
  }
}

void EchoGrid::clear(int first_beam, int last_beam) {
  for (int beam = first_beam; beam < last_beam; ++beam) {
    const BinRange bins = filled_[beam];
    for (int order = 1; order <= order_count_ && !bins.empty(); ++order) {
      std::fill_n(&energy_[start(order, beam) + bins.first], bins.last - bins.first, 0.0F);
      std::fill_n(&weight_[start(order, beam) + bins.first], bins.last - bins.first, 0.0F);
    }
    filled_[beam] = {};
  }
  if (ground_truth_ == GroundTruth::kFull) {
    std::fill(met_before_.begin() + first_beam, met_before_.begin() + last_beam, 0.0F);
  }
}

}  // namespace insonify
