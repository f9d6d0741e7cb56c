// shipped_folder.h -- finds the folders of presets and scenes that came with this library.

#pragma once

#include <filesystem>
#include <string>

namespace insonify {

/// PREFIX/share/insonify/WHAT of the prefix that this library is installed in, wherever that has been moved to; in a
/// build tree, which is laid out alike, a link to the sources' folder. It may not exist.
/// @param what  "presets" or "scenes".
[[nodiscard]] std::filesystem::path shipped_folder(const std::string& what);

}  // namespace insonify
