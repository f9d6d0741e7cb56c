// water_path.h -- the way back from a second surface to the sonar by the water's surface.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "echo/grid/echo.h"
#include "echo/model/coherent_share.h"
#include "echo/model/echo_laws.h"
#include "insonify/acoustics/backscatter.h"
#include "insonify/scene.h"

namespace insonify {

/// The water's surface in an engine's coordinates.
struct WaterPlane {
  double level = 0;                 ///< z [m].
  SurfaceLabel label = kNoSurface;  ///< kNoSurface where there is none.

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

  /// Whether a hit at a height z is one on the surface.
  [[nodiscard]] bool holds(double z) const { return std::abs(z - level) < kLeastDepth; }
  static constexpr double kLeastDepth = 1e-2;  ///< [m]
};

/// Sound from a point to the sonar by the water's surface, as by a plane mirror: it goes straight to the sonar's image.
struct WaterPath {
  Vec3 bounce;    ///< Where the surface reflects it.
  Vec3 out;       ///< Unit vector from the point to there.
  Vec3 arrival;   ///< Unit vector from the sonar to there.
  double length;  ///< From the point to the sonar [m].
  double share;   ///< |R|^2 e^-g: what the surface reflects as a smooth mirror.

  /// None if the point or the sonar is not below the surface, or if waves leave next to nothing.
  [[nodiscard]] static std::optional<WaterPath> of(const PingPlan& plan, const WaterPlane& water, const Vec3& sonar,
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

/// Intensity of each of the two reciprocal echoes out by a mirror and back by the water's surface from what a second
/// surface scatters as no mirror does, relative to the source's at 1 m and per steradian of launched sound: as `once`
/// of mirror_intensities(), with the path by the surface for the straight one.
/// @param reflected  share |R|^2 of the mirror, with its texture.
/// @param normal     Unit normal of the second surface, on either side.
/// @param direction  Unit vector from the mirror to the second surface.
/// @param there      Length from the sonar by the mirror to the second surface [m].
[[nodiscard]] inline double water_intensity(const PingPlan& plan, const WaterPath& path, const Scattering& second,
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
  if (!second.facets_mirror) {  // What of wide lobes goes on as from no mirror.
    const Vec3 half = (path.out - direction).normalized();
    const double facet = path.out.dot(half), tilt = std::acos(std::min(std::abs(normal.dot(half)), 1.0));
    scattered += (1 - second.mirror_share(facet)) *
                 facet_scatter(std::sqrt(second.reflectance(facet)), second.rms_slope, tilt) / cos_in;
  }
  return reflected * path.share * scattered * texture * texture / (path.length * path.length) *
         std::exp(-2 * double{plan.neper_per_metre} * (there + path.length));
}

/// With `secondary: selective`, one in four second hits is connected to the water's surface, and stands for four. By a
/// hash of the sample, so that engines and threads agree.
/// @return Number of hits that it stands for; 0 if it is left out.
[[nodiscard]] inline float water_weight(const PingPlan& plan, int column, int row) {
  constexpr std::uint32_t kOneIn = 4;
  if (plan.secondary != SecondaryEchoes::kSelective) {
    return 1;
  }
  std::uint32_t hash =
      static_cast<std::uint32_t>(column) * 0x9e3779b9U + static_cast<std::uint32_t>(row) * 0x85ebca6bU + plan.stagger;
  hash = (hash ^ (hash >> 16)) * 0x7feb352dU;
  hash = (hash ^ (hash >> 15)) * 0x846ca68bU;
  return (hash >> 20) % kOneIn == 0 ? static_cast<float>(kOneIn) : 0.0F;
}

}  // namespace insonify
