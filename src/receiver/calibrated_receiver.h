// calibrated_receiver.h -- from an EchoGrid to a Ping in the `calibrated` model.

#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/grid/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "insonify/water.h"
#include "receiver/bearing_cells.h"
#include "receiver/bearing_response.h"
#include "receiver/clutter.h"
#include "receiver/digitizer.h"
#include "receiver/discrete_echoes.h"
#include "receiver/output_tile.h"
#include "receiver/range_response.h"
#include "receiver/reception_shift.h"
#include "receiver/sparse_scatterers.h"
#include "receiver/speckle.h"
#include "receiver/truth_receiver.h"

namespace insonify {

/// Echo intensities of all path orders are summed in each cell, relative to the source's at 1 m: 10 log10 of them is
/// EL - SL. With speckle each cell becomes a complex Gaussian field of that mean intensity, fixed in the world; without
/// it energies go on.
/// The water's own reverberation comes to it, from directions in which no surface was met at a shorter range.
/// Pulse and array then mix neighbouring cells, by |p g|^2 of energies, by p g of fields. Thermal noise, a complex
/// Gaussian field drawn anew for each ping and cell, is added to the field before it is detected. Last come the limit
/// of the input, the ramp of the near field, gain, and counts.
class CalibratedReceiver {
 public:
  struct Settings {
    const SonarConfig& sonar;
    const BearingCells& cells;           ///< What the grids are of.
    std::span<const float> cell_angles;  ///< That each hears of what is sent, see Lattice::beam_angle() [sr].
    const Water& water;
    const ReceiverConfig& receiver;
    std::span<const Material> materials;  ///< Of the scene.
    bool moves = false;                   ///< Whether the sonar moves while it listens.
    std::uint64_t seed = 1;
  };
  explicit CalibratedReceiver(const Settings& settings);

  /// Fills the tables of a ping, whose number is read; allocates only when they need more memory than before.
  /// @param world_from_sonar  Pose of the transducer.
  /// @param motion            From then on; only where the settings say that it moves.
  void receive(const EchoGrid& grid, const Pose& world_from_sonar, const PingMotion& motion, Workers& workers,
               Ping& ping);

 private:
  // One worker's row of bins, before the pulse.
  struct Row {
    std::vector<float> energy;
    std::vector<std::complex<float>> field;
    Speckle::Row scatterers;
  };

  void move(const EchoGrid& grid, const PingMotion& motion, Workers& workers);
  // Bins of a cell in which there is anything, before the pulse and after it.
  [[nodiscard]] BinRange filled_bins(const EchoGrid& grid, int cell) const;
  [[nodiscard]] BinRange received_bins(const EchoGrid& grid, int cell) const;
  void sum_energy(const EchoGrid& grid, int cell, std::span<float> energy) const;
  void hear_cell(const EchoGrid& grid, int cell, const Speckle::View& view, Row& row);
  void hear_bearings(const EchoGrid& grid, Workers& workers);
  void receive_discrete_echoes(const EchoGrid& grid, const DiscreteEchoes& discrete);
  void hear_tile(const EchoGrid& grid, const TilePlace& place, Ping& ping) const;

  int beams_, bins_, cells_, first_cell_, cells_per_beam_;
  std::vector<float> gain_;        // Of each bin: near field and time-varied gain.
  std::vector<float> volume_;      // Of each bin: what the water echoes per unit of solid angle; empty for nothing.
  std::vector<float> cell_angle_;  // Of each cell: solid angle that it hears of what is sent [sr].
  TruthReceiver truth_;
  double noise_intensity_ = 0;
  float saturation_;  // Intensity before gain.
  bool noisy_, has_field_;
  std::uint64_t seed_;
  std::optional<ReceptionShift> shift_;
  EchoGrid moved_;
  std::optional<Speckle> speckle_;
  std::optional<Clutter> clutter_;
  std::optional<SparseScatterers> few_;
  std::optional<Digitizer> digitizer_;
  std::optional<RangeResponse> range_;
  std::optional<BearingResponse> bearing_;

  std::vector<Row> rows_;  // Of each worker.
  // [cell][bin] and [beam][bin]; of energies or of a field.
  std::vector<float> cell_energy_, beam_energy_;
  std::vector<std::complex<float>> cell_field_, beam_field_;
};

}  // namespace insonify
