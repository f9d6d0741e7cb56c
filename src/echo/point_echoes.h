// point_echoes.h -- echoes of ideal point targets.

#pragma once

#include <span>
#include <vector>

#include "echo/ping_plan.h"
#include "insonify/engine.h"
#include "insonify/point_target.h"

namespace insonify {

/// Adds the echoes of points to a grid of the calibrated model: TS - 40 log10 r - 2 alpha r relative to the source, in
/// the cell of their range and bearing, sent and heard by the elevation pattern. Nothing from behind a surface or where
/// the sonar does not hear.
class PointEchoes {
 public:
  explicit PointEchoes(std::span<const PointTarget> points);
  void add(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine, EchoGrid& grid);

 private:
  std::span<const PointTarget> points_;
  std::vector<Ray> rays_;  // From the sonar to each.
  std::vector<Hit> hits_;
};

}  // namespace insonify
