// point_echoes.h -- echoes of ideal point targets.

#pragma once

#include <span>

#include "echo/batch/echo_source.h"
#include "echo/targets/lines_of_sight.h"
#include "insonify/point_target.h"

namespace insonify {

/// Phase of the own reflection of Scenario::points[point], drawn from the seed [turns]. Other sources need a stream of
/// their own.
double own_phase(const FlatPlan& plan, std::size_t point);

/// Adds a discrete echo, unless its range is outside the range window.
/// @param order      Number of surfaces on the path.
/// @param range      True range [m].
/// @param intensity  Relative to the source's at 1 m.
/// @param turns      Phase in full turns.
void add_discrete_echo(const FlatPlan& plan, const FlatPlan::Arrival& arrival, int order, double range,
                       double intensity, double turns, EchoList& echoes);

/// Echoes of points, as discrete echoes: TS - 40 log10 r - 2 alpha r relative to the source
/// level, times the two-way elevation pattern. Calibrated model only. The phase is that of the path plus own_phase().
/// Points behind an opaque surface or outside the sonar's beams give no echo.
class PointEchoes final : public EchoSource {
 public:
  explicit PointEchoes(std::span<const PointTarget> points);

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  std::span<const PointTarget> points_;
  LinesOfSight lines_;
};

}  // namespace insonify
