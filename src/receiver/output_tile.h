// output_tile.h -- tiles of received values that are transposed from beam-major (EchoGrid) to range-major (Ping).

#pragma once

#include <algorithm>

#include "echo/batch/reception.h"
#include "echo/grid/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "receiver/transpose_tile.h"

namespace insonify {

/// Which beams and bins a tile covers: at most kTileBeams by kTileBins.
struct TilePlace {
  int first_beam, beam_count;
  int first_bin, bin_count;

  [[nodiscard]] BinRange bins() const { return {first_bin, first_bin + bin_count}; }
};

/// Received values of a tile, beam-major.
struct OutputTile {
  BeamTile<float> intensity;
  BeamTile<float> elevation;        ///< Mean elevation of the label [rad].
  BeamTile<std::uint32_t> surface;  ///< Label: instance and material, see echo/grid/echo.h.
  bool has_labels = false;          ///< Whether any bin has a label. If not, `elevation` and `surface` are not set.
};

/// Calls visit(place) for every tile of beams [first_beam, last_beam) and bins [0, bins).
template <typename Visit>
void for_each_tile(int first_beam, int last_beam, int bins, Visit&& visit) {
  for (int beam = first_beam; beam < last_beam; beam += kTileBeams) {
    for (int bin = 0; bin < bins; bin += kTileBins) {
      visit(TilePlace{beam, std::min(kTileBeams, last_beam - beam), bin, std::min(kTileBins, bins - bin)});
    }
  }
}

/// Sizes the tables of a ping for beams x bins; those that `ground_truth` does not ask for become empty, and so do
/// `phase` and `soundings`, since a ping may be used again for another sonar. Allocates only when tables need more
/// memory than before.
void size_tables(Ping& ping, int beams, int bins, GroundTruth ground_truth);

/// Sets the labels of one beam of the tile to those that an engine has found.
/// @param start  The tile's first bin of the beam in `formed`.
void copy_labels(const FormedBeams& formed, std::size_t start, const TilePlace& place, int beam_of_tile,
                 OutputTile& tile);

/// Sets the labels of one beam of the tile: in each bin, the label with most energy among `rows` rows of the grid (the
/// cells of the beam's own slice).
void take_labels(const EchoGrid& grid, int first_row, int rows, const TilePlace& place, int beam_of_tile,
                 OutputTile& tile);

/// Writes a tile into the ping, transposed.
/// @param labelled  Whether to write labels as well as intensities.
void write_tile(const OutputTile& tile, const TilePlace& place, bool labelled, Ping& ping);

/// Amplitude gain of the near field at the centre of a bin: 0 at min_range, rising linearly to 1 at blanking_range.
[[nodiscard]] float near_field(const SonarConfig& sonar, int bin);

}  // namespace insonify
