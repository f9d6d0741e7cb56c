// page_files.h -- the files of the viewer's page, inside the program.

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include "serve/net/net_server.h"

namespace insonify {

/// Where the bytes of a file begin and end.
struct PageBytes {
  const char *begin = nullptr, *end = nullptr;
};

/// The files by their paths, such as "/index.html"; written by CMake.
[[nodiscard]] const std::map<std::string_view, PageBytes>& page_table();

/// A file of the page; "/" is "/index.html".
/// @param folder  Where to read files from instead, for those who work on the page; "" for those in the program.
[[nodiscard]] std::optional<ServedFile> page_file(std::string_view path, const std::filesystem::path& folder);

}  // namespace insonify
