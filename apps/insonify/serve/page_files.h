// page_files.h -- the files of the viewer's page, embedded in the program.

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include "serve/net/net_server.h"

namespace insonify {

/// The bytes of a file.
struct PageBytes {
  const char *begin = nullptr, *end = nullptr;
};

/// The files by their paths, such as "/index.html"; written by CMake.
[[nodiscard]] const std::map<std::string_view, PageBytes>& page_table();

/// A file of the page; "/" is "/index.html".
/// @param folder  Read files from this folder instead, for work on the page; "": those in the program.
[[nodiscard]] std::optional<ServedFile> page_file(std::string_view path, const std::filesystem::path& folder);

}  // namespace insonify
