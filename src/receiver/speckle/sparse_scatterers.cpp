// sparse_scatterers.cpp -- draws the number of scatterers in each cell and sums their echoes.

#include "receiver/speckle/sparse_scatterers.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/philox.h"
#include "echo/grid/echo.h"
#include "echo/laws/laws.h"

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

// Two random words of a lattice step, from the stream at index `number`.
ScattererWords words_of(const ScattererRow& row, const ScattererRow::Run& run, int bin, int step, int number) {
  const std::uint32_t purpose = static_cast<std::uint32_t>(RandomPurpose::kScatterers) << 24;
  const PhiloxPair words =
      philox({row.index[bin] + static_cast<std::uint32_t>(step), patch_hash(row.patch[bin], run.key)},
             run.key.b ^ (purpose + static_cast<std::uint32_t>(number)));
  return {words[0], words[1]};
}

}  // namespace

SparseScatterers::SparseScatterers(std::span<const Material> materials, const BearingGrid& cells,
                                   const ScattererLattice& lattice)
    : first_range_(lattice.first_range()), bin_length_(lattice.bin_length()), window_(lattice.window()) {
  for (int cell = 0; cell < cells.count(); ++cell) {
    width_.push_back(cells.width(cell));
  }
  for (const Material& material : materials) {
    density_.push_back(material.scatterer_density.value_or(std::numeric_limits<double>::infinity()));
    any_ = any_ || material.scatterer_density;
  }
}

// Area of the labelled surface inside a cell's window [m^2], see the class comment; at the label's elevation.
double SparseScatterers::area(const EchoGrid& grid, int cell, int bin) const {
  const double range = first_range_ + bin * bin_length_;
  const double wide = range * std::cos(double{grid.label(cell, bin).elevation}) * width_[cell];
  const double facing = range * range * double{grid.weight(1, cell)[bin]} * window_ / bin_length_;
  return std::hypot(wide * window_, facing);
}

void SparseScatterers::draw(ScattererRow& row, const EchoGrid& grid, int cell, std::span<const float> energy,
                            const Speckle& speckle, std::span<std::complex<float>> field) const {
  for (const ScattererRow::Run& run : row.runs) {
    for (int bin = run.bins.first; bin < run.bins.last; ++bin) {
      const double density = row.surface[bin] == kNoSurface ? std::numeric_limits<double>::infinity()
                                                            : density_[material_of(row.surface[bin])];
      if (energy[bin] == 0 || std::isinf(density)) {
        continue;
      }
      const double mean = density * area(grid, cell, bin);
      if (!(mean < kMany)) {
        continue;
      }
      const float length = row.length[bin], extent = std::abs(length), begin = row.begin[bin];
      const float near = speckle.turns_before(bin);
      const float amplitude = std::sqrt(energy[bin] / static_cast<float>(mean));
      field[bin] = row.before[bin] = row.after[bin] = 0;
      for (int step = begin < 0 ? -1 : 0; static_cast<float>(step) < begin + extent; ++step) {
        // Scatterers of equal amplitude: the phase of each is random plus that of the path.
        const int count = poisson(mean / double{extent}, double{uniform_open(words_of(row, run, bin, step, 0).phase)});
        for (int i = 0; i < count; ++i) {
          const ScattererWords words = words_of(row, run, bin, step, 1 + i);
          const float in_step = (static_cast<float>(words.amplitude >> 9) + 0.5F) * (1.0F / 8388608.0F);
          const float along = (static_cast<float>(step) + in_step - begin) / extent;
          const float place = length < 0 ? 1 - along : along;
          if (place >= 0 && place < 1) {
            const float turns = uniform_open(words.phase) + near + place * speckle.turns_across() +
                                place_across(words) * run.across_turns;
            const float phase = 2 * std::numbers::pi_v<float> * (turns - std::floor(turns));
            speckle.add(std::polar(amplitude, phase), place, bin, row, field);
          }
        }
      }
    }
  }
}

}  // namespace insonify
