// stonefish_scene.h -- makes a scene from a Stonefish scenario.

#pragma once

#include <filesystem>

#include "insonify/files.h"
#include "insonify/log.h"
#include "insonify/scene.h"

namespace insonify {

/// Reads the bodies and robots of a scenario (.scn) and of those that it includes: every body, link or external part
/// of a compound body becomes an instance named "body", "robot::link" or "robot::link::part". World: x north, y west,
/// z up. docs/reference/stonefish.md lists what is read and what is not.
/// @throws Error "path:line:column: ..." for faults, and if there is nothing to insonify.
[[nodiscard]] Scene load_stonefish_scene(const std::filesystem::path& path, const WorldOptions& options,
                                         const Log& log);

}  // namespace insonify
