// reception.h -- what a receiver does with the echoes of cells, as plain numbers and tables: for engines that do it
// where the echoes are.

#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/grid/echo.h"
#include "echo/laws/laws.h"

namespace insonify {

/// True ranges of bins.
struct RangeBins {
  float first = 0, length = 0;  ///< Middle of bin 0, and length [m].
};

/// How windows lie in the lattice of scatterers, see ScattererLattice.
struct LatticeShape {
  float window_share = 0;     ///< Window over bin length.
  float layers_per_step = 0;  ///< Layers that a step is long.
  float jump = 0;             ///< Surfaces end where elevations differ by more than jump / range + jump_angle [m].
  float jump_angle = 0;       ///< [rad]
  int smoothed_bins = 0;      ///< Half width of the mean over elevations.
};

/// The lattice of a bearing, seen from a sonar.
struct LatticeAxes {
  double ahead = 0, up = 0;  ///< Position of the transducer [steps].
  ScattererKey key = {};     ///< The bearing's random numbers: four 32-bit words.
  float across_turns = 0;    ///< Phase per cell width of a scatterer's distance from the cell's middle [turns].
  LatticeProjection projection = {};
  LatticeOrigin ahead_from = {}, up_from = {};
};

/// Speckle of all bearings.
struct SpeckleShape {
  std::uint32_t first_turns = 0, turns_per_bin = 0;  ///< Phase at the near edge of windows [2^-32 turns].
  float turns_per_window = 0;
  float bins_per_window = 0;
  float shared = 0;  ///< Factor on the intensity of scatterers that bins share; 0 if they do not.
  float spread_share = 0, spread_turns = 0;  ///< See CarrierSpread.
};

/// A banded matrix of gains of rows, see GainMatrix: [block][row][kBlockBeams].
struct GainTable {
  static constexpr int kBlockBeams = 8;

  std::span<const float> gains = {};
  std::vector<int> bands = {};  ///< [block][2] First row, and last + 1.

  [[nodiscard]] bool empty() const { return gains.empty(); }
};

/// Gains of the array in bins before `end`.
struct GainZone {
  int end = 0;
  GainTable in_phase = {}, quadrature = {};  ///< Real and imaginary parts; the latter is empty where all are real.
};

/// The steps of CalibratedReceiver from the cells' echoes to the field of each beam, with the ping's noise. Gains refer
/// to the receiver; what has been made of them does not.
struct FlatReceiver {
  int cells = 0, bins = 0, beams = 0;
  int cells_per_beam = 1;
  std::vector<int> first_cells;   ///< [beam] The first of its own cells, which label it.
  std::vector<float> volume;      ///< [bin] Volume reverberation per unit solid angle [1/sr]; empty without any.
  std::vector<float> cell_angle;  ///< [cell] Solid angle [sr].

  bool has_pulse = false;  ///< Without one, energies are those of whole bins.
  float look_share = 1;    ///< Share of an extended echo that the pulse receives at a time.
  float look_pairs = 1;    ///< See one_look().

  RangeBins ranges;
  LatticeShape lattice;
  SpeckleShape speckle;

  int first_tap = 0;              ///< Bin that the first tap takes, relative to the received one.
  std::vector<float> taps = {1};  ///< Amplitude of the pulse, bin by bin; its peak is 1.
  std::vector<GainZone> zones;    ///< By range; empty: beams are cells.

  static constexpr int kNoiseBlock = 64;  ///< Numbers of a row that one draw makes, see draw_normals().
  int noise_rows = 0;                     ///< Rows of noise; 0: the host adds the noise.
  std::vector<float> noise_taps;          ///< Filter along range.
  GainTable noise_gains;                  ///< Empty where rows are the beams.
  std::array<std::uint32_t, 2> seed = {};
};

/// A FlatReceiver at one ping.
struct Reception {
  std::shared_ptr<const FlatReceiver> receiver;  ///< Null: the host receives.
  std::vector<LatticeAxes> axes;                 ///< [frame][cell] Frame 0 is the world, the others moved objects.
  std::vector<std::uint32_t> instances;          ///< [frame - 1] The objects.
  std::vector<float> noise_deviation;  ///< [beam] Standard deviation of each part, re the source's amplitude at 1 m.
};

/// What an engine has received of a ping.
struct FormedBeams {
  std::span<const std::complex<float>> field;  ///< [beam][bin] With noise, where FlatReceiver has it.
  std::span<const SurfaceLabel> surface;       ///< [beam][bin] The strongest surface.
  std::span<const float> elevation;            ///< [beam][bin] Its mean elevation; NaN without one [rad].
};

}  // namespace insonify
