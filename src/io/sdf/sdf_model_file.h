// sdf_model_file.h -- the SDF file of a model's folder.

#pragma once

#include <filesystem>
#include <optional>

namespace insonify {

/// The SDF file for a path that an include names. For a model's folder this is the file listed in its model.config, or
/// its model.sdf; nothing if there is none.
[[nodiscard]] std::optional<std::filesystem::path> sdf_file_of_model(const std::filesystem::path& found);

}  // namespace insonify
