// water_path.h -- path from a second surface over the water's surface to the sonar.

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "echo/grid/echo.h"
#include "echo/model/flat_plan.h"
#include "echo/model/precise_echoes.h"
#include "insonify/scene.h"

namespace insonify {

/// Level and material of the water's surface, in an engine's coordinates.
struct WaterPlane {
  double level = 0;                 ///< z [m].
  SurfaceLabel label = kNoSurface;  ///< kNoSurface if the scene has none.

  /// @param origin  World position that the engine's coordinates are relative to.
  [[nodiscard]] static WaterPlane of(const Scene& scene, const Vec3& origin) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      const Instance& instance = scene.instances[i];
      if (instance.endless && instance.present) {
        return {instance.world_from_mesh.position.z() - origin.z(),
                surface_label(static_cast<std::uint16_t>(i), instance.materials.front())};
      }
    }
    return {};
  }
  [[nodiscard]] bool exists() const { return label != kNoSurface; }

  /// Whether a hit at height z is on the water's surface.
  [[nodiscard]] bool holds(double z) const { return std::abs(z - level) < precise::kLeastDepth; }
};

/// Path from a point to the sonar over the water's surface as a plane mirror, by the sonar's image.
struct WaterPath {
  Vec3 bounce;    ///< Point of reflection.
  Vec3 out;       ///< Unit vector from the point to `bounce`.
  Vec3 arrival;   ///< Unit vector from the sonar to `bounce`.
  double first;   ///< From the point to `bounce` [m].
  double length;  ///< From the point to the sonar [m].
  double near;    ///< water_clearance() [m]
  double share;   ///< Coherent reflectance |R|^2 e^-g of the surface.

  /// None if the point or the sonar is not below the surface, or if waves make `share` negligible.
  [[nodiscard]] static std::optional<WaterPath> of(const FlatPlan& plan, const WaterPlane& water, const Vec3& sonar,
                                                   const Vec3& point) {
    if (!(water.level - sonar.z() > precise::kLeastDepth) || !(water.level - point.z() > precise::kLeastDepth)) {
      return {};
    }
    const precise::WaterLeg leg = precise::water_leg(water.level, precise::triple_of(sonar), precise::triple_of(point));
    const double share = coherent_reflectance(plan, water.label, leg.cosine);
    if (!(share > precise::kLeastWaterShare)) {
      return {};
    }
    const Vec3 out(leg.rising.x, leg.rising.y, leg.rising.z), bounce = point + leg.first * out;
    return WaterPath{.bounce = bounce,
                     .out = out,
                     .arrival = (bounce - sonar) / leg.second,
                     .first = leg.first,
                     .length = leg.first + leg.second,
                     .near = precise::water_clearance(leg),
                     .share = share};
  }
};

/// Intensity of each of the two reciprocal echoes of the path sonar - mirror - second surface - water's surface -
/// sonar: that of a path by the mirror one way, with the way over the water's surface instead of the straight one back.
/// What the second surface reflects as a mirror does not count.
/// @param reflected  Mirrored share |R|^2 of the first mirror, with its texture.
/// @param normal     Unit normal of the second surface, of either sign.
/// @param direction  Unit vector from the mirror to the second surface.
/// @param there      Length from the sonar over the mirror to the second surface [m].
[[nodiscard]] inline double water_intensity(const FlatPlan& plan, const WaterPath& path, const Scattering& second,
                                            double texture, double reflected, const Vec3& normal, const Vec3& direction,
                                            double there) {
  constexpr double kRougherThanAny = std::numeric_limits<double>::infinity();  // See lobe_share().
  const precise::SecondAngles at =
      precise::second_angles(precise::triple_of(normal), precise::triple_of(-direction), precise::triple_of(path.out));
  return precise::mirror_intensities({.reflectance = reflected * path.share,
                                      .share = 1,
                                      .there = there,
                                      .back = path.length,
                                      .spread = 1,
                                      .returned = 1,
                                      .at = at,
                                      .texture = texture,
                                      .over = {at.arriving, 0, 1}},
                                     precise::second_surface_of(second, at, kRougherThanAny), plan.neper_per_metre)
      .once;
}

/// Weight of a second hit's paths over the water's surface: with `secondary: selective` one_in_four(), else 1.
[[nodiscard]] inline float water_weight(const FlatPlan& plan, int column, int row) {
  return plan.secondary == SecondaryEchoes::kSelective
             ? one_in_four(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), plan.stagger)
             : 1.0F;
}

}  // namespace insonify
