// sdf_file.h -- the SDF file of a model, and a parsed file with all its includes.

#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <sdf/Root.hh>

#include "insonify/log.h"
#include "io/file/missing_parts.h"
#include "io/sdf/sdf_source.h"

namespace insonify {

/// The SDF file for a path that an include names. For a model's folder this is the file listed in its model.config, or
/// its model.sdf; nothing if there is none.
[[nodiscard]] std::optional<std::filesystem::path> sdf_file_of_model(const std::filesystem::path& found);

/// The files of a world, as parsed by libsdformat.
struct SdfFile {
  std::unique_ptr<SdfSource> source;
  sdf::Root root;
};

/// Locks libsdformat's global state: its settings and std::cerr. To be held while a file is read.
[[nodiscard]] std::unique_lock<std::mutex> lock_sdf();

/// Reads a file, without elements whose faults would prevent it.
/// @param reading  With `strict`, missing parts and faulty elements are errors.
/// @param missing  Receives missing and unreadable parts. This and `log` must outlive the file.
/// @throws Error "path:line:column: ..." for faults.
[[nodiscard]] SdfFile read_sdf_file(const std::filesystem::path& path, SdfReading reading, MissingParts& missing,
                                    const Log& log);

}  // namespace insonify
