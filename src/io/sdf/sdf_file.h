// sdf_file.h -- the SDF file of a model, and the models of a file with all its includes.

#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "insonify/log.h"
#include "io/file/missing_parts.h"
#include "io/sdf/sdf_models.h"
#include "io/sdf/sdf_source.h"

namespace insonify {

/// The SDF file for a path that an include names. For a model's folder this is the file listed in its model.config, or
/// its model.sdf; nothing if there is none.
[[nodiscard]] std::optional<std::filesystem::path> sdf_file_of_model(const std::filesystem::path& found);

/// Locks libsdformat's global state: its settings and std::cerr. To be held while a file is read.
[[nodiscard]] std::unique_lock<std::mutex> lock_sdf();

/// Reads a file, without elements whose faults would prevent it.
/// @param reading  With `strict`, missing parts and faulty elements are errors.
/// @param missing  Receives missing and unreadable parts.
/// @throws Error "path:line:column: ..." for faults.
[[nodiscard]] SdfModels read_sdf_models(const std::filesystem::path& path, SdfReading reading, MissingParts& missing,
                                        const Log& log);

}  // namespace insonify
