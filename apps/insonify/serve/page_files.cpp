// page_files.cpp -- finds the files of the page and their media types.

#include "serve/page_files.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

namespace insonify {
namespace {

std::string_view type_of(std::string_view path) {
  static const std::map<std::string_view, std::string_view> kTypes = {{"html", "text/html; charset=utf-8"},
                                                                      {"js", "text/javascript; charset=utf-8"},
                                                                      {"mjs", "text/javascript; charset=utf-8"},
                                                                      {"css", "text/css; charset=utf-8"},
                                                                      {"json", "application/json"},
                                                                      {"svg", "image/svg+xml"},
                                                                      {"png", "image/png"},
                                                                      {"ico", "image/x-icon"},
                                                                      {"webmanifest", "application/manifest+json"},
                                                                      {"txt", "text/plain; charset=utf-8"}};
  const auto type = kTypes.find(path.substr(path.rfind('.') + 1));
  return type == kTypes.end() ? "application/octet-stream" : type->second;
}

// Whether a path stays inside its folder and names no hidden file.
bool stays_inside(std::string_view path) {
  const bool plain = std::ranges::all_of(path, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-' || c == '/';
  });
  return plain && path.find("/.") == std::string_view::npos && path.find("//") == std::string_view::npos;
}

std::optional<std::string> bytes_in(const std::filesystem::path& folder, std::string_view path) {
  if (!stays_inside(path)) {
    return {};
  }
  std::error_code failure;
  const std::filesystem::path file = std::filesystem::canonical(folder / path.substr(1), failure);
  const std::string root = std::filesystem::canonical(folder, failure).string() + "/";
  if (failure || !file.string().starts_with(root) || !std::filesystem::is_regular_file(file, failure)) {
    return {};
  }
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

std::optional<ServedFile> page_file(std::string_view path, const std::filesystem::path& folder) {
  path = path == "/" ? "/index.html" : path;
  if (!path.starts_with('/')) {
    return {};
  }
  if (!folder.empty()) {
    std::optional<std::string> bytes = bytes_in(folder, path);
    return bytes ? std::optional(ServedFile{type_of(path), std::move(*bytes)}) : std::nullopt;
  }
  const auto found = page_table().find(path);
  if (found == page_table().end()) {
    return {};
  }
  return ServedFile{type_of(path), std::string(found->second.begin, found->second.end)};
}

}  // namespace insonify
