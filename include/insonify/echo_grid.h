// echo_grid.h -- what came back of one ping, sorted by beam and range: all that engines give and receivers take.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace insonify {

/// Path orders kept apart: 1 (primary, after one surface), 2 (secondary), 3.
inline constexpr int kPathOrders = 3;

/// Stands for "nothing" in the label layers.
inline constexpr std::uint16_t kNoLabel = 0xffff;

/// Sums over echoes, in cells of beam by bin: beam-major, so that one beam's bins lie together.
///
/// `energy` and `weight` are kept per path order. In the `paper` model they are the sum of the shaped echo intensities
/// and of the sample weights they belong to; their ratio is the mean the paper's eq. (energy_norm) asks for. The label
/// layers tell what each cell's energy came from: the instance and material that hold the majority of it, and the
/// energy-weighted mean elevation of that majority.
class EchoGrid {
 private:
  template <typename Vector>
  auto row(Vector& layer, int order, int beam) const {
    const std::size_t start = (static_cast<std::size_t>(order - 1) * beam_count_ + beam) * bin_count_;
    return std::span(layer).subspan(start, bin_count_);
  }

 public:
  EchoGrid() = default;
  EchoGrid(int beam_count, int bin_count, int order_count);

  [[nodiscard]] int beam_count() const { return beam_count_; }
  [[nodiscard]] int bin_count() const { return bin_count_; }
  [[nodiscard]] int order_count() const { return order_count_; }

  /// One beam of one layer: bin_count values. `order` counts from 1.
  [[nodiscard]] std::span<float> energy(int order, int beam) { return row(energy_, order, beam); }
  [[nodiscard]] std::span<float> weight(int order, int beam) { return row(weight_, order, beam); }
  [[nodiscard]] std::span<const float> energy(int order, int beam) const { return row(energy_, order, beam); }
  [[nodiscard]] std::span<const float> weight(int order, int beam) const { return row(weight_, order, beam); }

  /// What a cell's energy came from.
  struct Label {
    std::uint16_t instance = kNoLabel;  ///< Index into Scene::instances.
    std::uint16_t material = kNoLabel;  ///< Index into Scene::materials.
    float lead = 0;                     ///< Energy by which this label leads all others together (majority vote).
    float energy = 0;                   ///< Energy deposited while this label led.
    float elevation_moment = 0;         ///< Sum of energy x elevation over that [rad].

    [[nodiscard]] float elevation() const { return energy > 0 ? elevation_moment / energy : 0.0F; }  ///< [rad]
  };
  [[nodiscard]] std::span<Label> labels(int beam);
  [[nodiscard]] std::span<const Label> labels(int beam) const;

  /// Sets the cells of beams [first, last) to nothing. Each task clears its own.
  void clear(int first_beam, int last_beam);
  void clear() { clear(0, beam_count_); }

 private:
  int beam_count_ = 0, bin_count_ = 0, order_count_ = 0;
  std::vector<float> energy_, weight_;  // [order][beam][bin]
  std::vector<Label> labels_;           // [beam][bin]
};

}  // namespace insonify
