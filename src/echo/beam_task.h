// beam_task.h -- the echoes of a few neighbouring beams: what one worker does at a time, and the memory it does it in.

#pragma once

#include <vector>

#include "echo/cpu_scene.h"
#include "echo/hit_column.h"
#include "echo/ping_plan.h"
#include "echo/ray_packet.h"
#include "echo/secondary_echo.h"
#include "echo/surface_run.h"

namespace insonify {

/// Beams that one task takes: about sixteen columns of the lattice, so that packets fill and tasks are many.
[[nodiscard]] int beams_per_task(const Lattice& lattice);

struct BeamTask {
  /// Onward rays and return legs as they were sent, when somebody wants to send them again.
  struct Log {
    std::vector<RayPacket> onward, back;
  };

  explicit BeamTask(const CpuScene& scene) : scene_(scene) {}

  /// Gets ready for a plan; allocates only when it needs more memory than any before.
  void prepare(const PingPlan& plan);

  /// Fills the beams [first_beam, last_beam) of the grid.
  void run(const Pose& world_from_sonar, int first_beam, int last_beam, EchoGrid& grid, Log* log = nullptr);

  /// Only traces the beams' primary rays: the floor that run() stands on.
  void trace_only(const Pose& world_from_sonar, int first_beam, int last_beam);

  /// Since prepare().
  [[nodiscard]] const RayCounts& counts() const { return counts_; }

 private:
  static constexpr int kTile = 4;  // Columns and rows of a packet: the shape in which sixteen neighbours spread least.

  // One sample that is to be followed beyond its surface.
  struct Sample {
    int column, row;  // Of the strip.
  };

  void aim(const Pose& world_from_sonar, int first_beam, int last_beam);
  int load_tile(int first_column, int first_row);
  void read_tile(int first_column, int first_row);
  void trace_strip(int first_column);
  void send_onward(int first_column, EchoGrid& grid, Log* log);
  void trace_onward(EchoGrid& grid, Log* log);
  void finish_returns(EchoGrid& grid, Log* log);

  const CpuScene& scene_;
  const PingPlan* plan_ = nullptr;
  int first_column_ = 0, columns_ = 0;  // Of the lattice; columns below count from first_column_.
  Vec3f sonar_, up_;                    // Position and z axis of the sonar in the scene's coordinates.
  std::vector<Vec3f> along_;            // Horizontal direction of each column.
  HitColumn hits_[kTile];               // Of one strip of tiles: little enough to stay in the nearest cache.
  Stretches stretches_;
  SurfaceRun run_;

  RayPacket primary_, onward_, back_;
  OnwardOrigin origins_[kPacketSize];  // Of the rays in onward_.
  int onward_count_ = 0;
  Echo returning_[kPacketSize];  // Met a second surface; their return legs are in back_.
  float returning_strength_[kPacketSize], returning_rest_[kPacketSize];  // See secondary_powers().
  int returning_count_ = 0;
  RayCounts counts_;
};

}  // namespace insonify
