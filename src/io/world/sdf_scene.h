// sdf_scene.h -- makes a scene from an SDF world or model.

#pragma once

#include <filesystem>

#include "insonify/files.h"
#include "insonify/log.h"
#include "insonify/scene.h"

namespace insonify {

/// Reads all worlds and models of a file: every visual, or every collision, becomes an instance named
/// "model::link::visual". docs/reference/sdf.md lists what is read and what is not.
/// @throws Error "path:line:column: ..." for faults, and if there is nothing to insonify.
[[nodiscard]] Scene load_sdf_scene(const std::filesystem::path& path, const WorldOptions& options, const Log& log);

}  // namespace insonify
