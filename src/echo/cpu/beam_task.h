// beam_task.h -- the echoes of a few neighbouring beams: what one worker does at a time, and the memory it does it in.

#pragma once

#include <vector>

#include "echo/cpu/beam_tasks.h"
#include "echo/cpu/cpu_scene.h"
#include "echo/cpu/fan_raster.h"
#include "echo/cpu/ray_packet.h"
#include "echo/cpu/secondary_task.h"
#include "echo/grid/surface_run.h"
#include "echo/model/hit_column.h"
#include "echo/model/ping_plan.h"

namespace insonify {

struct BeamTask {
  BeamTask(const CpuScene& scene, const RasterScene& raster_scene)
      : scene_(scene), raster_scene_(raster_scene), secondary_(scene) {}

  /// Gets ready for a ping; allocates only when it needs more memory than any before.
  void prepare(const PingPlan& plan, SecondarySampling sampling);

  /// Fills the beams [first_beam, last_beam) of the grid.
  /// @param view  What the ping sees of the raster scene, to draw the primaries; null to trace them.
  /// @param arrivals  Takes echoes that may arrive in beams of other tasks; see deposit().
  void run(const Pose& world_from_sonar, int first_beam, int last_beam, const FanView* view, EchoGrid& grid,
           std::vector<Echo>& arrivals, SecondaryTask::Log* log = nullptr);

  /// Only traces the beams' primary rays: the floor that run() stands on.
  void trace_only(const Pose& world_from_sonar, int first_beam, int last_beam);

  /// Since prepare().
  [[nodiscard]] RayCounts counts() const { return {primary_count_, secondary_.sent(), secondary_.returned()}; }

 private:
  void aim(const Pose& world_from_sonar, int first_beam, int last_beam);
  void aim_strip(int first_column);
  int load_tile(int first_column, int first_row);
  bool read_tile(int first_row);
  void trace_strip(int first_column);
  void read_strip(int first_column);
  void add_relief(const HitColumn& hits);

  const CpuScene& scene_;
  const RasterScene& raster_scene_;
  FanRaster raster_;
  const PingPlan* plan_ = nullptr;
  SecondarySampling sampling_ = SecondarySampling::kNone;
  int first_column_ = 0, columns_ = 0;  // Of the lattice; columns below count from first_column_.
  Vec3f sonar_;                         // Position in the scene's coordinates.
  Eigen::Matrix3f sonar_axes_;          // Forward, port and up, as columns.
  std::vector<ColumnAxes> axes_;        // Of each column.
  HitStrip strip_{kTile, 0};            // Of tiles.
  HitColumn hits_[kTile] = {};          // Of the strip.
  FootprintSegments segments_;
  SurfaceSums sums_;

  std::uint64_t primary_count_ = 0;
  ReliefPoint reliefs_[kPacketSize];  // Of the packet's hits, where there is any.
  RayPacket primary_;
  CpuScene::Shading shading_;
  SecondaryTask secondary_;
};

}  // namespace insonify
