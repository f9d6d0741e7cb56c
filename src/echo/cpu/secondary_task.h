// secondary_task.h -- the secondary echoes of a few neighbouring beams, sixteen rays at a time.

#pragma once

#include <vector>

#include "echo/cpu/cpu_scene.h"
#include "echo/cpu/ray_packet.h"
#include "echo/cpu/reflected_rays.h"
#include "echo/grid/echo_grid.h"
#include "echo/model/hit_column.h"
#include "echo/model/ping_plan.h"
#include "echo/model/secondary_echo.h"

namespace insonify {

/// Sends rays on from selected hits in the mirror direction, and back from what they meet to the sonar.
class SecondaryTask {
 public:
  /// Reflected rays and return legs as they were sent, when somebody wants to send them again.
  struct Log {
    std::vector<RayPacket> reflected, back;
  };

  explicit SecondaryTask(const CpuScene& scene);

  /// @param sonar     Position in the scene's coordinates.
  /// @param axes      Of the sonar in the scene: forward, port and up, as columns.
  /// @param arrivals  Takes echoes that may arrive in any beam.
  void start(const PingPlan& plan, const Vec3f& sonar, const Eigen::Matrix3f& axes, EchoGrid& grid,
             std::vector<Echo>& arrivals, Log* log);

  /// Follows the selected hits of a strip, in the order of its tiles so that packets stay together. Echoes are
  /// deposited as packets fill.
  /// @param strip         Its first column; the same sample of the next is `stride` values further.
  /// @param first_column  Of the lattice.
  void follow(const HitColumn& strip, int stride, int first_column, int columns);

  /// Deposits what is still on its way.
  void finish();

  void reset_counts() { sent_ = returned_ = 0; }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }          ///< Reflected rays.
  [[nodiscard]] std::uint64_t returned() const { return returned_; }  ///< Return legs.

 private:
  void cull_and_trace(const HitColumn& strip);
  void compute_ray_tubes(const HitColumn& strip, unsigned lanes);
  void trace_collected();
  void trace(RayPacket& packet, const ReflectedOrigins& origins, unsigned lanes);
  void return_shaped(const RTCRay16& rays, const ReflectedOrigins& origins, unsigned lanes);
  void return_mirrored(const RTCRay16& rays, const ReflectedOrigins& origins, unsigned lanes);
  void send_back(const Vec3f& point, const Vec3f& direction, float distance);
  void finish_returns();

  RayPacket candidates_, reflected_, back_;
  CpuScene::Shading shading_;
  ReflectedOrigins candidate_origins_, origins_;

  const CpuScene& scene_;
  const PingPlan* plan_ = nullptr;
  Vec3f sonar_;
  Eigen::Matrix3f axes_;
  EchoGrid* grid_ = nullptr;
  std::vector<Echo>* arrivals_ = nullptr;
  Log* log_ = nullptr;

  // In the strip: of the hits that are followed, and of samples beside them on the same surface, if there are any.
  int place_[kPacketSize], above_[kPacketSize], aside_[kPacketSize];
  int candidate_count_ = 0, reflected_count_ = 0;
  int unculled_ = 0;             // Packets that are yet to be let through without a look.
  Echo returning_[kPacketSize];  // Met a second surface; their return legs are in back_.
  float returning_strength_[kPacketSize], returning_rest_[kPacketSize];  // `paper`: see secondary_powers().
  Echo arriving_[kPacketSize];  // `calibrated`: heard straight from the second surface.
  int returning_count_ = 0;
  std::uint64_t sent_ = 0, returned_ = 0;
};

}  // namespace insonify
