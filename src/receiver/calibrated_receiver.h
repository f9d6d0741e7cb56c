// calibrated_receiver.h -- turns an EchoGrid into a Ping in the `calibrated` model.

#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/batch/reception.h"
#include "echo/grid/echo_grid.h"
#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "insonify/water.h"
#include "receiver/array/bearing_cells.h"
#include "receiver/array/bearing_response.h"
#include "receiver/array/receiver_channels.h"
#include "receiver/digitizer.h"
#include "receiver/discrete_echoes.h"
#include "receiver/noise/noise_field.h"
#include "receiver/noise/surface_noise.h"
#include "receiver/noise/thruster_noise.h"
#include "receiver/output_tile.h"
#include "receiver/phase_receiver.h"
#include "receiver/ping_motion.h"
#include "receiver/pulse/coarse_bins.h"
#include "receiver/pulse/range_response.h"
#include "receiver/reception_shift.h"
#include "receiver/speckle/clutter.h"
#include "receiver/speckle/scatterer_lattice.h"
#include "receiver/speckle/scatterer_row.h"
#include "receiver/speckle/sparse_scatterers.h"
#include "receiver/speckle/speckle.h"
#include "receiver/speckle/speckle_view.h"
#include "receiver/transmit_leak.h"
#include "receiver/truth_receiver.h"

namespace insonify {

/// Layers of [cell][bin] or [beam][bin]. Which there are is decided when the receiver is built; each step of its chain
/// treats those that are not empty.
struct Signals {
  std::vector<std::complex<float>> field;  ///< Complex field, with speckle.
  std::vector<float>
      energy;  ///< Energy, without speckle; with speckle the mean of |field|^2, where decimation needs it.
  std::vector<float> extended;  ///< With both: the part of the energy that is in every look, see CoarseBins.

  /// @param speckle, mean  Whether there is speckle, and whether its mean is needed.
  Signals(std::size_t size, bool speckle, bool mean)
      : field(speckle ? size : 0), energy(!speckle || mean ? size : 0), extended(speckle && mean ? size : 0) {}
};

/// The receiver chain of the calibrated model. Intensities are relative to the source's at 1 m, so that 10 log10 of one
/// is EL - SL. For each ping:
///
///   1. Motion: if the sonar moves, echoes are shifted to the cells in which they are received.
///   2. Sum: the energies of all path orders are summed in each cell (beam or part of one, by range bin), and the
///      water's volume reverberation is added from directions in which no surface was hit at a shorter range.
///   3. Speckle: each cell's energy becomes a complex Gaussian field of that mean intensity, fixed in the world.
///      Without speckle the energies themselves are passed on.
///   4. Pulse and array pattern (where bins are longer than the pulse: the energy of one look, see CoarseBins):
///   convolution along range with p and along bearing with g; energies with |p|^2, |g|^2.
///   5. Discrete echoes (ideal points, interference) are added to each beam and bin with the gain g p.
///      Of a multibeam, the differences of the halves of its array are formed too, see PhaseReceiver.
///   6. Crosstalk: a share of all beams' echoes is added to each. Noise is added: a complex Gaussian field, independent
///   from ping to ping, with the correlation that array and matched filter give it (NoiseField, ThrusterNoise).
///   7. The transmit leak is added to the field; below `dead_range` nothing else is received.
///   8. Detection: squared magnitude, times the gain of the beam's channel, decimation to bins longer than the pulse,
///   clipped at saturation, times near-field ramp and gain; then counts.
class CalibratedReceiver {
 public:
  struct Settings {
    const SonarConfig& sonar;
    const BearingCells& cells;           ///< The grids' bearing cells.
    std::span<const float> cell_angles;  ///< Solid angle of each cell, weighted by the pattern both ways [sr]; see
                                         ///< Lattice::beam_angle().
    const Water& water;
    const ReceiverConfig& receiver;
    std::span<const Material> materials;  ///< The scene's materials.
    std::span<const Thruster> thrusters = {};
    bool moves = false;  ///< Whether motion between transmission and reception is simulated.
    std::uint64_t seed = 1;
    const CalibratedReceiver* like = nullptr;  ///< One made with these settings: this one shares its gains.
  };
  explicit CalibratedReceiver(const Settings& settings);

  /// The steps up to the beams, with the noise where no later step comes before it, as tables; null where one of them
  /// is only here: motion, clutter, few scatterers, looks, no speckle.
  [[nodiscard]] const std::shared_ptr<const FlatReceiver>& flat() const { return flat_; }

  /// Bins, from the first, in which the transmit leak is above the noise: TransmitLeak::covered_bins().
  [[nodiscard]] int covered_bins() const { return leak_ ? leak_->covered_bins() : 0; }

  /// Sets what flat() needs for a ping.
  void aim(std::span<const DisplacedInstance> displaced, const Pose& world_from_sonar, Reception& reception);

  /// Writes the tables of `ping`, whose number must be set; allocates only when they need more memory than before.
  /// @param formed            What the engine has made of flat(); null: the grid's cells are received here.
  /// @param displaced         Instances that have moved from their pose in the scene; their speckle moves with them.
  /// @param world_from_sonar  Pose of the transducer at transmission.
  /// @param motion            Its motion after transmission; ignored unless Settings::moves.
  /// @param thrusters         [thruster] Position in the sonar frame [m]; none if the straight path is blocked.
  void receive(const EchoGrid& grid, const FormedBeams* formed, std::span<const DisplacedInstance> displaced,
               const Pose& world_from_sonar, const PingMotion& motion, std::span<const std::optional<Vec3>> thrusters,
               Workers& workers, Ping& ping);

