// gain_matrix.h -- sums over the cells of a bearing grid, with a gain for each beam and cell: a matrix product made for
// rows of bins.

#pragma once

#include <vector>

namespace insonify {

/// Gains of beams by cells, where cells that a beam does not hear are left out at both ends of its row.
class GainMatrix {
 public:
  GainMatrix() = default;
  GainMatrix(int beam_count, int cell_count);

  [[nodiscard]] int beam_count() const { return beam_count_; }
  [[nodiscard]] int cell_count() const { return cell_count_; }

  void set(int beam, int cell, float gain);
  [[nodiscard]] float get(int beam, int cell) const;

  /// Leaves out the cells outside [first, last) of a beam; beams share blocks, and hear what any of their block does.
  void limit(int beam, int first, int last);

  /// Cells that the product visits over all there are, 0..1.
  [[nodiscard]] double filled() const;

  /// beams[b][v] = sum over cells c of gain(b, c) cells[c][v], for v in [first, last). Each sum runs in the order of
  /// the cells, whatever the interval. Allocates nothing.
  /// @param cells   [cell][stride]
  /// @param beams   [beam][stride]
  void multiply(const float* cells, float* beams, int stride, int first, int last) const;

  /// The same with the values of each cell times i, of pairs (a, b) (-b, a), added to what the beams hold.
  /// @param first  Even.
  void add_turned(const float* cells, float* beams, int stride, int first, int last) const;

 private:
  struct Band {
    int first = 0, last = 0;
  };
  [[nodiscard]] std::size_t place(int beam, int cell) const;
  template <bool turned>
  void add_product(const float* cells, float* beams, int stride, int first, int last) const;

  int beam_count_ = 0, cell_count_ = 0;
  std::vector<float> gains_;  // [block][cell][beam of block]
  std::vector<Band> bands_;   // One a block.
};

}  // namespace insonify
