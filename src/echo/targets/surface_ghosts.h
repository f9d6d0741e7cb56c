// surface_ghosts.h -- points mirrored in the sea's surface.

#pragma once

#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/grid/echo.h"
#include "echo/model/ping_plan.h"
#include "insonify/point_target.h"

namespace insonify {

/// The echoes of points by way of the sea's surface, after the image method (Brekhovskikh and Lysanov, Fundamentals of
/// Ocean Acoustics, ch. 5), as discrete echoes of a grid of the calibrated model. With r1 to the point, r2 to its image
/// and |R|^2 of the surface:
///
///     out by the surface and straight back, and its reciprocal:  TS |R|^2 / (r1^2 r2^2)  at (r1 + r2) / 2, each;
///     out and back by the surface:                               TS |R|^4 / r2^4         at r2,
///
/// with absorption and the elevation pattern on their ways. The surface turns the phase by half a turn each time. Both
/// reciprocal echoes have the same phase: without wind it is that of their way. Waves break each ghost up into many
/// glints, whose sum has a random phase and an exponential intensity about the mean, drawn anew for each ping.
class SurfaceGhosts {
 public:
  struct Surface {
    double level;        ///< Height in the world [m].
    SurfaceLabel label;  ///< What the plan knows it by.
    bool glints;         ///< Whether there are waves, and phases count.
  };
  SurfaceGhosts(std::span<const PointTarget> points, const Surface& surface);

  /// Adds to the grid's discrete echoes what the plan's secondary echoes and surfaces allow. Allocates nothing else.
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::uint64_t number, Engine& engine, EchoGrid& grid);

 private:
  // Straight to the point, to the surface on the way to its image, and on from there.
  static constexpr std::size_t kWays = 3;

  void trace(const Vec3& sonar, Engine& engine);
  void add_point(const PingPlan& plan, const Pose& sonar_from_world, std::size_t point, std::uint64_t number,
                 EchoGrid& grid) const;
  // What waves make of an echo.
  struct Glint {
    double intensity, turns;  // Times, plus.
  };
  [[nodiscard]] Glint glint(const PingPlan& plan, std::size_t point, int order, std::uint64_t number) const;

  std::span<const PointTarget> points_;
  Surface surface_;
  std::vector<Ray> rays_;  // [point][way]
  std::vector<Hit> hits_;
};

}  // namespace insonify
