// recordings.h -- names of recordings of `insonify serve`, and messages about finished ones.

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "insonify/live_loop.h"

namespace insonify {

/// Refuses a recording whose files exist already, unless they may be replaced, and one whose scenario would replace the
/// served scenario.
/// @throws InputError with the first such file and a remedy.
void refuse_recordings(const std::filesystem::path& recording, std::span<const SonarConfig> sonars, bool replace,
                       const std::filesystem::path& served);

/// One line with pings, size, names and folder.
[[nodiscard]] std::string recorded_text(const LiveRecording& recording);

/// "812 bytes", "34 kB", "2.6 MB", in powers of 1000.
[[nodiscard]] std::string size_text(std::uintmax_t bytes);

}  // namespace insonify
