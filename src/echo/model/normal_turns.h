// normal_turns.h -- change of the surface normal between neighbouring samples and columns.

#pragma once

#include <span>
#include <vector>

#include "echo/model/flat_plan.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// Fills in the turns of neighbouring columns; holds the scratch memory.
class NormalTurns {
 public:
  static constexpr int kColumns = kTurnColumns;

  /// Prepares for a number of rows. Allocates only if it needs more memory than ever before.
  void prepare(int rows);

  /// Sets HitColumn::curved and the turns: the mean change of the normal to the neighbours on either side. A change is
  /// 0 between neighbours that are not on one smooth surface: of different labels, of normals more than 53 degrees
  /// apart, or the second more than 30 degrees off the tangent plane of the first. The mean is 0 where the surface is
  /// flat on one side, as at the crease between two faces. Samples without a neighbour across, as on a body that is
  /// narrower than two columns or reaches into the strip by one, turn across as much as along: as on a sphere.
  /// @param first  Index of the first column in the lattice, a multiple of kColumns.
  /// @param strip  At most kColumns columns, evaluated up to the same row, with unit normals.
  void find(const FlatPlan& plan, int first, std::span<HitColumn> strip);

 private:
  // Differences of the normals of neighbouring samples, and whether (1 or 0) both lie on one smooth surface. Where they
  // do not, the differences are 0.
  struct Differences {
    float *x, *y, *z, *joined;
    void clear(int rows) const;
  };
  [[nodiscard]] Differences differences(int which);

  // Parts of find(). The first two return the greatest square of a difference.
  float find_up(int rows, std::span<HitColumn> strip);
  float subtract_across(const Lattice& lattice, int first, int rows, std::span<HitColumn> strip);
  void find_side(const Lattice& lattice, int first, int rows, std::span<HitColumn> strip);

  std::size_t stride_ = 0;
  std::vector<float> values_;
};

}  // namespace insonify
