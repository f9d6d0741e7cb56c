// echo.h -- returned arrivals, as engines and targets give them to an EchoGrid.
//
// There are three forms, since they carry different things:
// - FootprintSegment (surface_run.h): a primary echo, spread over the range interval between two neighbouring samples
// of
//   a column. There are a quarter of a million in a ping; those of a run on one surface are summed before they go to
//   the cells, which an Echo by itself would make several times as dear.
// - Echo: one arrival by way of mirrors, which may fall into any beam.
// - DiscreteEcho: one arrival that keeps its exact bearing and phase, as of an ideal point, and interferes with others.
//   Cells hold sums over many scatterers, whose phases are drawn afterwards.

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

/// One arrival by way of mirrors: what deposit() takes.
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

/// One arrival with a bearing and phase of its own; order 0 is what is no echo, such as another sonar's pulse.
struct DiscreteEcho {
  int beam = 0, bin = 0;
  int order = 1;           ///< Surfaces met.
  float bearing_sine = 0;  ///< Sine of the bearing of arrival.
  float intensity = 0;     ///< Relative to the source's at 1 m.
  float turns = 0;         ///< Phase, 0..1.
};

}  // namespace insonify
