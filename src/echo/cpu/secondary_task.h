// secondary_task.h -- computes the secondary echoes of a few neighbouring beams, in packets of sixteen rays.

#pragma once

#include <vector>

#include "echo/cpu/cpu_scene.h"
#include "echo/cpu/ray_packet.h"
#include "echo/cpu/reflected_rays.h"
#include "echo/cpu/water_returns.h"
#include "echo/grid/echo_grid.h"
#include "echo/mirror/mirror_paths.h"
#include "echo/mirror/secondary_echo.h"
#include "echo/model/flat_plan.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// Where a ping's sonar is.
struct PlacedSonar {
  Vec3f position;                ///< Relative to the scene's origin [m].
  Eigen::Matrix3f axes;          ///< Its axes as columns: forward, port and up.
  const Refraction* refraction;  ///< How the water bends rays; null: they are straight.
};

/// Traces reflected rays from selected hits, and return legs from the surfaces they hit back to the sonar.
class SecondaryTask {
 public:
  /// Copies of the packets that were traced, for Engine::time_traversal().
  struct Log {
    std::vector<RayPacket> reflected, back;
  };

  explicit SecondaryTask(const CpuScene& scene);

  /// @param arrivals  Receives echoes that may arrive in any beam.
  /// @param log       May be null.
  void start(const FlatPlan& plan, const PlacedSonar& sonar, EchoGrid& grid, std::vector<Echo>& arrivals, Log* log);

  /// Traces reflected rays from the selected hits of a strip, tile by tile, so that the rays of a packet are close
  /// together. Echoes are deposited whenever a packet of return legs is full.
  /// @param strip         Its first column; the same sample of the next is `stride` values further.
  /// @param first_column  Column of the lattice.
  void reflect(const HitColumn& strip, int stride, int first_column, int columns);

  /// Traces the packets that are not full yet, and deposits their echoes.
  void finish();

  void reset_counts() {
    sent_ = returned_ = 0;
    by_water_.reset_counts();
  }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }                             ///< Reflected rays.
  [[nodiscard]] std::uint64_t returned() const { return returned_ + by_water_.sent(); }  ///< Return legs.

 private:
  void cull_and_trace(const HitColumn& strip);
  unsigned turn_to_facets_and_edges(const HitColumn& strip, int count, const Mirrors& mirrors, EdgeLanes& edges);
  void collect(unsigned lanes);
  void find_edges(const HitColumn& strip, int count, EdgeLanes& edges);
  void compute_ray_tubes(const HitColumn& strip, unsigned lanes);
  void trace_collected();
  void trace(RayPacket& packet, const ReflectedOrigins& origins, unsigned lanes);
  void return_shaped(const RTCRay16& rays, const ReflectedOrigins& origins, unsigned lanes);
  void return_mirrored(const RTCRay16& rays, const ReflectedOrigins& origins, unsigned lanes);
  void send_back(const Vec3f& point, const Vec3f& direction, float distance);
  [[nodiscard]] float interference(const RTCRay16& rays, const ReflectedOrigins& origins, const MirrorPaths& paths,
                                   int lane) const;
  void return_by_water(const RTCRay16& rays, const ReflectedOrigins& origins, int lane, const Echo& echo);
  void finish_returns();

  RayPacket candidates_, reflected_, back_;
  CpuScene::Shading shading_;
  ReflectedOrigins candidate_origins_, origins_;

  WaterReturns by_water_;
  const CpuScene& scene_;
  const FlatPlan* plan_ = nullptr;
  Vec3f sonar_;
  Eigen::Matrix3f axes_;
  const Refraction* refraction_ = nullptr;
  EchoGrid* grid_ = nullptr;
  std::vector<Echo>* arrivals_ = nullptr;
  Log* log_ = nullptr;

  // Candidates for reflected rays: indices in the strip of the hit, and of its neighbours in the column and in the next
  // column. A neighbour on another surface is replaced by the hit itself.
  int place_[kPacketSize], above_[kPacketSize], aside_[kPacketSize];
  int candidate_count_ = 0, reflected_count_ = 0;
  int unculled_ = 0;             // Number of packets still to be passed without a test against the boxes.
  Echo returning_[kPacketSize];  // Echoes whose return legs are in back_.
  float returning_strength_[kPacketSize], returning_rest_[kPacketSize];  // `paper`: see secondary_powers().
  Echo arriving_[kPacketSize];  // `calibrated`: their reciprocals, which arrive from the second surface.
  int returning_count_ = 0;
  std::uint64_t sent_ = 0, returned_ = 0;
};

}  // namespace insonify
