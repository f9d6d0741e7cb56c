// echo.h -- one returned arrival: what every engine produces and only deposit() consumes.

#pragma once

#include <cstdint>

namespace insonify {

/// Instance and material of a surface in one word, compared as one.
using SurfaceLabel = std::uint32_t;
inline constexpr SurfaceLabel kNoSurface = 0xffffffff;

constexpr SurfaceLabel surface_label(std::uint16_t instance, std::uint16_t material) {
  return (static_cast<SurfaceLabel>(instance) << 16) | material;
}
constexpr std::uint16_t instance_of(SurfaceLabel label) {
  return static_cast<std::uint16_t>(label >> 16);
}
constexpr std::uint16_t material_of(SurfaceLabel label) {
  return static_cast<std::uint16_t>(label);
}

struct Echo {
  float azimuth = 0;    ///< Bearing of arrival in the sonar frame [rad]. `paper`: that of launch, the reciprocal path.
  float elevation = 0;  ///< Of the same [rad].
  float path_length = 0;              ///< What the sound really travelled, out and back [m].
  float half_length = 0;              ///< Of the segment in range that it is spread over evenly [m].
  float power = 0;                    ///< Per unit of weight. `paper`: S of the echo's strength, 0..1.
  float phase = 0;                    ///< Turned at surfaces, besides what the path length gives [rad]. `paper`: 0.
  float weight = 0;                   ///< Solid angle of the sector that it stands for [sr].
  int order = 1;                      ///< Surfaces met, 1..kPathOrders.
  SurfaceLabel surface = kNoSurface;  ///< The last surface: the one the echo is labelled with.
};

}  // namespace insonify
