// sdf_sonars.h -- the sonars that stand in an SDF file, each in the link or model that carries it.

#pragma once

#include "io/world/sdf_reader.h"

namespace insonify {

/// See SdfReader::load_sonars.
[[nodiscard]] std::vector<SdfSonar> load_sdf_sonars(const std::filesystem::path& path, const Log& log);

}  // namespace insonify
