// clutter.h -- K-distributed clutter: multiplies energies by a gamma-distributed texture of the surface.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/philox.h"
#include "echo/grid/echo_grid.h"
#include "insonify/material.h"
#include "insonify/sonar_config.h"
#include "receiver/speckle/scatterer_lattice.h"
#include "receiver/speckle/scatterer_row.h"
#include "receiver/speckle/texture_law.h"

namespace insonify {

/// Texture of materials with a `clutter_shape` nu: multiplies the mean energy of the echo by a gamma-distributed number
/// that varies over the surface, with mean 1 and variance 1 / nu. With speckle, whose intensities are exponentially
/// distributed, the product is K-distributed (Jakeman and Pusey, IEEE Trans. AP-24, 806 (1976)).
///
/// The texture is fixed in the world, or on a moving object. It changes smoothly over about a `clutter_length`, see
/// TextureLaw. A resolution cell much smaller than that has the shape nu; one of area A much larger has the shape
/// nu A / length^2 (Abraham and Lyons, IEEE J. Ocean. Eng. 27, 800 (2002)).
class Clutter {
 public:
  /// @param cells    The grids' cells.
  /// @param lattice  Used in the constructor only.
  Clutter(std::span<const Material> materials, const BearingGrid& cells, const ScattererLattice& lattice,
          std::uint64_t seed);

  /// Whether any material has texture.
  [[nodiscard]] bool any() const { return !laws_.empty(); }

  /// Multiplies the energies of one row of bins, `energy` [bin], by the texture. Cells that are wider or longer than
  /// half a length take the mean of several points, at most kMostPoints each way.
  void texture(ScattererRow& row, int cell, std::span<float> energy) const;

 private:
  static constexpr int kMostPoints = 16;
  class Patches;

  [[nodiscard]] bool has_law(const ScattererRow& row, int bin, std::size_t law) const;
  void add_texture(const ScattererRow::Run& run, BinRange bins, std::size_t law, int cell, ScattererRow& row,
                   std::span<float> energy) const;

  float first_range_, bin_length_, window_;  // True range of bin 0's middle, lengths of bin and window [m].
  std::vector<double> azimuth_;              // [cell]: azimuth of the centre [rad].
  std::vector<double> width_;                // [cell]: width in azimuth [rad].
  std::vector<int> table_;                   // [material]: index into laws_, -1 for a material without texture.
  std::vector<TextureLaw> laws_;
  PhiloxCounter key_;
};

}  // namespace insonify
