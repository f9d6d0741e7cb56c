// surface_ghosts.h -- echoes of points by way of the water's surface.

#pragma once

#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/grid/echo.h"
#include "echo/model/ping_plan.h"
#include "insonify/point_target.h"

namespace insonify {

/// Adds the echoes of points by way of the water's surface to a grid of the calibrated model as discrete echoes: image
/// method, Brekhovskikh and Lysanov, Fundamentals of Ocean Acoustics, ch. 5. With the distances r1 to the point and r2
/// to its image, the point's target strength TS (linear) and |R|^2 of the surface at their angle, the intensities are
///
///     out by the surface and straight back, and its reciprocal:  TS |R|^2 / (r1^2 r2^2)  at range (r1 + r2) / 2, each;
///     out and back by the surface:                               TS |R|^4 / r2^4         at range r2,
///
/// times absorption and elevation pattern. Each reflection by the surface changes the phase by half a turn. The two
/// reciprocal echoes have equal phases, without waves that of their path length. Waves break each echo up into many
/// glints, whose sum has a random phase and an exponentially distributed intensity, drawn anew for each ping.
class SurfaceGhosts {
 public:
  struct Surface {
    double level;        ///< World z [m].
    SurfaceLabel label;  ///< Its material in the plan.
    bool waves;          ///< Whether there are any.
  };
  SurfaceGhosts(std::span<const PointTarget> points, const Surface& surface);

  /// Adds the echoes that `secondary` and `max_surfaces` of the plan allow. Allocates nothing else.
  /// @param number  Of the ping.
  /// @param phases  Whether phases count (ReceiverConfig::speckle): then waves make phase and intensity random.
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::uint64_t number, bool phases, Engine& engine,
           EchoGrid& grid);

 private:
  // Rays per point: sonar to point, sonar to the reflection on the surface, and from there to the point.
  static constexpr std::size_t kRaysPerPoint = 3;

  void trace(const Vec3& sonar, Engine& engine);
  void add_point(const PingPlan& plan, const Pose& world_from_sonar, std::size_t point, std::uint64_t number,
                 EchoGrid& grid) const;
  // Effect of waves on an echo: a factor on its intensity and an addition to its phase.
  struct Glint {
    double intensity, turns;
  };
  [[nodiscard]] Glint glint(const PingPlan& plan, std::size_t point, int order, std::uint64_t number) const;

  std::span<const PointTarget> points_;
  Surface surface_;
  bool glints_ = false;    // Whether phase and intensity are random.
  std::vector<Ray> rays_;  // [point][ray]
  std::vector<Hit> hits_;
};

}  // namespace insonify
