// clutter.h -- K-distributed clutter: multiplies the mean energy of patches by gamma-distributed texture.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/gamma_quantiles.h"
#include "echo/grid/echo_grid.h"
#include "insonify/material.h"
#include "receiver/speckle/scatterer_row.h"

namespace insonify {

/// Texture of materials with a `clutter_shape` nu: the mean energy of each patch of cells is multiplied by a
/// gamma-distributed number of mean 1 and variance 1 / nu, fixed in the world. With speckle, which multiplies it by an
/// exponentially distributed one, intensities are K-distributed (Jakeman and Pusey, IEEE Trans. AP-24, 806 (1976);
/// Abraham and Lyons, IEEE J. Ocean. Eng. 27, 800 (2002)). A patch is one bearing cell of the sonar, as long as its
/// pulse.
class Clutter {
 public:
  /// @param bins  Length of a patch in range bins, >= 1.
  Clutter(std::span<const Material> materials, int bins);

  /// Whether any material has texture.
  [[nodiscard]] bool any() const { return !quantiles_.empty(); }

  /// Multiplies the energies of one row of bins, `energy` [bin], by the texture of the patch that each bin lies in.
  void texture(const ScattererRow& row, std::span<float> energy) const;

 private:
  std::uint32_t bins_;
  std::vector<int> table_;  // [material]: index into quantiles_, -1 for a material without texture.
  std::vector<GammaQuantiles> quantiles_;
};

}  // namespace insonify
