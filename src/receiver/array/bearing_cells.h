// bearing_cells.h -- the bearing grid of an EchoGrid: the cells from which the array pattern forms beams.

#pragma once

#include <vector>

#include "insonify/bearing_grid.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Cells in bearing, from which beams are formed.
///
/// With a top-hat beam pattern each cell is a beam. An array pattern needs a finer grid, because a beam receives echoes
/// from between and outside the beam directions: two cells per beam for a fan, and guard cells on either side of it.
/// They reach so far that the outermost beam loses less than kGuardLoss of its energy. Where beams are narrower than
/// their spacing, there are more cells per beam: none is wider than half a beam. Where they overlap so much that their
/// spacing is at most kWidestSingle of their width, each has one cell. A gap between beams is filled with guard cells
/// as far as the beams beside it reach.
///
/// The beams of a multibeam have cells of a quarter of their width, from whose echoes the phase between the halves of
/// the array follows.
///
/// The single beam of a two-way array, such as that of a scanning head, is divided into eight cells, that of
/// a side-scan sonar into four. The grid extends by two beam widths on either side, and further to where the two-way
/// pattern of the perfect array stays below kTwoWayFloorDb: in cells as narrow up to kNarrowNeighbours beam widths on
/// either side, beyond in cells as wide as the beam, so that they take little time.
struct BearingCells {
  /// Share of the pattern's energy that may lie outside the guard cells, for the outermost beam of a fan. Guard cells
  /// end at kGuardEnd even where more is lost.
  static constexpr double kGuardLoss = 0.02;
  static constexpr double kGuardEnd = radians_from_degrees(89);  ///< [rad]; patterns are functions of the sine.

  /// A cell of this part of a beam's width loses at most .25 dB of an echo at its edge (sinc^2 at .13 wavelength / D),
  /// two cells per beam of the Gemini 720i .16 dB.
  static constexpr double kWidestSingle = 0.3;

  static constexpr double kTwoWayFloorDb = -60;  ///< Re the main lobe, as BearingResponse::kFloorDb [dB].
  static constexpr int kNarrowNeighbours = 4;    ///< Beyond, side lobes of a uniform line are below -45 dB.

  static constexpr int kPerTwoWayBeam = 8;
  static constexpr int kPerSide = 4;

  /// @param sonar             An aperture; a multibeam may be one.
  /// @param per_two_way_beam  Cells of the beam of a two-way array.
  /// @throws Error if beams narrower than their spacing take more than 32768 cells.
  BearingCells(const SonarConfig& sonar, const ReceiverConfig& receiver, int per_two_way_beam = kPerTwoWayBeam);

  BearingGrid grid;         ///< The cells, which engines sample.
  int columns = 1;          ///< Lattice columns in each cell.
  int per_beam = 1;         ///< Cells per beam: those within the beam's own slice of azimuth.
  std::vector<int> firsts;  ///< [beam] Index of the cell at the port edge of the beam.

  /// u of the cells' edges, one more than cells, where some are wider than side lobes; else empty.
  std::vector<double> edge_sines;

  /// The beam whose own slice holds a cell; -1 for guard cells.
  [[nodiscard]] int beam_of(int cell) const;

 private:
  void set_fan(const SonarConfig& fan, double reach);
  void set_gapped_fan(const BearingGrid& beams, double reach, double guard_width);
  void set_two_way(const SonarConfig& sonar, double end);
};

}  // namespace insonify
