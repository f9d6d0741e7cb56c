// file_lock.h -- keeps two runs from writing into one recording.

#pragma once

#include <filesystem>

namespace insonify {

/// Marks the open file as being written until it is closed; programs that only read are not kept out. Where the file
/// system knows no locks nothing happens.
/// @return  Whether nobody else had marked it.
[[nodiscard]] bool lock_for_writing(int file);

/// Whether somebody is writing the file at `path`, which need not exist.
[[nodiscard]] bool is_being_written(const std::filesystem::path& path);

}  // namespace insonify
