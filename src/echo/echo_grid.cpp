// echo_grid.cpp -- the cells of one ping.

#include "insonify/echo_grid.h"

#include <algorithm>

#include "echo/echo.h"

namespace insonify {

EchoGrid::EchoGrid(int beam_count, int bin_count, int order_count, GroundTruth ground_truth, bool labelled)
    : beam_count_(beam_count),
      bin_count_(bin_count),
      order_count_(order_count),
      ground_truth_(ground_truth),
      labelled_(labelled || ground_truth != GroundTruth::kNone),
      energy_(static_cast<std::size_t>(order_count) * beam_count * bin_count),
      weight_(energy_.size()) {
  const std::size_t cells = static_cast<std::size_t>(beam_count) * bin_count;
  if (labelled_) {
    surface_.resize(cells, kNoSurface);
    lead_.resize(cells);
    label_energy_.resize(cells);
    elevation_moment_.resize(cells);
  }
  if (ground_truth == GroundTruth::kFull) {
    tallies_.resize(cells);
    met_before_.resize(beam_count);
  }
}

EchoGrid::Label EchoGrid::label(int beam, int bin) const {
  if (!labelled_) {
    return {};
  }
  const std::size_t cell = start(1, beam) + bin;
  const float energy = surface_[cell] == kNoSurface ? 0.0F : label_energy_[cell];
  return {instance_of(surface_[cell]), material_of(surface_[cell]),
          energy > 0 ? elevation_moment_[cell] / energy : 0.0F};
}

void EchoGrid::take_cells(const EchoGrid& other, int beam, std::span<const std::int32_t> sources) {
  clear(beam, beam + 1);
  const auto take = [&](auto& layer, const auto& from, int order) {
    const std::size_t first = start(order, 0);
    for (std::size_t bin = 0; bin < sources.size(); ++bin) {
      if (sources[bin] >= 0) {
        layer[start(order, beam) + bin] = from[first + static_cast<std::size_t>(sources[bin])];
      }
    }
  };
  for (int order = 1; order <= order_count_; ++order) {
    take(energy_, other.energy_, order);
    take(weight_, other.weight_, order);
  }
  if (labelled_) {
    take(surface_, other.surface_, 1);
    take(lead_, other.lead_, 1);
    take(label_energy_, other.label_energy_, 1);
    take(elevation_moment_, other.elevation_moment_, 1);
  }
  if (ground_truth_ == GroundTruth::kFull) {
    take(tallies_, other.tallies_, 1);
    met_before_[beam] = other.met_before_[beam];
  }
}

void EchoGrid::clear(int first_beam, int last_beam) {
  const auto fill = [&](auto& layer, int order, auto value) {
    std::fill(layer.begin() + static_cast<std::ptrdiff_t>(start(order, first_beam)),
              layer.begin() + static_cast<std::ptrdiff_t>(start(order, last_beam)), value);
  };
  for (int order = 1; order <= order_count_; ++order) {
    fill(energy_, order, 0.0F);
    fill(weight_, order, 0.0F);
  }
  if (labelled_) {
    fill(surface_, 1, kNoSurface);  // Where nothing leads, the rest of the label means nothing.
  }
  if (ground_truth_ == GroundTruth::kFull) {
    fill(tallies_, 1, SurfaceTally{});
    std::fill(met_before_.begin() + first_beam, met_before_.begin() + last_beam, 0.0F);
  }
}

}  // namespace insonify
