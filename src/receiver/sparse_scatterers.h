// sparse_scatterers.h -- surfaces whose cells hold so few scatterers that each of them counts.

#pragma once

#include <complex>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/material.h"
#include "insonify/sonar_config.h"
#include "receiver/speckle.h"

namespace insonify {

/// Draws the echoes of materials with a `scatterer_density` as what they are: in a cell that holds N on average, a
/// number of them after Poisson, each with the amplitude sqrt(energy / N) and a phase of its own. Energies keep their
/// means, and <I^2> = (2 + 1/N) <I>^2: cells with none are silent, those with one stand out (Jakeman and Pusey, IEEE
/// Trans. AP-24, 806 (1976)). They stay in the world as the speckle of many does, which cells have that hold kMany or
/// more.
///
/// A cell that is w wide, dr long and sees a surface in the solid angle W holds the area sqrt((w dr)^2 + (r^2 W)^2):
/// its shares across and along the range. So a cell that the surface does not fill counts too many.
class SparseScatterers {
 public:
  static constexpr double kMany = 32;  ///< <I^2> is 1.5 % above that of countless.

  /// @param cells        What grids are of.
  /// @param true_ranges  True over reported range.
  SparseScatterers(std::span<const Material> materials, const SonarConfig& cells, double true_ranges);

  /// Whether any material has them.
  [[nodiscard]] bool any() const { return any_; }

  /// Draws the cells of a row anew that hold few.
  /// @param energy  Of each.
  /// @param field   Of each, from Speckle::draw().
  void draw(const Speckle::View& view, const Speckle::Row& row, const EchoGrid& grid, int cell,
            std::span<const float> energy, std::span<std::complex<float>> field) const;

 private:
  [[nodiscard]] double area(const EchoGrid& grid, int cell, int bin) const;

  bool any_ = false;
  double first_range_, bin_length_;  // True [m].
  std::vector<double> width_;        // Of each cell [rad].
  std::vector<double> density_;      // Of each material [1/m^2]; infinite for countless.
};

}  // namespace insonify
