// point_ghosts.h -- multipath echoes of points by plane mirrors: the water's surface and plane faces of the scene.

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "echo/batch/echo_source.h"
#include "echo/grid/echo.h"
#include "echo/model/flat_plan.h"
#include "echo/targets/plane_mirrors.h"
#include "insonify/point_target.h"

namespace insonify {

/// Multipath echoes of points by plane mirrors, as discrete echoes, by the image method
/// (Brekhovskikh and Lysanov, Fundamentals of Ocean Acoustics, ch. 5). Calibrated model only. Between the sonar and a
/// point there are the direct leg and one leg over each mirror. With leg lengths r and the point's target strength TS
/// (linear), a path out by leg i and back by leg j has the intensity
///
///     TS g_i g_j,   g = W / r^2,   at range (r_i + r_j) / 2
///
/// times absorption and elevation pattern. Where i and j differ, the reciprocal path has the same phase and is added
/// too. W is 1 for the direct leg, |R|^2 for the water's surface, and for a plane face the coherent reflectance |R|^2
/// e^-g, times (A cos / (lambda r1 r2 / (r1 + r2)))^2 where its area A is smaller than the Fresnel zone. Each
/// reflection at the water's surface shifts the phase by half a turn. Waves break a leg up into many glints: their sum
/// has a random phase and an exponentially distributed intensity, independent from ping to ping. It is the same out and
/// back, so that over waves both ways, where each pair of glints is also passed in the opposite order and in phase, the
/// factor is the square of that of one leg, of the mean 2 (Ishimaru's enhanced backscattering).
class PointGhosts final : public EchoSource {
 public:
  struct Surface {
    double level;        ///< World z [m].
    SurfaceLabel label;  ///< Its material in the plan.
    bool waves;          ///< Whether the surface has waves.
  };
  static constexpr std::size_t kMostFaces = 16;  ///< Most faces over which a point has legs; the largest are taken.

  /// @param faces   Mirrors of the static instances; null for none.
  /// @param phases  Whether echoes have phases (ReceiverConfig::speckle). If so, waves make phase and intensity random.
  PointGhosts(std::span<const PointTarget> points, const std::optional<Surface>& surface,
              std::shared_ptr<const std::vector<PlaneMirror>> faces, bool phases);

  // Finds the echoes that `secondary` and `max_surfaces` of the plan allow.
  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  // A path between the sonar and a point, direct or over one mirror.
  struct Leg {
    int mirror = kStraight;  // Index into `faces_`, kStraight or kWater.
    std::size_t point = 0;
    std::size_t ray = 0;  // Index of its first ray: one ray, or two over a mirror. They must be unobstructed.
    Vec3 image;           // Mirror image of the point, in the world [m].
    double bounce = 0;    // Length from the sonar to the mirror [m].
  };
  static constexpr int kStraight = -2, kWater = -1;

  // An unobstructed leg with its effect on sound.
  struct Way {
    int mirror;
    FlatPlan::Arrival arrival;
    double length, intensity, turns;
  };

  void add_legs(const Vec3& sonar, std::size_t point, RayList& rays);
  void add_leg_by(const Vec3& sonar, std::size_t point, int mirror, const Vec3& normal, double offset, RayList& rays);
  [[nodiscard]] std::optional<Way> way_of(const PingView& view, const RayAnswers& hits, const Leg& leg) const;
  void add_echoes(const FlatPlan& plan, std::span<const Way> ways, std::size_t point, std::uint64_t number,
                  EchoList& found) const;
  // Effect of waves: factors on the intensity of paths with one leg over the water and with both, and the offset of a
  // leg's phase.
  struct Glint {
    double once, twice, turns;
  };
  [[nodiscard]] Glint glint(const FlatPlan& plan, std::size_t point, std::uint64_t number) const;

  std::span<const PointTarget> points_;
  std::optional<Surface> surface_;
  std::shared_ptr<const std::vector<PlaneMirror>> faces_;
  bool glints_;  // Whether waves randomise phase and intensity.
  std::vector<Leg> legs_;
};

}  // namespace insonify
