// beam_task.h -- the echoes of a few neighbouring beams: what one worker does at a time, and the memory it does it in.

#pragma once

#include <vector>

#include "echo/cpu_scene.h"
#include "echo/fan_raster.h"
#include "echo/hit_column.h"
#include "echo/ping_plan.h"
#include "echo/ray_packet.h"
#include "echo/secondary_echo.h"
#include "echo/surface_run.h"

namespace insonify {

/// Most beams that one task takes: a ping is written by ranges, and sixteen beams fill a cache line of it.
inline constexpr int kMostBeamsTogether = 16;

struct BeamTask {
  /// Onward rays and return legs as they were sent, when somebody wants to send them again.
  struct Log {
    std::vector<RayPacket> onward, back;
  };

  BeamTask(const CpuScene& scene, const RasterScene& raster_scene) : scene_(scene), raster_scene_(raster_scene) {}

  /// Gets ready for a plan; allocates only when it needs more memory than any before.
  void prepare(const PingPlan& plan);

  /// Fills the beams [first_beam, last_beam) of the grid.
  /// @param view  What the ping sees of the raster scene, to draw the primaries; null to trace them.
  void run(const Pose& world_from_sonar, int first_beam, int last_beam, const FanView* view, EchoGrid& grid,
           Log* log = nullptr);

  /// Only traces the beams' primary rays: the floor that run() stands on.
  void trace_only(const Pose& world_from_sonar, int first_beam, int last_beam);

  /// Since prepare().
  [[nodiscard]] const RayCounts& counts() const { return counts_; }

  /// Where a packet of onward rays left the first surface.
  struct Origins {
    int column[kPacketSize], row[kPacketSize];  // Of the lattice.
    float range[kPacketSize], strength[kPacketSize], selected[kPacketSize];
  };

 private:
  static constexpr int kTile = 4;  // Columns and rows of a packet: the shape in which sixteen neighbours spread least.

  void aim(const Pose& world_from_sonar, int first_beam, int last_beam);
  void aim_strip(int first_column);
  int load_tile(int first_column, int first_row);
  bool read_tile(int first_row);
  void trace_strip(int first_column);
  void read_strip(int first_column);
  void send_onward(int first_column, EchoGrid& grid, Log* log);
  void trace_onward(EchoGrid& grid, Log* log);
  void finish_returns(EchoGrid& grid, Log* log);

  const CpuScene& scene_;
  const RasterScene& raster_scene_;
  FanRaster raster_;
  const PingPlan* plan_ = nullptr;
  int first_column_ = 0, columns_ = 0;  // Of the lattice; columns below count from first_column_.
  Vec3f sonar_;                         // Position in the scene's coordinates.
  std::vector<ColumnAxes> axes_;        // Of each column.
  HitStrip strip_{kTile, 0};            // Of tiles.
  HitColumn hits_[kTile] = {};          // Of the strip.
  Stretches stretches_;
  SurfaceSums sums_;

  RayPacket primary_, onward_, back_;
  CpuScene::Shading shading_;
  int place_[kPacketSize];  // In the strip, of the hits that are followed.
  Origins origins_;         // Of the rays in onward_.
  int onward_count_ = 0;
  Echo returning_[kPacketSize];  // Met a second surface; their return legs are in back_.
  float returning_strength_[kPacketSize], returning_rest_[kPacketSize];  // See secondary_powers().
  int returning_count_ = 0;
  RayCounts counts_;
};

}  // namespace insonify
