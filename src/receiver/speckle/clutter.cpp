// clutter.cpp -- draws one gamma-distributed number for each patch of cells.

#include "receiver/speckle/clutter.h"

#include "base/philox.h"
#include "base/vector_math.h"
#include "echo/grid/echo.h"

namespace insonify {

Clutter::Clutter(std::span<const Material> materials, int bins) : bins_(static_cast<std::uint32_t>(bins)) {
  for (const Material& material : materials) {
    table_.push_back(material.clutter_shape ? static_cast<int>(quantiles_.size()) : -1);
    if (material.clutter_shape) {
      quantiles_.emplace_back(*material.clutter_shape);
    }
  }
}

void Clutter::texture(const ScattererRow& row, std::span<float> energy) const {
  for (const ScattererRow::Run& run : row.runs) {
    const std::uint32_t key = run.key[0] ^ static_cast<std::uint32_t>(RandomPurpose::kClutter) << 24;
    for (int bin = run.bins.first; bin < run.bins.last; ++bin) {
      const SurfaceLabel surface = row.surface[bin];
      const int table = surface == kNoSurface ? -1 : table_[material_of(surface)];
      if (table >= 0) {
        const PhiloxPair words = philox({row.index[bin] / (2 * bins_), row.patch[bin]}, key);
        const float share = uniform_open(words[0]);
        energy[bin] *= quantiles_[table].at(fast_log(share) - fast_log(1 - share));
      }
    }
  }
}

}  // namespace insonify
