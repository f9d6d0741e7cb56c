// column_arc.h -- cumulative integrals along one lattice column: row density, transmitted and received solid angle.

#pragma once

#include <vector>

#include "insonify/array_pattern.h"
#include "sonar/elevation_pattern.h"

namespace insonify {

/// The arc of directions of one column, from its lower to its upper edge, divided into steps much smaller than a side
/// lobe.
class ColumnArc {
 public:
  /// Computes the arc of a column at a bearing [rad]. Where a cone does not reach the sector of the patterns, the arc
  /// has zero length and lies at the elevation nearest to it.
  void set(BeamShape shape, double bearing, const ElevationPatterns& patterns);

  // Edges of t, the angle along the arc (see Lattice) [rad].
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  /// The t below which a share 0..1 of the rows lies; row density is proportional to the pattern's envelope.
  [[nodiscard]] double at_share(double share) const;

  /// Solid angle below t per unit of Lattice::column_measure, weighted by the gain of transmission, of reception, and
  /// of both; unweighted with top hats.
  [[nodiscard]] double sent_below(double t) const { return integral(sent_, t); }
  [[nodiscard]] double received_below(double t) const { return integral(received_, t); }
  [[nodiscard]] double both_below(double t) const { return integral(both_, t); }

 private:
  [[nodiscard]] double integral(const std::vector<double>& sums, double t) const;

  double low_ = 0, high_ = 0;
  std::vector<double> rows_, sent_, received_, both_;  // Cumulative integrals at the end of each step.
};

}  // namespace insonify
