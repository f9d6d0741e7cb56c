// point_echoes.h -- echoes of ideal point targets.

#pragma once

#include <span>

#include "echo/targets/lines_of_sight.h"
#include "insonify/point_target.h"

namespace insonify {

/// The phase that a point gives its echoes, drawn from the seed [turns].
double own_phase(const PingPlan& plan, std::size_t point);

/// Adds a discrete echo that arrives so from a true range [m], unless that is beyond the bins.
/// @param order  Surfaces met.
/// @param turns  Phase.
void add_discrete_echo(const PingPlan& plan, const PingPlan::Arrival& arrival, int order, double range,
                       double intensity, double turns, EchoGrid& grid);

/// The echoes of points, as discrete echoes of a grid of the calibrated model: TS - 40 log10 r - 2 alpha r relative to
/// the source, sent and heard by the elevation pattern, each with the phase of its way there and back and one of its
/// own, drawn from the seed. Nothing from behind a surface or where the sonar does not hear.
class PointEchoes {
 public:
  explicit PointEchoes(std::span<const PointTarget> points);

  /// Adds to the grid's discrete echoes.
  void add(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine, EchoGrid& grid);

 private:
  std::span<const PointTarget> points_;
  LinesOfSight ways_;
};

}  // namespace insonify
