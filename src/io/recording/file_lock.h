// file_lock.h -- keeps two runs from writing into one recording.

#pragma once

#include <filesystem>

namespace insonify {

/// Opens the file `beside`, made if it is missing, that is to become `path`. Until it is closed it is marked as being
/// written, also once it has become `path`; programs that only read are not kept out. Where the file system knows no
/// locks nothing is marked.
/// @return  The open file.
/// @throws Error when it cannot be opened, or when somebody else is writing either.
[[nodiscard]] int open_for_writing(const std::filesystem::path& path, const std::filesystem::path& beside);

}  // namespace insonify
