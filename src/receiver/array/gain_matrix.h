// gain_matrix.h -- banded matrix of gains, beams x cells, and its product with rows of bins.

#pragma once

#include <vector>

#include "echo/batch/reception.h"

namespace insonify {

/// A matrix of real gains, beam_count x cell_count. Each row has a band of cells; gains outside it count as zero and
/// are skipped. Rows are stored in blocks of kBlockBeams beams that share one band.
class GainMatrix {
 public:
  static constexpr int kBlockBeams = GainTable::kBlockBeams;

  GainMatrix() = default;
  GainMatrix(int beam_count, int cell_count);

  /// Changes the shape and empties all bands; gains within them are undefined until set. Allocates nothing where the
  /// matrix has been as large before.
  void reshape(int beam_count, int cell_count);

  [[nodiscard]] int beam_count() const { return beam_count_; }
  [[nodiscard]] int cell_count() const { return cell_count_; }

  void set(int beam, int cell, float gain);
  [[nodiscard]] float get(int beam, int cell) const;

  /// The gains of one beam, kBlockBeams apart from cell to cell.
  [[nodiscard]] float* row(int beam) { return &gains_[place(beam, 0)]; }

  /// Extends the band of the beam's block to include the cells [first, last). Bands are empty at first. A band is
  /// shared by the beams of a block, so gains of a beam outside its own limits may still be used.
  void limit(int beam, int first, int last);

  /// All gains and bands, which refer to this object.
  [[nodiscard]] GainTable table() const;

  /// Fraction of the matrix inside the bands, 0..1.
  [[nodiscard]] double filled() const;

  /// beams[b][v] = sum over cells c of gain(b, c) cells[c][v], for v in [first, last). Terms are added in the order of
  /// the cells, so that results do not depend on how v is divided between calls. Allocates nothing.
  /// @param cells   [cell][stride]
  /// @param beams   [beam][stride]
  void multiply(const float* cells, float* beams, int stride, int first, int last) const;

  /// beams += gains x (i x cells), where each pair of values is a complex number: (a, b) is replaced by (-b, a).
  /// @param first  Even: the real part of a value.
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
  std::vector<Band> bands_;   // [block]: cells [first, last).
};

}  // namespace insonify
