// stonefish_sonars.h -- converts the sonars of a Stonefish scenario.

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "insonify/error.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// A sonar and its source element.
struct StonefishSonar {
  SonarConfig sonar;
  Place place;
};

/// The sonars of a scenario.
struct StonefishSonars {
  std::vector<StonefishSonar> sonars;
  std::string missing;  ///< Parts that could not be read, in one line; "" if there are none.
};

/// Reads the sensors of types fls, msis and sss: beams, bins, apertures, ranges, gain, sector and pose. A side-scan
/// sonar becomes two of one beam, NAME_port and NAME_starboard. What Stonefish has no settings for (frequency, levels)
/// has our defaults.
/// @param on_vehicle  Poses are those in the robot's base link, for a scenario with a trajectory of its own; else in
///                    the world, x north, y west, z up.
/// @param arguments  As WorldOptions::arguments.
[[nodiscard]] StonefishSonars load_stonefish_sonars(const std::filesystem::path& path, bool on_vehicle,
                                                    std::span<const std::string> arguments = {});

}  // namespace insonify
