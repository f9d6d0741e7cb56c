// output_tile.h -- what is heard, on its way from one beam after another, as grids lie, to one range after another, as
// pings lie.

#pragma once

#include <algorithm>

#include "echo/grid/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "receiver/transpose_tile.h"

namespace insonify {

/// Some beams and bins: at most kTileBeams by kTileBins.
struct TilePlace {
  int first_beam, beam_count;
  int first_bin, bin_count;

  [[nodiscard]] BinRange bins() const { return {first_bin, first_bin + bin_count}; }
};

/// What becomes of them, a beam at a time.
struct OutputTile {
  BeamTile<float> intensity, elevation;
  BeamTile<std::uint32_t> surface;
  bool named = false;  ///< Whether any cell has a label: else elevation and surface mean nothing.
};

/// Calls visit(place) for the tiles of beams [first, last).
template <typename Visit>
void for_each_tile(int first_beam, int last_beam, int bins, Visit&& visit) {
  for (int beam = first_beam; beam < last_beam; beam += kTileBeams) {
    for (int bin = 0; bin < bins; bin += kTileBins) {
      visit(TilePlace{beam, std::min(kTileBeams, last_beam - beam), bin, std::min(kTileBins, bins - bin)});
    }
  }
}

/// Makes room for every cell; allocates only when it needs more memory than before. Tables that are not asked for are
/// empty.
void size_tables(Ping& ping, int beams, int bins, GroundTruth ground_truth);

/// Asks for the rows of the ping that the tile goes to, some with each of its beams, so that they are near when it is
/// written.
/// @param labelled  As for write_tile().
void fetch_rows(const TilePlace& place, int beam_of_tile, bool labelled, const Ping& ping);

/// Copies the labels of one row of the grid to one beam of the tile, or of several the one with most energy in each
/// bin.
void take_labels(const EchoGrid& grid, int first_row, int rows, const TilePlace& place, int beam_of_tile,
                 OutputTile& tile);

/// Writes a tile into the ping.
/// @param labelled  Whether the tile holds labels; else intensities alone are written.
void write_tile(const OutputTile& tile, const TilePlace& place, bool labelled, Ping& ping);

/// How much of an echo is heard at the range of a bin: 0 at min_range, rising in a straight line to 1 at
/// blanking_range.
[[nodiscard]] float near_field(const SonarConfig& sonar, int bin);

}  // namespace insonify
