// beam_task.h -- the echoes of a few neighbouring beams: what one worker does at a time, and the memory it does it in.

#pragma once

#include <vector>

#include "echo/cpu_scene.h"
#include "echo/deposit.h"
#include "echo/ping_plan.h"
#include "echo/ray_packet.h"

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
  // What an onward ray remembers of the hit it left.
  struct Origin {
    int column, row;
    float onward, range, weight;
  };

  void aim(const Pose& world_from_sonar, int first_beam, int last_beam);
  int load_tile(int first_column, int first_row);
  void trace_primaries();
  void send_onward(EchoGrid& grid, Log* log);
  void finish_onward(int count, EchoGrid& grid, Log* log);
  [[nodiscard]] HitColumn column_hits(int column);
  [[nodiscard]] int at(int column, int row) const { return column * plan_->lattice.rows + row; }

  const CpuScene& scene_;
  const PingPlan* plan_ = nullptr;
  int first_column_ = 0, columns_ = 0;  // Of the lattice; columns below count from first_column_.
  Vec3f sonar_, up_;                    // Position and z axis of the sonar in the scene's coordinates.
  std::vector<Vec3f> along_;            // Horizontal direction of each column.

  // Of each sample, column by column.
  std::vector<float> range_, normal_x_, normal_y_, normal_z_, normal_along_, normal_across_, normal_up_, facing_,
      reach_, power_;
  std::vector<SurfaceLabel> surface_;

  RayPacket primary_, onward_, back_;
  Origin origins_[kPacketSize];
  RayCounts counts_;
};

}  // namespace insonify
