// echo_grid.h -- echo energies and labels of one ping by beam and range bin: output of engines, input of receivers.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "insonify/ground_truth.h"
#include "insonify/zeroed_memory.h"

namespace insonify {

/// Path orders kept apart: 1 (primary, after one surface), 2 (secondary), 3.
inline constexpr int kPathOrders = 3;

/// Means "no label" in the label layers.
inline constexpr std::uint16_t kNoLabel = 0xffff;

/// A single echo with an exact bearing and phase, such as that of an ideal point. Cells hold sums over many echoes.
struct DiscreteEcho {
  int beam = 0, bin = 0;
  int order = 1;           ///< Path order: surfaces met; 0 for a pulse that is no echo (interference).
  float bearing_sine = 0;  ///< u, sine of the bearing of arrival.
  float intensity = 0;     ///< Relative to the source's at 1 m.
  float turns = 0;         ///< Phase [turns of 2 pi], 0..1.
};

/// Echo energy of one surface in a cell.
struct SurfaceEcho {
  std::uint32_t surface = 0xffffffff;  ///< Instance and material, see echo/grid/echo.h; all ones for none.
  float energy = 0;
  float elevation_moment = 0;  ///< Sum of energy x elevation, from the middle of the aperture [rad].
  float elevation_square = 0;  ///< Sum of energy x its square [rad^2].
};

/// Surfaces that a cell records separately with GroundTruth::kFull: one cache line.
inline constexpr int kSurfacesKept = 4;
using SurfaceTally = std::array<SurfaceEcho, kSurfacesKept>;

/// Bins [first, last).
struct BinRange {
  int first = 0, last = 0;

  [[nodiscard]] bool empty() const { return first >= last; }
  [[nodiscard]] bool has(int bin) const { return bin >= first && bin < last; }
  /// Intersection.
  [[nodiscard]] BinRange operator&(const BinRange& other) const {
    return {std::max(first, other.first), std::min(last, other.last)};
  }
  /// Smallest interval that contains both.
  [[nodiscard]] BinRange operator|(const BinRange& other) const {
    return empty() ? other : other.empty() ? *this : BinRange{std::min(first, other.first), std::max(last, other.last)};
  }
};

/// Sums over echoes in cells of beam x bin. Layers are beam-major: the bins of one beam are contiguous.
///
/// `energy` and `weight` are separate for each path order. In the `paper` model they are the sums of shaped echo
/// strengths and of sample weights, and their ratio is the mean that the paper displays (docs/concepts/paper-model.md).
/// The label layers say which surface each cell's energy came from: the instance and material that gave the majority of
/// it, and the energy-weighted mean elevation of that majority. With GroundTruth::kFull each cell also has a tally of
/// its surfaces.
class EchoGrid {
 public:
  EchoGrid() = default;
  /// @param labelled  Whether label layers are kept even with GroundTruth::kNone.
  EchoGrid(int beam_count, int bin_count, int order_count, GroundTruth ground_truth = GroundTruth::kLabels,
           bool labelled = false);

  [[nodiscard]] int beam_count() const { return beam_count_; }
  [[nodiscard]] int bin_count() const { return bin_count_; }
  [[nodiscard]] int order_count() const { return order_count_; }
  [[nodiscard]] GroundTruth ground_truth() const { return ground_truth_; }
  [[nodiscard]] bool labelled() const { return labelled_; }  ///< Whether there are label layers.

  /// One beam of one layer: bin_count values. `order` counts from 1.
  [[nodiscard]] std::span<const float> energy(int order, int beam) const {
    return {&energy_[start(order, beam)], length()};
  }
  [[nodiscard]] std::span<const float> weight(int order, int beam) const {
    return {&weight_[start(order, beam)], length()};
  }

  /// Smallest interval that contains all bins of a beam requested with to_fill(); bins outside it are empty in all
  /// layers.
  [[nodiscard]] BinRange filled(int beam) const { return filled_[beam]; }

  /// The surface that gave the majority of a cell's energy; defaults where there are no labels.
  struct Label {
    std::uint16_t instance = kNoLabel;  ///< Index into Scene::instances.
    std::uint16_t material = kNoLabel;  ///< Index into Scene::materials.
    float elevation = 0;                ///< Mean over the energy of that label [rad].
  };
  [[nodiscard]] Label label(int beam, int bin) const;

