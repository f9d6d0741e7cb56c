// scatterer_lattice.h -- finds the scatterers, fixed on surfaces, that each range bin contains.

#pragma once

#include <cstdint>
#include <vector>

#include "echo/batch/reception.h"
#include "echo/grid/echo_grid.h"
#include "insonify/sonar_config.h"
#include "receiver/speckle/scatterer_row.h"
#include "receiver/speckle/speckle_view.h"

namespace insonify {

/// Scatterers are numbered along the surface. In the vertical plane of a bearing, the world (or the moving object) is
/// divided into steps, kStepsPerWindow per bin, along the horizontal or the vertical axis, whichever is closer to the
/// surface. The window of a bin is the interval of steps between the points where its near and far edge intersect the
/// surface. So windows of neighbouring bins do not overlap, and a sonar that moves ahead, turns or rises receives the
/// same scatterers again, at their new ranges.
///
/// Bearings are indexed in cells from a fixed direction, not in metres across: for sideways motion the speckle of an
/// array decorrelates within half its length (docs/concepts/speckle.md), much less than a cell's width except very near
/// the sonar. Each bearing has independent scatterers in strips kStripWidth wide sideways, whose borders differ from
/// bearing to bearing. Surfaces at least kLayer apart across the lattice have independent scatterers.
class ScattererLattice {
 public:
  static constexpr double kStepsPerWindow = 2;  ///< For a surface along the ray.
  static constexpr double kStripWidth = 2;      ///< [m]
  static constexpr double kLayer = 1;           ///< [m]

  /// @param cells        The grids' cells.
  /// @param sonar        Its range bins.
  /// @param range_scale  True range / reported range.
  /// @param wavelength   [m]
  /// @param window       True length of a bin's window [m].
  ScattererLattice(const BearingGrid& cells, const SonarConfig& sonar, double range_scale, double wavelength,
                   double window, std::uint64_t seed);

  /// Finds the windows of the given bins of a cell: on the object for echoes of an object, else in the world. `views`
  /// must outlive the use of `row`.
  void locate(const SpeckleViews& views, int cell, BinRange bins, const EchoGrid& grid, ScattererRow& row) const;

  [[nodiscard]] double first_range() const { return first_range_; }
  [[nodiscard]] double bin_length() const { return bin_length_; }
  [[nodiscard]] double window() const { return window_; }
  [[nodiscard]] double turns_per_metre() const { return turns_per_metre_; }
  [[nodiscard]] const RangeBins& ranges() const { return ranges_; }
  [[nodiscard]] const LatticeShape& shape() const { return shape_; }

  /// The lattice of a cell's bearing, seen from a sonar.
  [[nodiscard]] LatticeAxes axes_of(int cell, const SpeckleView& view) const;

 private:
  void divide(const SpeckleViews& views, ScattererRow& row) const;
  [[nodiscard]] int surface_end(int first, int last, BinRange filled, const ScattererRow& row) const;
  void locate_surface(const LatticeAxes& axes, BinRange bins, bool level, ScattererRow& row) const;
  void rescale(const LatticeAxes& axes, int bin, ScattererRow& row) const;

  int bins_;
  double first_range_, bin_length_;  // True range of bin 0's middle, and true bin length [m].
  double window_, step_;             // [m]
  double cell_width_;                // Width of the narrowest cell [rad].
  double turns_per_metre_;           // Phase per metre of range, out and back [turns/m].
  RangeBins ranges_;                 // The same ranges.
  LatticeShape shape_;
  std::vector<double> azimuth_;  // [cell]: azimuth of the centre [rad].
  std::uint64_t seed_;
};

}  // namespace insonify
