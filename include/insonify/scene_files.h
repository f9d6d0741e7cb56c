// scene_files.h -- the scenes that come with insonify, by name.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace insonify {

/// Names of the scenarios that come with insonify, in alphabetical order, as load_scenario() takes them: "ferry",
/// "ferry_calibrated". They are in the installed or the source tree's `scenes`; none where they were not installed, as
/// with Debian's package of the library alone.
[[nodiscard]] std::vector<std::string> scene_names();

/// The file of a scenario: `scenario` itself if there is such a file, or if it has a folder or an ending; else that of
/// the scene of this name. Where no scenes were installed, `scenario`.
/// @throws Error with the nearest name if there is neither.
[[nodiscard]] std::filesystem::path scenario_file(const std::filesystem::path& scenario);

/// What a scene shows: the first line of its file; of a comment without "# ", and up to a colon or the full stop.
[[nodiscard]] std::string scene_title(const std::string& name);

}  // namespace insonify
