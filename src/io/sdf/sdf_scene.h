// sdf_scene.h -- makes a scene from an SDF world or model.

#pragma once

#include "io/world/sdf_reader.h"

namespace insonify {

/// See SdfReader::load_scene.
[[nodiscard]] Scene load_sdf_scene(const std::filesystem::path& path, const WorldOptions& options, const Log& log);

}  // namespace insonify
