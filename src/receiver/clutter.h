// clutter.h -- surfaces whose echoes come in patches: K-distributed clutter.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/material.h"
#include "receiver/speckle.h"

namespace insonify {

/// Quantiles of the gamma distribution of mean 1 and shape nu.
class GammaQuantiles {
 public:
  /// @param shape  nu, > 0.
  explicit GammaQuantiles(double shape);

  /// The value that a share u of all stays below, from v = log(u / (1 - u)).
  [[nodiscard]] float at(float v) const;

 private:
  std::vector<float> values_;  // Evenly spaced in v.
};

/// Gives materials with a `clutter_shape` nu their texture: the mean energy of each patch is drawn from a gamma
/// distribution of mean 1 and variance 1 / nu, and stays where it is in the world. With speckle on top intensities are
/// K-distributed (Jakeman and Pusey, IEEE Trans. AP-24, 806 (1976); Abraham and Lyons, IEEE J. Ocean. Eng. 27, 800
/// (2002)). Patches are as large as what the sonar resolves.
class Clutter {
 public:
  /// @param cells, bins  Of a patch.
  Clutter(std::span<const Material> materials, int cells, int bins);

  /// Whether any material has texture.
  [[nodiscard]] bool any() const { return !quantiles_.empty(); }

  /// Multiplies the energies of a row of cells.
  void texture(const Speckle::View& view, const Speckle::Row& row, std::span<float> energy) const;

 private:
  std::uint32_t cells_, bins_;
  std::vector<int> table_;  // Of each material; -1 for none.
  std::vector<GammaQuantiles> quantiles_;
};

}  // namespace insonify