 private:
  // Buffers of one worker thread for one cell's row of bins, before the pulse is applied.
  struct Row {
    std::vector<float> energy, extended;
    std::vector<std::complex<float>> field;
    ScattererRow scatterers;
  };

  struct SetUp;  // calibrated_receiver_setup.cpp
  void set_up_array(SetUp& parts);
  void set_up_noise(const SetUp& parts);
  [[nodiscard]] NoiseField::Settings noise_settings(const SetUp& parts) const;
  void set_up_phase(const SetUp& parts);
  void set_up_speckle(const SetUp& parts);
  [[nodiscard]] bool is_flat() const;
  [[nodiscard]] FlatReceiver flattened() const;

  void move(const EchoGrid& grid, const PingMotion& motion, Workers& workers);
  // Interval of bins of a cell that can be non-zero, before and after the convolution with the pulse.
  [[nodiscard]] BinRange filled_bins(const EchoGrid& grid, int cell) const;
  [[nodiscard]] BinRange received_bins(const EchoGrid& grid, int cell) const;
  void sum_energy(const EchoGrid& grid, int cell, std::span<float> energy) const;
  void receive_cell(const EchoGrid& grid, int cell, Row& row);
  void receive_energy(const EchoGrid& grid, int cell, Row& row);
  void receive_field(const EchoGrid& grid, int cell, Row& row);
  void receive_mean(const EchoGrid& grid, int cell, Row& row);
  void set_noise_levels(const Pose& world_from_sonar, std::vector<float>& deviations);
  [[nodiscard]] float kept(float intensity, int beam, int bin) const;
  void form_beams(const EchoGrid& grid, Workers& workers);
  void add_discrete_echoes(const EchoGrid& grid);
  void couple_channels(Workers& workers);
  void draw_noise(const Ping& ping, const Pose& world_from_sonar, std::span<const std::optional<Vec3>> thrusters,
                  Workers& workers);
  void receive_leak();
  void detect(const EchoGrid& grid, const FormedBeams* formed, Workers& workers, Ping& ping);
  void write_truth(const EchoGrid& grid, Workers& workers, Ping& ping);
  [[nodiscard]] DiscreteEchoes discrete() const;
  [[nodiscard]] bool has_noise(const FormedBeams* formed) const { return formed != nullptr && flat_->noise_rows > 0; }
  [[nodiscard]] Signals& beam_signals() { return bearing_ ? of_beams_ : of_cells_; }
  [[nodiscard]] const Signals& beam_signals() const { return bearing_ ? of_beams_ : of_cells_; }
  void detect_tile(const EchoGrid& grid, const FormedBeams* formed, const TilePlace& place, Ping& ping) const;

  int beams_, bins_, cells_, cells_per_beam_;
  std::vector<int> first_cells_;   // [beam]
  std::vector<float> gain_;        // [bin]: intensity gain, near-field ramp times time-varied gain.
  std::vector<float> volume_;      // [bin]: volume reverberation per unit solid angle [1/sr]; empty without any.
  std::vector<float> cell_angle_;  // [cell]: solid angle, weighted by the pattern both ways [sr].
  TruthReceiver truth_;
  // [beam] Standard deviation of real and imaginary part of the noise, re the source's amplitude at 1 m. The same for
  // all beams without `surface_noise_`.
  std::vector<float> noise_deviation_;
  float isotropic_noise_ = 0;           // Intensity of the isotropic noise, equal in all beams.
  double surface_noise_level_ = 0;      // Intensity of the surface's noise per unit of SurfaceNoise::receive().
  std::vector<double> surface_shares_;  // [beam].
  std::optional<SurfaceNoise> surface_noise_;
  float saturation_;  // Largest intensity before gain.
  bool has_field_;
  std::uint64_t seed_;
  std::optional<ReceptionShift> shift_;
  EchoGrid moved_;
  std::optional<ScattererLattice> lattice_;
  std::optional<Speckle> speckle_;  // With lattice_.
  SpeckleViews views_;
  std::optional<Clutter> clutter_;
  std::optional<SparseScatterers> sparse_;
  std::optional<Digitizer> digitizer_;
  std::optional<RangeResponse> range_;
  std::optional<CoarseBins> coarse_;  // With range_.
  bool keeps_looks_ = false;          // Whether intensities are transformed by CoarseBins::kept().
  std::shared_ptr<const BearingResponse> bearing_;
  std::optional<PhaseReceiver> phase_;
  std::optional<NoiseField> noise_;
  std::optional<ThrusterNoise> thrusters_;  // With noise_.
  std::optional<ReceiverChannels> channels_;
  std::optional<TransmitLeak> leak_;
  std::shared_ptr<const FlatReceiver> flat_;

  std::vector<Row> rows_;                                          // [worker].
  Signals of_cells_{0, false, false}, of_beams_{0, false, false};  // The latter with bearing_; else beams are cells.
};

}  // namespace insonify
