// sparse_scatterers.cpp -- draws the number of scatterers in each cell and sums their echoes.

#include "receiver/speckle/sparse_scatterers.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/philox.h"
#include "echo/grid/echo.h"

namespace insonify {
namespace {

// Quantile of the Poisson distribution of this mean: the least count whose cumulative probability reaches `share`.
int poisson(double mean, double share) {
  double probability = std::exp(-mean), sum = probability;
  int count = 0;
  while (share > sum && count < 8 * SparseScatterers::kMany) {
    ++count;
    probability *= mean / count;
    sum += probability;
  }
  return count;
}

// Two random words of a cell, from the stream at index `number`.
PhiloxPair words_of(const Speckle::View& view, const Speckle::Row& row, int bin, int number) {
  const std::uint32_t purpose = static_cast<std::uint32_t>(RandomPurpose::kScatterers) << 24;
  return philox({row.range[bin], row.bearing}, view.key ^ (purpose + static_cast<std::uint32_t>(number)));
}

}  // namespace

SparseScatterers::SparseScatterers(std::span<const Material> materials, const SonarConfig& cells, double range_scale)
    : first_range_(range_scale * cells.bin_range(0)), bin_length_(range_scale * cells.bin_length()) {
  const std::vector<double> edges = cells.beam_edges();
  for (int cell = 0; cell < cells.beam_count; ++cell) {
    width_.push_back(edges[cell] - edges[cell + 1]);
  }
  for (const Material& material : materials) {
    density_.push_back(material.scatterer_density.value_or(std::numeric_limits<double>::infinity()));
    any_ = any_ || material.scatterer_density;
  }
}

// Area of the labelled surface inside a cell [m^2], see the class comment; at the label's elevation.
double SparseScatterers::area(const EchoGrid& grid, int cell, int bin) const {
  const double range = first_range_ + bin * bin_length_;
  const double wide = range * std::cos(double{grid.label(cell, bin).elevation}) * width_[cell];
  return std::hypot(wide * bin_length_, range * range * double{grid.weight(1, cell)[bin]});
}

void SparseScatterers::draw(const Speckle::View& view, const Speckle::Row& row, const EchoGrid& grid, int cell,
                            std::span<const float> energy, float turns_per_bin,
                            std::span<std::complex<float>> field) const {
  for (int bin = row.bins.first; bin < row.bins.last; ++bin) {
    const double density = row.surface[bin] == kNoSurface ? std::numeric_limits<double>::infinity()
                                                          : density_[material_of(row.surface[bin])];
    if (energy[bin] == 0 || std::isinf(density)) {
      continue;
    }
    const double mean = density * area(grid, cell, bin);
    if (!(mean < kMany)) {
      continue;
    }
    // Field of `count` scatterers of equal amplitude: the phase of each is random plus that of the path, to its place
    // in the cell, which is drawn from the bits that uniform_open() leaves.
    const int count = poisson(mean, double{uniform_open(words_of(view, row, bin, 0)[0])});
    std::complex<float> sum;
    PhiloxPair words{};
    for (int i = 0; i < count; ++i) {
      words = i % 2 == 0 ? words_of(view, row, bin, 1 + i / 2) : words;
      const float beyond = (static_cast<float>(words[i % 2] & 511U) + 0.5F) / 512 - 0.5F;
      const float turns = uniform_open(words[i % 2]) + row.turns[bin] + turns_per_bin * beyond;
      sum += std::polar(1.0F, 2 * std::numbers::pi_v<float> * turns);
    }
    field[bin] = std::sqrt(energy[bin] / static_cast<float>(mean)) * sum;
  }
}

}  // namespace insonify