  /// Cells of one beam to be added to: pointers to the first of them, null for layers that are not kept. The label
  /// layers are a majority vote weighted by energy. Where nothing echoed, only `surface` means anything.
  struct Cells {
    float* energy = nullptr;
    float* weight = nullptr;
    std::uint32_t* surface = nullptr;   ///< Instance and material, see echo/grid/echo.h; all ones where nothing echoed.
    float* lead = nullptr;              ///< Energy by which the label leads all others together.
    float* label_energy = nullptr;      ///< Energy deposited while it led.
    float* elevation_moment = nullptr;  ///< Sum of energy x elevation over that [rad].
    SurfaceTally* tallies = nullptr;    ///< See echo/surface_tally.h; to be emptied where there is no label yet.
  };
  [[nodiscard]] Cells to_fill(int order, int beam, BinRange bins);

  /// The label layers of one beam. They mean nothing outside filled().
  struct LabelRows {
    const std::uint32_t* surface;
    const float* energy;
    const float* elevation_moment;
  };
  [[nodiscard]] LabelRows label_rows(int beam) const {
    const std::size_t cell = start(1, beam);
    return {&surface_[cell], &label_energy_[cell], &elevation_moment_[cell]};
  }

  /// Discrete echoes, which are not in cells. Whoever fills them in clears them first.
  [[nodiscard]] std::vector<DiscreteEcho>& discrete_echoes() { return discrete_echoes_; }
  [[nodiscard]] const std::vector<DiscreteEcho>& discrete_echoes() const { return discrete_echoes_; }

  /// With GroundTruth::kFull only: surfaces of one beam's cells, see echo/grid/surface_tally.h. Not set in cells
  /// without a label.
  [[nodiscard]] std::span<const SurfaceTally> tallies(int beam) const { return {&tallies_[start(1, beam)], length()}; }
  /// With GroundTruth::kFull only: the solid angle of a beam whose first hit is nearer than bin 0 [sr].
  [[nodiscard]] float& met_before(int beam) { return met_before_[beam]; }
  [[nodiscard]] float met_before(int beam) const { return met_before_[beam]; }

  /// Copies cells of another grid of the same size into one beam. Discrete echoes are not copied.
  /// @param sources  For each bin: index beam x bin_count + bin of the cell in `other`, negative for an empty cell.
  void take_cells(const EchoGrid& other, int beam, std::span<const std::int32_t> sources);

  /// Empties the cells of beams [first, last). Each task clears its own beams.
  void clear(int first_beam, int last_beam);
  void clear() { clear(0, beam_count_); }

 private:
  void fill_more(int beam, BinRange bins);
  void set_up(int beam, BinRange bins);
  void take_cell(const EchoGrid& other, std::size_t from, std::size_t to);
  [[nodiscard]] std::size_t length() const { return static_cast<std::size_t>(bin_count_); }
  [[nodiscard]] std::size_t start(int order, int beam) const {
    return (static_cast<std::size_t>(order - 1) * beam_count_ + beam) * bin_count_;
  }

  int beam_count_ = 0, bin_count_ = 0, order_count_ = 0;
  GroundTruth ground_truth_ = GroundTruth::kLabels;
  bool labelled_ = true;
  template <typename Value>
  using Layer = std::vector<Value, ZeroedMemory<Value>>;
  Layer<float> energy_, weight_;  // [order][beam][bin]; zero where nothing is filled.
  // [beam][bin]; set up when they are filled.
  Layer<std::uint32_t> surface_;
  Layer<float> lead_, label_energy_, elevation_moment_;
  Layer<SurfaceTally> tallies_;
  std::vector<float> met_before_;  // [beam]
  std::vector<BinRange> filled_;   // [beam]
  std::vector<DiscreteEcho> discrete_echoes_;
};

inline EchoGrid::Cells EchoGrid::to_fill(int order, int beam, BinRange bins) {
  if (const BinRange filled = filled_[beam]; bins.first < filled.first || bins.last > filled.last) {
    fill_more(beam, bins);
  }
  const std::size_t cell = start(1, beam) + bins.first;
  const std::size_t of_order = start(order, beam) + bins.first;
  Cells cells;
  cells.energy = &energy_[of_order];
  cells.weight = &weight_[of_order];
  if (labelled_) {
    cells.surface = &surface_[cell];
    cells.lead = &lead_[cell];
    cells.label_energy = &label_energy_[cell];
    cells.elevation_moment = &elevation_moment_[cell];
  }
  if (ground_truth_ == GroundTruth::kFull) {
    cells.tallies = &tallies_[cell];
  }
  return cells;
}

/// Receives the beams of a grid as soon as they are complete, while their cells are still in the cache.
class BeamSink {
 public:
  virtual ~BeamSink() = default;

  /// Beams [first, last) are complete. Called once for every beam of a ping, by several threads at a time.
  virtual void take(int first_beam, int last_beam) = 0;
};

}  // namespace insonify
