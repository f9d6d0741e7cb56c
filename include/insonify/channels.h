// channels.h -- images of distance and echo intensity by direction (azimuth x elevation), before echoes are sorted into
// beams and bins: the two channels of the shader image of the paper (docs/concepts/paper-model.md).

#pragma once

#include <vector>

#include "insonify/picture.h"

namespace insonify {

/// One value per direction; directions are evenly spaced over the fan. Computed by look_along_fan().
struct Channels {
  int columns = 0, rows = 0;
  double port_edge = 0, starboard_edge = 0;  ///< Azimuths of the left and right borders [rad].
  double upper_edge = 0, lower_edge = 0;     ///< Elevations of the upper and lower borders [rad].

  // rows x columns, from the upper left; NaN where there is no surface within range.
  std::vector<float> distance;   ///< Distance to the first surface [m].
  std::vector<float> intensity;  ///< |cos(incidence)| x reflectivity x two-way absorption of its echo, 0..1.
};

/// Draws three images below each other: distance, intensity, and both as in the paper (distance blue, intensity green).
/// Distance is scaled from 0 to the sonar's max_range, intensity from 0 to a round number at or above its maximum.
/// @param display  Only `height` (of the whole picture) and `annotations` (axes) are used.
/// @throws Error for a display out of limits, and for channels without a value.
[[nodiscard]] Picture draw_channels(const Channels& channels, const SonarConfig& sonar, const Display& display = {});

}  // namespace insonify
