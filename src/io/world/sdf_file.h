// sdf_file.h -- an SDF file with all that it includes, parsed.

#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <sdf/Root.hh>

#include "insonify/log.h"
#include "io/file/missing_parts.h"
#include "io/world/sdf_source.h"

namespace insonify {

/// The files of a world, and what libsdformat makes of them.
struct SdfFile {
  std::unique_ptr<SdfSource> source;
  sdf::Root root;
};

/// Locks what is global in libsdformat: its settings and std::cerr. To be held while a file is read.
[[nodiscard]] std::unique_lock<std::mutex> lock_sdf();

/// Reads a file, without its joints where their faults would keep it from being read.
/// @param strict   Whether what is missing, or a faulty joint, is an error.
/// @param missing  Receives what is not found or cannot be read. This and `log` must outlive the file.
/// @throws Error "path:line:column: ..." for faults.
[[nodiscard]] SdfFile read_sdf_file(const std::filesystem::path& path, bool strict, MissingParts& missing,
                                    const Log& log);

}  // namespace insonify
