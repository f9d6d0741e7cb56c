// cpu_ping.h -- computes the echoes of one ping on Embree, task by task; holds the scratch memory of its threads.

#pragma once

#include <memory>
#include <vector>

#include "echo/batch/ping_view.h"
#include "echo/cpu/beam_task.h"
#include "echo/cpu/cpu_world.h"
#include "echo/cpu/fan_view.h"
#include "echo/rays/choose_sampling.h"

namespace insonify {

/// A ping is divided into tasks of neighbouring beams. Primary rays are traced in packets of 4 columns by 4 rows, or
/// rasterised; shading is done a column at a time; reflected rays and return legs are collected into packets in the
/// same order. A task writes only its own beams of the grid.
class CpuPing {
 public:
  /// Both arguments must outlive this.
  CpuPing(const CpuWorld& world, Workers& workers);

  /// Fills the grid. The world must be placed, with its raster scene if draws() is true.
  /// @return Rays traced.
  RayCounts insonify(const PingView& view, EchoGrid& grid);

  /// Whether a plan's primaries are rasterised.
  [[nodiscard]] static bool draws(const FlatPlan& plan, const CpuWorld& world);

  /// See Engine::time_traversal().
  [[nodiscard]] std::vector<double> time_traversal(const FlatPlan& plan, const Pose& world_from_sonar, int repetitions);

 private:
  // The visible part of the raster scene if primaries are to be rasterised, else null.
  const FanView* look(const FlatPlan& plan, const Pose& world_from_sonar);

  SecondarySampling choose_sampling(const FlatPlan& plan, const Pose& world_from_sonar, const Refraction* refraction);

  // Calls work(scratch, first_beam, last_beam, task) for every task of a ping.
  template <typename Work>
  void for_each_task(const FlatPlan& plan, SecondarySampling sampling, const Refraction* refraction, Work&& work);
  [[nodiscard]] int task_count() const { return static_cast<int>(first_beams_.size()) - 1; }

  const CpuWorld& world_;
  Workers& workers_;
  FanView view_;
  std::vector<std::unique_ptr<BeamTask>> scratch_;  // [worker]
  std::vector<int> first_beams_;                    // [task] See cut_beams().
  std::vector<std::vector<Echo>> arrivals_;         // [task] Echoes that may arrive in beams of other tasks.
  SamplingProbes probes_;
};

}  // namespace insonify
