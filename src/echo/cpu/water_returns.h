// water_returns.h -- echoes out by a mirror and back by the water's surface, in packets of return legs.

#pragma once

#include <vector>

#include "echo/cpu/cpu_scene.h"
#include "echo/cpu/ray_packet.h"
#include "echo/grid/echo_grid.h"
#include "echo/laws/laws.h"
#include "echo/mirror/secondary_echo.h"
#include "echo/mirror/water_path.h"
#include "echo/model/flat_plan.h"

namespace insonify {

/// Connects second hits to the sonar over the water's surface: docs/concepts/multipath.md, "Return over the water's
/// surface".
class WaterReturns {
 public:
  explicit WaterReturns(const CpuScene& scene);

  /// @param sonar, axes, arrivals  As SecondaryTask::start().
  /// @param log  Receives copies of the packets traced; may be null.
  /// @param bent  Whether the water bends rays: then there are no such paths, since the surface is not plane in
  /// apparent
  ///              space.
  void start(const FlatPlan& plan, const Vec3f& sonar, const Eigen::Matrix3f& axes, bool bent, EchoGrid& grid,
             std::vector<Echo>& arrivals, std::vector<RayPacket>* log);

  /// Whether there are such paths at all.
  [[nodiscard]] bool any() const { return any_; }

  /// A second hit.
  struct SecondHit {
    Vec3f mirror, point;        ///< Where both surfaces were hit.
    Vec3f normal;               ///< Normal of the second surface, any length and side.
    Vec3f direction;            ///< In which the sound came, unit length.
    SurfaceLabel surface;       ///< The second surface.
    float texture;              ///< Factor on the amplitude of the second surface.
    float reflected;            ///< share |R|^2 of the mirror.
    float range;                ///< To the mirror [m].
    MirrorChange above, aside;  ///< To the neighbours on the mirror.
    float selected;             ///< HitColumn::selected.
  };
  /// Adds the echoes of a second hit as soon as a packet is full.
  /// @param echo  secondary_echo() of the hit; its weight is that of all hits that it stands for.
  void connect(const SecondHit& hit, int column, int row, const Echo& echo);

  /// Traces the packet that is not full yet.
  void finish();

  [[nodiscard]] std::uint64_t sent() const { return sent_; }  ///< Rays.
  void reset_counts() { sent_ = 0; }

 private:
  RayPacket to_water_, to_sonar_;
  ReciprocalEchoes echoes_[kPacketSize];
  int count_ = 0;
  const CpuScene& scene_;
  const FlatPlan* plan_ = nullptr;
  Vec3 sonar_ = Vec3::Zero();
  Eigen::Matrix3f axes_ = Eigen::Matrix3f::Identity();
  EchoGrid* grid_ = nullptr;
  std::vector<Echo>* arrivals_ = nullptr;
  std::vector<RayPacket>* log_ = nullptr;
  bool any_ = false;
  std::uint64_t sent_ = 0;
};

}  // namespace insonify
