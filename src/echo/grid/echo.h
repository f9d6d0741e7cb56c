// echo.h -- single arrivals, as engines and targets pass them to an EchoGrid.
//
// There are three kinds, because they are added in different ways:
// - FootprintSegment (echo/laws/hit_footprint.h): a primary echo between two neighbouring samples of a column.
//   A ping has some 200,000; those of one surface are summed by bin before the grid is touched,
//   which takes a fraction of the time.
// - Echo: a secondary echo, which may arrive in any beam.
//   deposit() spreads its footprint over the bins of that beam.
// - DiscreteEcho: the echo of a point target or another sonar's pulse. It keeps its bearing and phase, so that it can
//   interfere with others; cells hold sums of intensity, whose phase the receiver draws.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "insonify/geometry.h"

namespace insonify {

/// Instance (upper 16 bits) and material (lower 16 bits) of a surface.
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

/// A secondary echo: what deposit() adds to the grid.
struct Echo {
  float azimuth = 0;      ///< Bearing of arrival in the sonar frame [rad]; in the `paper` model, of the launched ray.
  float elevation = 0;    ///< Elevation of the same direction [rad].
  float path_length = 0;  ///< Length of the whole path, out and back [m].
  float half_length = 0;  ///< Half the range interval that the echo is spread over evenly [m].
  float power = 0;        ///< Echo intensity per unit of weight; in the `paper` model S(strength), 0..1.
  float weight = 0;       ///< Solid angle of launched sound that the echo stands for [sr].
  int order = 1;          ///< Number of surfaces on the path, 1..kPathOrders.
  SurfaceLabel surface = kNoSurface;  ///< The last surface of the path, which labels the echo.
};

/// An arrival with its own bearing and phase. Order 0 marks another sonar's pulse, which is not an echo.
struct DiscreteEcho {
  int beam = 0, bin = 0;
  int order = 1;           ///< Number of surfaces on the path.
  float bearing_sine = 0;  ///< Sine of the bearing of arrival.
  float intensity = 0;     ///< Relative to the source's at 1 m.
  float turns = 0;         ///< Phase in full turns, 0..1.
};

/// What one EchoSource finds at one ping.
struct EchoList {
  std::vector<Echo> spread;            ///< Echoes that are summed in cells, in the order in which they are added.
  std::vector<DiscreteEcho> discrete;  ///< Echoes with a bearing and a phase of their own.
  std::vector<std::optional<Vec3>> thrusters;  ///< [thruster] Its position in the sonar frame [m]; none where hidden.

  void clear() {
    spread.clear();
    discrete.clear();
    thrusters.clear();
  }
};

}  // namespace insonify
