// sound_speed_files.h -- reads sound-speed profiles from the files of casts.

#pragma once

#include <filesystem>
#include <vector>

#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/log.h"

namespace insonify {

/// Reads the points of a sound-speed profile from a text.
///
/// - `.csv`: values under a header that names the columns: depth [m] and speed [m/s], or temperature [degC] and
/// salinity
///   [PSU]; separated by commas, semicolons, tabs or blanks. Lines that begin with # are comments.
/// - `.svp`: CARIS, `[SVP_VERSION_2]`, with one section; or depth and speed in two columns.
/// - `.asvp`: Kongsberg, `( SoundVelocity 1.0 ... )`: depth and speed, and columns that are not read.
///
/// @param log  Receives a warning about columns that are not read.
/// @throws Error "path:line:column: ..." for a number that is invalid or out of limits, depths that do not rise, a row
///         with too few values, a second section, and fewer points than the header says.
[[nodiscard]] std::vector<ProfilePoint> load_sound_speed_profile(const std::filesystem::path& path,
                                                                 const Log& log = {});

}  // namespace insonify
