// truth_receiver.h -- writes the full ground truth of a Ping from an EchoGrid with GroundTruth::kFull.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/grid/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "receiver/array/bearing_cells.h"
#include "receiver/array/bearing_response.h"
#include "receiver/discrete_echoes.h"
#include "receiver/instances.h"
#include "receiver/output_tile.h"
#include "receiver/pulse/coarse_bins.h"
#include "receiver/pulse/range_response.h"

namespace insonify {

/// Writes, for each beam and bin, which instances echo and how much, the dominant path order, the shadow, and the
/// intensity of direct echoes alone (docs/concepts/ground-truth.md).
///
/// Instances, path order and shadow describe the cells in the beam's own slice of azimuth, before pulse and array
/// pattern mix them with their neighbours. The direct echo passes through pulse, array pattern, near field and gain, as
/// the intensity does.
class TruthReceiver {
 public:
  /// @param cells        The grids' bearing cells.
  /// @param cell_angles  Solid angle of each cell, weighted by the pattern both ways [sr].
  TruthReceiver(const SonarConfig& sonar, const BearingCells& cells, std::span<const float> cell_angles);

  /// The parts of the receiver that direct echoes pass through.
  struct Reception {
    const RangeResponse* range;      ///< Pulse; null for none.
    const BearingResponse* bearing;  ///< Array pattern; null for none.
    const CoarseBins* coarse;        ///< Decimation; null without a pulse.
    const DiscreteEchoes* discrete;
    std::span<const float> gain;  ///< Intensity gain, [bin].
  };

  /// Writes the ping's tables of ground truth, which have been sized. Allocates at the first ping only.
  void write(const EchoGrid& grid, const Reception& reception, Workers& workers, Ping& ping);

 private:
  // One beam of a tile, [bin].
  struct BeamTile {
    float energy[kTileBins];        // Sum over all path orders.
    std::uint8_t order[kTileBins];  // Path order with most energy; 0 for none.
    float shadow[kTileBins];        // Share of the beam's solid angle that is hidden; 0 where there is a direct echo.
  };

  void receive_direct(const EchoGrid& grid, const Reception& reception, Workers& workers, Ping& ping);
  void write_truth_tile(const EchoGrid& grid, const TilePlace& place, std::array<float, kTileBeams>& hidden,
                        Instances& instances, Ping& ping) const;
  BeamTile beam_tile(const EchoGrid& grid, int beam, const TilePlace& place, float& hidden) const;
  void add_surfaces(const EchoGrid& grid, int beam, int bin, Instances& instances) const;
  [[nodiscard]] float hidden_before(const EchoGrid& grid, int beam) const;  // Solid angle hidden before bin 0 [sr].
  void write_discrete_echo(const EchoGrid& grid, const DiscreteEcho& echo, Ping& ping) const;

  // Calls visit(cell) for the cells of a beam's own slice.
  template <typename Visit>
  void for_each_cell(int beam, Visit&& visit) const {
    for (int cell = own_.firsts[beam]; cell < own_.firsts[beam] + own_.per_beam; ++cell) {
      visit(cell);
    }
  }

  int beams_, bins_, cells_;
  BearingCells own_;
  float middle_elevation_;                    // Elevation of the middle of the aperture [rad].
  std::vector<float> beam_angle_;             // [beam]: solid angle [sr].
  std::vector<Instances> instances_;          // [worker]: scratch.
  std::vector<float> direct_, direct_beams_;  // [cell][bin] and [beam][bin].
  std::vector<std::vector<float>> looks_;     // [worker][bin]: energies of one look.
};

}  // namespace insonify
