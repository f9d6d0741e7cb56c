// column_arc.h -- along one column of a lattice: where rows are due, and what is sent and heard between them.

#pragma once

#include <vector>

#include "insonify/array_pattern.h"
#include "sonar/elevation_pattern.h"

namespace insonify {

/// The arc of directions of one column, from its lower edge to its upper, in steps that are small beside a side lobe.
class ColumnArc {
 public:
  /// A stretch of elevations and how it is sampled and heard.
  struct Sector {
    double low, high;                 ///< Elevations [rad].
    const ElevationPattern* pattern;  ///< Null: all are sent, heard and sampled evenly.
  };

  /// Lays the arc of a column at a bearing [rad]. Where a cone does not reach the sector it is empty: of no length, at
  /// the elevation nearest to it.
  void lay(BeamShape shape, double bearing, const Sector& sector);

  // Edges of t, the angle along the arc (see Lattice) [rad].
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  /// The t below which a share of the rows lies, 0..1.
  [[nodiscard]] double at_share(double share) const;

  /// Integrals up to t of the solid angle per unit of Lattice::column_measure: of |p|^2 and |p|^4, or of 1.
  [[nodiscard]] double sent_below(double t) const { return integral(sent_, t); }
  [[nodiscard]] double received_below(double t) const { return integral(received_, t); }

 private:
  [[nodiscard]] double integral(const std::vector<double>& sums, double t) const;

  double low_ = 0, high_ = 0;
  std::vector<double> rows_, sent_, received_;  // Below the end of each step.
};

}  // namespace insonify
