// point_echoes.h -- echoes of ideal point targets.

#pragma once

#include <span>

#include "echo/targets/lines_of_sight.h"
#include "insonify/point_target.h"

namespace insonify {

/// Phase of a point's own reflection, drawn from the seed [turns].
double own_phase(const PingPlan& plan, std::size_t point);

/// Adds a discrete echo, unless its range is outside the range window.
/// @param order      Number of surfaces on the path.
/// @param range      True range [m].
/// @param intensity  Relative to the source's at 1 m.
/// @param turns      Phase in full turns.
void add_discrete_echo(const PingPlan& plan, const PingPlan::Arrival& arrival, int order, double range,
                       double intensity, double turns, EchoGrid& grid);

/// Adds the echoes of points to the EchoGrid as discrete echoes: TS - 40 log10 r - 2 alpha r relative to the source
/// level, times the two-way elevation pattern. Calibrated model only. The phase is that of the path plus own_phase().
/// Points behind an opaque surface or outside the sonar's beams give no echo.
class PointEchoes {
 public:
  explicit PointEchoes(std::span<const PointTarget> points);

  /// Adds the echoes of one ping.
  void add(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine, EchoGrid& grid);

 private:
  std::span<const PointTarget> points_;
  LinesOfSight lines_;
};

}  // namespace insonify
