// echo_grid.h -- echo energies and labels of one ping by beam and range bin: output of engines, input of receivers.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/ground_truth.h"

namespace insonify {

/// Allocates memory that the system has zeroed, and default-constructs elements without touching it: std::vector(count)
/// costs neither time nor physical memory for pages that are never written. Elements made without a value therefore
/// rely on the memory being zero, so a vector with this allocator must not shrink and grow again.
template <typename Value>
struct ZeroedMemory {
  using value_type = Value;

  ZeroedMemory() = default;
  template <typename Other>
  explicit ZeroedMemory(const ZeroedMemory<Other>&) {}

  [[nodiscard]] Value* allocate(std::size_t count) {
    void* memory = std::calloc(count, sizeof(Value));
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    return static_cast<Value*>(memory);
  }
  void deallocate(Value* memory, std::size_t) { std::free(memory); }

  template <typename Other>
  void construct(Other*) noexcept {}
  template <typename Other, typename... Arguments>
  void construct(Other* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }

  bool operator==(const ZeroedMemory&) const = default;
};

struct SurfaceSums;

/// Sums over the echoes of one surface in one cell.
struct SurfaceEcho {
  SurfaceLabel surface = kNoSurface;
  float energy = 0;
  float elevation_moment = 0;  ///< Sum of energy x elevation [rad].
  float elevation_square = 0;  ///< Sum of energy x (elevation - middle of the aperture)^2 [rad^2]; only with
                               ///< GroundTruth::kFull.
};

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
/// `energy` and `weight` are kept per path order. In the `paper` model they are the sum of the shaped echo intensities
/// and of the weights of their samples; their ratio is the mean in the paper's eq. (energy_norm).
///
/// With labels, energy is also summed per surface, over all path orders. The label of a cell is the surface with the
/// most energy there (of equal ones, that with the lower SurfaceLabel), and the mean elevation of that energy. Apart
/// from the rounding of sums it does not depend on the order in which echoes arrive. The strongest surface of each cell
/// so far is in layers of its own; the others of a beam are in a list, since most cells have one surface only.
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

  /// Pointers to neighbouring cells of one beam that echoes are added to; null for layers that are not kept. The last
  /// four layers describe the strongest surface of each cell so far. Where `surface` is kNoSurface, the other three are
  /// not set.
  struct Cells {
    float* energy = nullptr;
    float* weight = nullptr;
    SurfaceLabel* surface = nullptr;  ///< kNoSurface where nothing echoed.
    float* surface_energy = nullptr;
    float* elevation_moment = nullptr;  ///< See SurfaceEcho.
    float* elevation_square = nullptr;  ///< With GroundTruth::kFull only.
  };
  [[nodiscard]] Cells to_fill(int order, int beam, BinRange bins);

  /// Adds the echo of a surface that is not the strongest of its cell so far. If its sum is the greatest now, the two
  /// surfaces change places.
  void add_further(int beam, int bin, const SurfaceEcho& echo);

  /// The same for several cells of a beam: adds `sums` wherever their weight is positive, and sets them to zero there.
  void add_further(int beam, BinRange bins, SurfaceLabel surface, SurfaceSums& sums);

  /// Makes room for half as many further surfaces again in each beam as it has now, so that a ping like this one, with
  /// other random numbers, allocates nothing.
  void keep_spare_surfaces();

  /// Calls visit(const SurfaceEcho&) for every surface that echoed in a cell, the strongest first.
  template <typename Visit>
  void for_each_surface(int beam, int bin, Visit&& visit) const;

  /// The label layers of one beam. They mean nothing outside filled().
  struct LabelRows {
    const SurfaceLabel* surface;
    const float* energy;
    const float* elevation_moment;
  };
  [[nodiscard]] LabelRows label_rows(int beam) const {
    const std::size_t cell = start(1, beam);
    return {&surface_[cell], &label_energy_[cell], &elevation_moment_[cell]};
  }

  /// Discrete echoes, which are not part of the cells. clear() does not remove them.
  [[nodiscard]] std::vector<DiscreteEcho>& discrete_echoes() { return discrete_echoes_; }
  [[nodiscard]] const std::vector<DiscreteEcho>& discrete_echoes() const { return discrete_echoes_; }

  /// Solid angle of one beam that is blocked by surfaces nearer than bin 0 [sr].
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
  void add_surface(int beam, std::size_t cell, const SurfaceEcho& echo);
  void set_up(int beam, BinRange bins);
  void take_run(const EchoGrid& other, std::size_t from, int beam, BinRange bins);
  [[nodiscard]] SurfaceEcho strongest(std::size_t cell) const {
    return {surface_[cell], label_energy_[cell], elevation_moment_[cell],
            elevation_square_.empty() ? 0.0F : elevation_square_[cell]};
  }
  void set_strongest(std::size_t cell, const SurfaceEcho& echo);
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
  // The strongest surface of each cell, [beam][bin]; set only inside filled().
  Layer<SurfaceLabel> surface_;
  Layer<float> label_energy_, elevation_moment_, elevation_square_;
  Layer<std::uint32_t> further_;  // Index + 1 of the cell's second surface in the beam's list; 0 for none.

  // The other surfaces of a beam's cells: linked lists, one per cell, in one array.
  struct FurtherSurface {
    SurfaceEcho echo;
    std::uint32_t next;  // Index + 1 of the cell's next surface; 0 for none.
  };
  std::vector<std::vector<FurtherSurface>> further_surfaces_;  // [beam]
  std::vector<float> met_before_;                              // [beam]
  std::vector<BinRange> filled_;                               // [beam]
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
    cells.surface_energy = &label_energy_[cell];
    cells.elevation_moment = &elevation_moment_[cell];
  }
  if (ground_truth_ == GroundTruth::kFull) {
    cells.elevation_square = &elevation_square_[cell];
  }
  return cells;
}

template <typename Visit>
void EchoGrid::for_each_surface(int beam, int bin, Visit&& visit) const {
  const std::size_t cell = start(1, beam) + bin;
  if (!filled_[beam].has(bin) || surface_[cell] == kNoSurface) {
    return;
  }
  visit(strongest(cell));
  for (std::uint32_t next = further_[cell]; next != 0;) {
    const FurtherSurface& further = further_surfaces_[beam][next - 1];
    visit(further.echo);
    next = further.next;
  }
}

}  // namespace insonify
