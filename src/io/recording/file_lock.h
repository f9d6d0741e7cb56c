// file_lock.h -- keeps two runs from writing into one recording.

#pragma once

#include <filesystem>

namespace insonify {

/// Marks an open file as being written, until it is closed. Programs that only read it are not kept out. Where the file
/// system knows no locks nothing is marked.
void mark_as_being_written(int file);

/// Whether somebody else has the file marked as being written. It need not exist.
[[nodiscard]] bool is_being_written(const std::filesystem::path& path);

/// Whether the open file can still be found: that it was not removed, replaced or moved from its path.
[[nodiscard]] bool is_still_there(int file, const std::filesystem::path& path);

}  // namespace insonify
