// calibrated_receiver.h -- from an EchoGrid to a Ping in the `calibrated` model.

#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "insonify/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "insonify/water.h"
#include "receiver/bearing_cells.h"
#include "receiver/bearing_response.h"
#include "receiver/heard_tile.h"
#include "receiver/range_response.h"

namespace insonify {

/// Echo intensities of all path orders are summed in each cell, relative to the source's at 1 m: 10 log10 of them is
/// EL - SL. With speckle each cell becomes a complex Gaussian field of that mean intensity; without it energies go on.
/// The water's own reverberation comes to it, from directions in which no surface was met at a shorter range.
/// Pulse and array then mix neighbouring cells, by |p g|^2 of energies, by p g of fields. Thermal noise, a complex
/// Gaussian field drawn anew for each ping and cell, is added to the field before it is detected. Last come the ramp of
/// the near field and time-varied gain.
///
/// Speckle is the same as long as nothing moves, and drawn anew as soon as the sonar does.
class CalibratedReceiver {
 public:
  /// @param cells        What the grids are of.
  /// @param cell_angles  Solid angle that each cell hears of what is sent, see Lattice::beam_angle() [sr].
  CalibratedReceiver(const SonarConfig& sonar, const BearingCells& cells, std::span<const float> cell_angles,
                     const Water& water, const ReceiverConfig& config, std::uint64_t seed);

  /// Fills the tables of a ping, whose number is read; allocates only when they need more memory than before.
  /// @param world_from_sonar  Pose of the transducer.
  void hear(const EchoGrid& grid, const Pose& world_from_sonar, Workers& workers, Ping& ping);

 private:
  // One worker's row of bins, before the pulse.
  struct Row {
    std::vector<float> energy;
    std::vector<std::complex<float>> field;
  };

  void sum_energy(const EchoGrid& grid, int cell, std::span<float> energy) const;
  void draw_speckle(int cell, std::uint64_t look, const Row& row, std::span<std::complex<float>> field) const;
  void hear_cell(const EchoGrid& grid, int cell, std::uint64_t look, Row& row);
  void hear_tile(const EchoGrid& grid, const TilePlace& place, Ping& ping) const;
  void take_strongest_labels(const EchoGrid& grid, const TilePlace& place, int beam_of_tile, HeardTile& tile) const;

  int beams_, bins_, cells_, first_cell_, cells_per_beam_;
  std::vector<float> gain_;        // Of each bin: near field and time-varied gain.
  std::vector<float> volume_;      // Of each bin: what the water echoes per unit of solid angle; empty for nothing.
  std::vector<float> cell_angle_;  // Of each cell: solid angle that it hears of what is sent [sr].
  double noise_intensity_ = 0;
  bool noisy_, speckled_;
  std::uint64_t seed_;
  std::optional<RangeResponse> range_;
  std::optional<BearingResponse> bearing_;

  std::vector<Row> rows_;  // Of each worker.
  // [cell][bin] and [beam][bin]; of energies or of a field.
  std::vector<float> cell_energy_, beam_energy_;
  std::vector<std::complex<float>> cell_field_, beam_field_;
};

}  // namespace insonify
