// defocused_tables.h -- patterns of an array out of focus, tabulated once for all beams and ranges.

#pragma once

#include <complex>
#include <map>
#include <span>
#include <vector>

#include "insonify/array_pattern.h"

namespace insonify {

/// ArrayPattern::defocused() at many edge phases. Beams and ranges with almost the same edge phase share a table, so
/// that tables grow with the array's length in wavelengths, not with its square.
///
/// A table has g(x) at points of 1/40 (two way 1/80), interpolated linearly between them, up to the distance beyond
/// which side lobes are those in focus; these are in a table that all phases share. Amplitudes are within kError of the
/// pattern's for the table's phase.
class DefocusedTables {
 public:
  /// Tables are this far apart in edge phase [rad], relative to it above 1 rad.
  static constexpr double kPhaseStep = 0.02;
  static constexpr double kError = 1e-3;  ///< Relative to the main lobe in focus: 0.009 dB. Where the side lobes in
                                          ///< focus begin, it is smooth over 3 in x; ArrayPattern has a step.

  /// @param elements  Number of the array's elements, after which the pattern repeats, for an even number with the
  /// other
  ///                  sign; 0 for a line.
  /// @param reach     Largest |x| that is asked for.
  /// @param floor     Intensity for extent_of(), re the main lobe in focus.
  DefocusedTables(const ArrayPattern& pattern, int elements, double reach, double floor);

  /// Number of the table for an edge phase, which is computed if it is new.
  int table_for(double edge_phase);

  /// g(x) by a table; |x| up to the reach.
  [[nodiscard]] std::complex<float> amplitude(int table, double x) const;

  /// g(place - steered) of each place, times its factor, as real and imaginary parts.
  void look_up(int table, double steered, std::span<const float> places, std::span<const float> factors,
               float* in_phase, float* quadrature) const;

  /// Interval of x beyond which a pattern's intensity stays below the floor; low > high where it always does.
  struct Extent {
    double low, high;
  };
  [[nodiscard]] Extent extent_of(int table) const { return tables_[table].extent; }

  [[nodiscard]] std::size_t value_count() const { return points_.size(); }  ///< Complex numbers in all tables.

 private:
  struct Table {
    float reach;              // |x| up to which its own points are used.
    int middle;               // Its own point x = 0 in `points_`.
    std::complex<float> far;  // Factor of the points in focus beyond.
    Extent extent = {1, 0};
  };
  [[nodiscard]] int add_points(const ArrayPattern& pattern, double reach);
  [[nodiscard]] Extent measured(int table) const;

  ArrayPattern pattern_;
  float period_;  // In x; 0 for a line.
  double reach_, floor_;
  double within_;     // Reach within a period.
  double density_;    // Points per unit of x.
  bool alternating_;  // Whether the pattern's sign changes from period to period.
  std::vector<std::complex<float>> points_;
  int in_focus_;  // Point x = 0 of the array in focus.
  std::vector<Table> tables_;
  std::map<long, int> numbers_;  // Index by steps of phase.
};

}  // namespace insonify
