// survey_path.h -- the path of a survey in plan: lines and turns as straight pieces and arcs.

#pragma once

#include <vector>

#include "insonify/pattern.h"

namespace insonify {

/// A straight piece or an arc of constant curvature.
struct PathPiece {
  double begin = 0;      ///< Distance along the path to its start [m].
  double length = 0;     ///< [m]
  double x = 0, y = 0;   ///< Its start in the world [m].
  double yaw = 0;        ///< Direction at its start [rad], continuous over turns.
  double curvature = 0;  ///< Positive to port [1/m].
  int line = -1;         ///< Index of the line that it is; -1: a turn or a run-in.
};

struct SurveyPath {
  std::vector<PathPiece> pieces;
  double spacing = 0;  ///< Between lines [m]; 0 for a single one.
  int line_count = 1;

  [[nodiscard]] double length() const { return pieces.back().begin + pieces.back().length; }

  struct Station {
    double x, y, yaw;
    int line;
  };
  /// @param distance  Along the path [m], 0..length().
  [[nodiscard]] Station at(double distance) const;

  /// The piece of a line.
  [[nodiscard]] const PathPiece& line(int index) const;
};

/// Number of lines over an area, spaced so that the area's edges are no further than half of the spacing from a line.
[[nodiscard]] int line_count(const SurveyLines& lines, double spacing);

/// Length of a turn to the next line [m]. Lines at least two radii apart: two quarters of a circle and a straight
/// piece, pi r + (s - 2 r). Nearer ones: the vehicle swings out by an angle a to the other side, turns back by pi + 2 a
/// and comes in by a, with cos a = (2 r + s)/(4 r): r (pi + 4 a), the shortest path of that radius with its three arcs
/// (L. E. Dubins, Am. J. Math. 79(3), 497 (1957)).
[[nodiscard]] double turn_length(double spacing, double radius);

/// The corner beside the start of line 1, in the world [m].
[[nodiscard]] Eigen::Vector2d area_corner(const SurveyLines& lines);

/// @param spacing  From line_spacing().
[[nodiscard]] SurveyPath survey_path(const SurveyLines& lines, double spacing);

}  // namespace insonify
