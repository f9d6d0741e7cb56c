// point_ghosts.h -- echoes of points by way of plane mirrors: the water's surface and flat faces of the scene.

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/grid/echo.h"
#include "echo/model/ping_plan.h"
#include "echo/targets/plane_mirrors.h"
#include "echo/targets/sight_rays.h"
#include "insonify/point_target.h"

namespace insonify {

/// Adds the echoes of points by way of plane mirrors to a grid of the calibrated model as discrete echoes: image
/// method, Brekhovskikh and Lysanov, Fundamentals of Ocean Acoustics, ch. 5. Between the sonar and a point there are
/// the straight leg and one by each mirror. With their lengths r and the point's target strength TS (linear), a path
/// out by leg i and back by leg j has the intensity
///
///     TS g_i g_j,   g = W / r^2,   at range (r_i + r_j) / 2
///
/// times absorption and elevation pattern; where i and j differ it comes with its reciprocal, of equal phase. W is 1 of
/// the straight leg and |R|^2 of the water's surface. Of a flat face it is the share |R|^2 e^-g that is coherent,
/// reduced to (A cos / (lambda r1 r2 / (r1 + r2)))^2 where the face is smaller than its Fresnel zone. Each reflection
/// by the surface changes the phase by half a turn. Waves break each echo up into many glints, whose sum has a random
/// phase and an exponentially distributed intensity, drawn anew for each ping.
class PointGhosts {
 public:
  struct Surface {
    double level;        ///< World z [m].
    SurfaceLabel label;  ///< Its material in the plan.
    bool waves;          ///< Whether there are any.
  };
  static constexpr std::size_t kMostFaces = 16;  ///< By which a point has ghosts: the largest that count.

  /// @param faces  Of what does not move; null for none.
  PointGhosts() = default;
  PointGhosts(std::span<const PointTarget> points, const std::optional<Surface>& surface,
              std::shared_ptr<const std::vector<PlaneMirror>> faces);

  /// Adds the echoes that `secondary` and `max_surfaces` of the plan allow. Allocates nothing else.
  /// @param number  Of the ping.
  /// @param phases  Whether phases count (ReceiverConfig::speckle): then waves make phase and intensity random.
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::uint64_t number, bool phases, Engine& engine,
           EchoGrid& grid);

 private:
  // A way between the sonar and a point.
  struct Leg {
    int mirror = kStraight;  // Index into `faces_`, kStraight or kWater.
    std::size_t point = 0;
    std::size_t ray = 0;  // The first of its rays, which must be clear: one, or two by a mirror.
    Vec3 image;           // Mirror image of the point, in the world [m].
    double bounce = 0;    // Length from the sonar to the mirror [m].
  };
  static constexpr int kStraight = -2, kWater = -1;

  // What a leg does to sound.
  struct Way {
    int mirror;
    PingPlan::Arrival arrival;
    double length, intensity, turns;
  };

  void add_legs(const Vec3& sonar, std::size_t point);
  void add_leg_by(const Vec3& sonar, std::size_t point, int mirror, const Vec3& normal, double offset);
  [[nodiscard]] std::optional<Way> way_of(const PingPlan& plan, const Pose& world_from_sonar, const Leg& leg) const;
  void add_echoes(const PingPlan& plan, std::span<const Way> ways, std::size_t point, std::uint64_t number,
                  EchoGrid& grid) const;
  // Effect of waves on an echo: a factor on its intensity and an addition to its phase.
  struct Glint {
    double intensity, turns;
  };
  [[nodiscard]] Glint glint(const PingPlan& plan, std::size_t point, const Way& out, const Way& back,
                            std::uint64_t number) const;

  std::span<const PointTarget> points_;
  std::optional<Surface> surface_;
  std::shared_ptr<const std::vector<PlaneMirror>> faces_;
  bool glints_ = false;  // Whether phase and intensity are random.
  std::vector<Leg> legs_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<SightEnd> ends_;
  SightRays sight_rays_;
};

}  // namespace insonify
