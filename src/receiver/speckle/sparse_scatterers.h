// sparse_scatterers.h -- non-Gaussian speckle of surfaces with only a few scatterers in each resolution cell.

#pragma once

#include <complex>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/material.h"
#include "insonify/sonar_config.h"
#include "receiver/speckle/scatterer_row.h"
#include "receiver/speckle/speckle.h"

namespace insonify {

/// Speckle of materials with a `scatterer_density`. In a cell with N scatterers on average, their number is
/// Poisson-distributed, and each has the amplitude sqrt(energy / N) and a random phase. The mean intensity is unchanged
/// and <I^2> = (2 + 1/N) <I>^2: many cells are empty, and some are much stronger (Jakeman and Pusey, IEEE Trans. AP-24,
/// 806 (1976)). Scatterers are fixed in the lattice that Speckle uses: each step has a Poisson-distributed number of
/// them at random positions, and a bin sums those in its window. Cells with N >= kMany have Gaussian speckle.
///
/// N is the density times the area of the surface in a bin's window. At range r, for a cell of width w and length dr,
/// in which the surface has the solid angle W, the area is sqrt((w dr)^2 + (r^2 W)^2): w dr is exact at grazing
/// incidence, r^2 W at normal incidence. If the surface fills only part of the cell, N is too large.
class SparseScatterers {
 public:
  static constexpr double kMany = 32;  ///< From this N on, speckle is Gaussian; <I^2> would be 1.5 % larger.

  /// @param cells    The grids' cells.
  /// @param lattice  Used in the constructor only.
  SparseScatterers(std::span<const Material> materials, const BearingGrid& cells, const ScattererLattice& lattice);

  /// Whether any material has a `scatterer_density`.
  [[nodiscard]] bool any() const { return any_; }

  /// Replaces Gaussian speckle by discrete scatterers in the cells of a row with fewer than kMany.
  /// @param energy  Mean energy, [bin].
  /// @param field   Complex field, [bin], from Speckle::draw(); it and the row's are overwritten where scatterers are
  /// sparse.
  void draw(ScattererRow& row, const EchoGrid& grid, int cell, std::span<const float> energy, const Speckle& speckle,
            std::span<std::complex<float>> field) const;

 private:
  [[nodiscard]] double area(const EchoGrid& grid, int cell, int bin) const;

  bool any_ = false;
  double first_range_, bin_length_, window_;  // True range of bin 0's middle, lengths of bin and window [m].
  std::vector<double> width_;                 // [cell]: width in azimuth [rad].
  std::vector<double> density_;  // [material]: scatterers per area [1/m^2]; infinite without scatterer_density.
};

}  // namespace insonify
