// beam_task.h -- computes the echoes of a few neighbouring beams; holds the scratch memory of one worker.

#pragma once

#include <vector>

#include "base/parallel.h"
#include "echo/cpu/beam_tasks.h"
#include "echo/cpu/cpu_scene.h"
#include "echo/cpu/fan_raster.h"
#include "echo/cpu/ray_packet.h"
#include "echo/cpu/secondary_task.h"
#include "echo/grid/surface_run.h"
#include "echo/model/flat_plan.h"
#include "echo/model/hit_column.h"
#include "echo/model/left_out.h"
#include "echo/model/normal_turns.h"

namespace insonify {

/// The scratch memory of one worker, and the ping's steps for neighbouring beams.
struct BeamTask {
  BeamTask(const CpuScene& scene, const RasterScene& raster_scene, const Workers& workers)
      : scene_(scene), raster_scene_(raster_scene), workers_(workers), raster_(workers), secondary_(scene) {}

  /// Prepares for a ping. Allocates only if it needs more memory than any ping before.
  /// @param refraction  How the water bends rays; null: they are straight.
  /// @param left_out    Parts whose primary echoes are left out; null: none.
  void prepare(const FlatPlan& plan, SecondarySampling sampling, const Refraction* refraction, const LeftOut* left_out);

  /// Fills the beams [first_beam, last_beam) of the grid.
  /// @param view      The visible part of the raster scene, to rasterise primaries; null to ray-trace them.
  /// @param arrivals  Receives echoes that may arrive in beams of other tasks, for deposit().
  /// @param log       Receives the packets of reflected rays and return legs, unless null.
  void run(const Pose& world_from_sonar, int first_beam, int last_beam, const FanView* view, EchoGrid& grid,
           std::vector<Echo>& arrivals, SecondaryTask::Log* log = nullptr);

  /// Traces the primary rays of the beams and nothing else, see Engine::time_traversal().
  void trace_only(const Pose& world_from_sonar, int first_beam, int last_beam);

  /// Numbers of rays since prepare().
  [[nodiscard]] RayCounts counts() const { return {primary_count_, secondary_.sent(), secondary_.returned()}; }

 private:
  void aim(const Pose& world_from_sonar, int first_beam, int last_beam);
  void aim_strip(int first_column);
  int load_tile(int first_column, int first_row);
  bool read_tile(int first_row);
  void trace_strip(int first_column);
  bool trace_behind(int columns);
  bool read_tile_behind(int columns, int first_row, int rows);
  void deposit_strip(int first_column, int columns, SecondarySampling sampling, EchoGrid& grid);
  void read_strip(int first_column);
  void add_relief(const HitColumn& hits);

  const CpuScene& scene_;
  const RasterScene& raster_scene_;
  const Workers& workers_;  // Asked whether to stop.
  FanRaster raster_;
  const FlatPlan* plan_ = nullptr;
  const Refraction* refraction_ = nullptr;
  const LeftOut* left_out_ = nullptr;
  SecondarySampling sampling_ = SecondarySampling::kNone;
  int first_column_ = 0, columns_ = 0;  // Columns of the lattice; columns below count from first_column_.
  Vec3f sonar_;                         // Position relative to the scene's origin [m].
  Eigen::Matrix3f sonar_axes_;          // Forward, port and up, as columns.
  std::vector<ColumnAxes> axes_;        // [column]
  HitStrip strip_{kTile, 0};            // A strip is kTile columns that are traced and shaded together.
  HitColumn hits_[kTile] = {};          // Columns of the strip.
  static_assert(kTile == NormalTurns::kColumns && kLeastBeamsTogether % NormalTurns::kColumns == 0);
  NormalTurns turns_;
  FootprintSegments segments_;
  SurfaceSums sums_;

  std::uint64_t primary_count_ = 0;
  ReliefLanes reliefs_;  // Relief at the packet's hits.
  RayPacket primary_;
  CpuScene::Shading shading_;
  SecondaryTask secondary_;
};

}  // namespace insonify
