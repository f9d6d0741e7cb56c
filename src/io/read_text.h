// read_text.h -- a whole text file at once.

#pragma once

#include <filesystem>
#include <string>

namespace insonify {

/// @throws Error with the path for a file that is missing, a folder, or cannot be read.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

}  // namespace insonify
