// scatterer_lattice.h -- where the bins of a ping meet the scatterers that are fixed on surfaces.

#pragma once

#include <cstdint>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/sonar_config.h"
#include "receiver/speckle/scatterer_row.h"
#include "receiver/speckle/speckle_view.h"

namespace insonify {

/// Scatterers have a number along the surface: in the vertical plane of a bearing, the world (or the moving object) is
/// divided into steps of kStepsPerWindow to a bin, along the level or the vertical axis, whichever the surface follows
/// more closely. The window of a bin reaches from where its near edge meets the surface to where its far edge does, so
/// that windows of neighbouring bins share no part of the lattice and a sonar that moves ahead, turns or rises meets
/// the same scatterers again, at their new ranges.
///
/// Bearings are counted in cells from a fixed direction, not in metres across: sideways, the speckle of an array
/// decorrelates within half its length (docs/concepts/speckle.md), much less than a cell's width except very near the
/// sonar. Each bearing draws its scatterers anew every kStripWidth sideways, at places of its own. Surfaces that lie
/// kLayer or more apart across the lattice have scatterers of their own.
class ScattererLattice {
 public:
  static constexpr double kStepsPerWindow = 2;  ///< Where the surface lies along the ray.
  static constexpr double kStripWidth = 2;      ///< [m]
  static constexpr double kLayer = 1;           ///< [m]

  /// @param cells        The grids' cells, see BearingCells::sonar.
  /// @param range_scale  True range / reported range.
  /// @param wavelength   [m]
  /// @param window       True length of the range window that a bin hears [m].
  ScattererLattice(const SonarConfig& cells, double range_scale, double wavelength, double window, std::uint64_t seed);

  /// Finds the scatterers of the given bins of a cell: those of an object's echoes on the object, all others in the
  /// world. `views` must outlive the row's use.
  void locate(const SpeckleViews& views, int cell, BinRange bins, const EchoGrid& grid, ScattererRow& row) const;

  [[nodiscard]] double first_range() const { return first_range_; }
  [[nodiscard]] double bin_length() const { return bin_length_; }
  [[nodiscard]] double window() const { return window_; }
  [[nodiscard]] double turns_per_metre() const { return turns_per_metre_; }

 private:
  struct Axes;
  void divide(const SpeckleViews& views, ScattererRow& row) const;
  [[nodiscard]] Axes axes_of(int cell, ScattererRow::Run& run) const;
  [[nodiscard]] int surface_end(int first, int last, BinRange filled, const ScattererRow& row) const;
  void locate_surface(const Axes& axes, BinRange bins, bool level, ScattererRow& row) const;
  void rescale(const Axes& axes, int bin, ScattererRow& row) const;

  int bins_;
  double first_range_, bin_length_;  // True range of bin 0's middle, and true bin length [m].
  double window_, step_;             // [m]
  double cell_width_;                // Width of the narrowest cell [rad].
  double turns_per_metre_;           // Phase per metre of range, out and back [turns/m].
  int smoothed_bins_;                // Half-width of the mean over elevations.
  std::vector<double> azimuth_;      // [cell]: azimuth of the centre [rad].
  std::uint64_t seed_;
};

}  // namespace insonify
