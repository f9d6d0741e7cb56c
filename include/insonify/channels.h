// channels.h -- what a sonar's fan is made of before it is sorted into beams and bins: pulse distance and echo
// intensity by direction, the two channels of the paper's shader images.

#pragma once

#include <vector>

#include "insonify/picture.h"

namespace insonify {

/// One value for each direction, directions evenly spread over the fan. look_along_fan() makes them.
struct Channels {
  int columns = 0, rows = 0;
  double port_edge = 0, starboard_edge = 0;  ///< Azimuths of the left and right borders [rad].
  double upper_edge = 0, lower_edge = 0;     ///< Elevations of the upper and lower borders [rad].

  // rows x columns, from the upper left; NaN where nothing is met within range.
  std::vector<float> distance;   ///< To the first surface [m].
  std::vector<float> intensity;  ///< Of its echo, 0..1: |cos| of incidence x reflectivity x absorption there and back.
};

/// Draws distance, intensity, and both in one as the paper does (distance blue, intensity green), under each other:
/// from nothing to the sonar's max_range, and to a round number at or above the strongest intensity.
/// @param display  Only `height` and `annotations` count: the height of the whole picture and whether it has axes.
/// @throws Error for a display out of limits, and for channels without a value.
[[nodiscard]] Picture draw_channels(const Channels& channels, const SonarConfig& sonar, const Display& display = {});

}  // namespace insonify
