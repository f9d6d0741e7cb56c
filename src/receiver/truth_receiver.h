// truth_receiver.h -- what each bin's echo was made of: from an EchoGrid with GroundTruth::kFull to a Ping.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/grid/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "receiver/bearing_cells.h"
#include "receiver/bearing_response.h"
#include "receiver/discrete_echoes.h"
#include "receiver/instances.h"
#include "receiver/output_tile.h"
#include "receiver/range_response.h"

namespace insonify {

/// Surfaces, path order and shadow are those of the cells in each beam's own slice of azimuth, before pulse and array
/// mix them with others. The direct echo is heard as all echoes are: with array, pulse, near field and gain.
class TruthReceiver {
 public:
  /// @param cells        What the grids are of.
  /// @param cell_angles  Solid angle that each of them hears of what is sent [sr].
  TruthReceiver(const SonarConfig& sonar, const BearingCells& cells, std::span<const float> cell_angles);

  /// How the receiver hears; null for no pulse, no array.
  struct Reception {
    const RangeResponse* range;
    const BearingResponse* bearing;
    const DiscreteEchoes* discrete;
    std::span<const float> gain;  ///< Of each bin.
  };

  /// Fills the ping's tables of ground truth, which have their sizes. Allocates at the first ping only.
  void write(const EchoGrid& grid, const Reception& reception, Workers& workers, Ping& ping);

 private:
  // Of one beam, over the bins of a tile.
  struct BeamTile {
    float energy[kTileBins];        // Of all orders.
    std::uint8_t order[kTileBins];  // Of most of it; 0 for none.
    float shadow[kTileBins];        // Share of the beam that is hidden, where it hears nothing direct.
  };

  void receive_direct(const EchoGrid& grid, const Reception& reception, Workers& workers, Ping& ping);
  void tell_tile(const EchoGrid& grid, const TilePlace& place, std::array<float, kTileBeams>& hidden,
                 Instances& instances, Ping& ping) const;
  BeamTile beam_tile(const EchoGrid& grid, int beam, const TilePlace& place, float& hidden) const;
  void add_surfaces(const EchoGrid& grid, int beam, int bin, Instances& instances) const;
  [[nodiscard]] float hidden_before(const EchoGrid& grid, int beam) const;  // The near edge of bin 0.
  void write_discrete_echo(const EchoGrid& grid, const DiscreteEcho& echo, Ping& ping) const;

  // Calls visit(cell) for the cells of a beam's own slice.
  template <typename Visit>
  void for_each_cell(int beam, Visit&& visit) const {
    for (int cell = first_cell_ + beam * cells_per_beam_; cell < first_cell_ + (beam + 1) * cells_per_beam_; ++cell) {
      visit(cell);
    }
  }

  int beams_, bins_, cells_, first_cell_, cells_per_beam_;
  float middle_elevation_;                    // Of the aperture [rad].
  std::vector<float> whole_;                  // Of each beam: solid angle [sr].
  std::vector<Instances> instances_;          // Of each worker: scratch.
  std::vector<float> direct_, direct_beams_;  // [cell][bin] and [beam][bin].
};

}  // namespace insonify
