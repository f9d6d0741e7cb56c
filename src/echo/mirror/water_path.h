// water_path.h -- path from a second surface over the water's surface to the sonar.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "echo/grid/echo.h"
#include "echo/model/flat_plan.h"
#include "insonify/acoustics/backscatter.h"
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
  [[nodiscard]] bool holds(double z) const { return std::abs(z - level) < kLeastDepth; }
  static constexpr double kLeastDepth = 1e-2;  ///< Points above this depth count as on the surface [m].
};

/// Path from a point to the sonar over the water's surface as a plane mirror, by the sonar's image.
struct WaterPath {
  Vec3 bounce;    ///< Point of reflection.
  Vec3 out;       ///< Unit vector from the point to `bounce`.
  Vec3 arrival;   ///< Unit vector from the sonar to `bounce`.
  double length;  ///< From the point to the sonar [m].
  double share;   ///< Coherent reflectance |R|^2 e^-g of the surface.

  /// None if the point or the sonar is not below the surface, or if waves make `share` negligible.
  [[nodiscard]] static std::optional<WaterPath> of(const FlatPlan& plan, const WaterPlane& water, const Vec3& sonar,
                                                   const Vec3& point) {
    constexpr double kLeastShare = 1e-6;
    const double sonar_depth = water.level - sonar.z(), depth = water.level - point.z();
    if (!(sonar_depth > WaterPlane::kLeastDepth) || !(depth > WaterPlane::kLeastDepth)) {
      return {};
    }
    const Vec3 straight(sonar.x() - point.x(), sonar.y() - point.y(), sonar_depth + depth);
    const double length = straight.norm(), cosine = (sonar_depth + depth) / length;
    const double share = coherent_reflectance(plan, water.label, cosine);
    if (!(share > kLeastShare)) {
      return {};
    }
    const Vec3 bounce = point + depth / (sonar_depth + depth) * straight;
    return WaterPath{bounce, straight / length, (bounce - sonar).normalized(), length, share};
  }
};

/// Intensity of each of the two reciprocal echoes of the path sonar - mirror - second surface - water's surface -
/// sonar, where the second surface scatters diffusely. Relative to the source's at 1 m, per steradian of launched
/// sound: like `once` of mirror_intensities(), with the path over the water's surface instead of the straight one back.
/// @param reflected  Mirrored share |R|^2 of the first mirror, with its texture.
/// @param normal     Unit normal of the second surface, of either sign.
/// @param direction  Unit vector from the mirror to the second surface.
/// @param there      Length from the sonar over the mirror to the second surface [m].
[[nodiscard]] inline double water_intensity(const FlatPlan& plan, const WaterPath& path, const Scattering& second,
                                            double texture, double reflected, const Vec3& normal, const Vec3& direction,
                                            double there) {
  const double in = -normal.dot(direction), out = normal.dot(path.out);
  if (!(in * out > 0)) {
    return 0;
  }
  const double cos_in = std::max(std::abs(in), double{kLeastCosine}), cos_out = std::abs(out);
  double mu = second.lambert;
  if (second.by_angle) {
    mu += second.by_angle->diffuse.at(cos_in) * second.by_angle->diffuse.at(cos_out);
  }
  double scattered = mu * cos_out;
  if (!second.facets_mirror) {  // Wide lobes of facets, except their mirrored share, count as diffuse.
    const Vec3 half = (path.out - direction).normalized();
    const double facet = path.out.dot(half), tilt = std::acos(std::min(std::abs(normal.dot(half)), 1.0));
    scattered += (1 - second.mirror_share(facet)) *
                 facet_scatter(std::sqrt(second.reflectance(facet)), second.rms_slope, tilt) / cos_in;
  }
  return reflected * path.share * scattered * texture * texture / (path.length * path.length) *
         std::exp(-2 * double{plan.neper_per_metre} * (there + path.length));
}

/// Weight of a second hit's paths over the water's surface: with `secondary: selective` one_in_four(), else 1.
[[nodiscard]] inline float water_weight(const FlatPlan& plan, int column, int row) {
  return plan.secondary == SecondaryEchoes::kSelective
             ? one_in_four(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), plan.stagger)
             : 1.0F;
}

}  // namespace insonify
