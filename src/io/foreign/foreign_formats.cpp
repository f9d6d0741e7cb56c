// foreign_formats.cpp -- the table of formats, recognised by first bytes or ending.

#include "io/foreign/foreign_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/recorded_pings.h"
#include "io/file/input_file.h"

namespace insonify {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::size_t kForeignHead = 1026;  // XTF needs most: its file header and the mark of its first packet [bytes].

constexpr ForeignFormat kForeignFormats[] = {
    {"Oculus", ".raw .oculus",
     [](std::string_view head) { return head.starts_with("SO") || head.starts_with("\x44\x33\x22\x11"); }, open_oculus},
    {"Ping360", ".bin",
     [](std::string_view head) {
       return head.starts_with("\0\0\0\x1aPingViewer"sv) || head.starts_with("\0\0\0\x34\0P\0i\0n\0g"sv) ||
              head.starts_with("BR");
     },
     open_ping360},
    {"XTF", ".xtf", [](std::string_view head) { return head.starts_with('{') && head.substr(1024, 2) == "\xce\xfa"; },
     open_xtf},
    {"NumPy", ".npy", [](std::string_view head) { return head.starts_with("\x93NUMPY"); }, open_npy},
    {"NumPy", ".npz", [](std::string_view head) { return head.starts_with("PK\3\4") || head.starts_with("PK\5\6"); },
     open_npz}};

std::string head_of(const std::filesystem::path& path) {
  std::error_code ignored;
  std::string head(kForeignHead, '\0');
  if (!std::filesystem::is_regular_file(path, ignored)) {
    return "";
  }
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

}  // namespace

const ForeignFormat* foreign_format(const std::filesystem::path& path) {
  const std::string head = head_of(path);
  if (head.starts_with("\x89HDF\r\n\x1a\n")) {
    return nullptr;
  }
  for (const ForeignFormat& format : kForeignFormats) {
    if (head.size() >= 2 && format.starts(head.size() < kForeignHead ? head + std::string(kForeignHead, '\0') : head)) {
      return &format;
    }
  }
  const std::string ending = ending_of(path);
  const auto* const named = std::ranges::find_if(kForeignFormats, [&](const ForeignFormat& format) {
    return !ending.empty() && fmt::format(" {} ", format.endings).find(" " + ending + " ") != std::string::npos;
  });
  return named == std::end(kForeignFormats) ? nullptr : named;
}

std::string foreign_recordings() {
  std::string endings;
  for (const ForeignFormat& format : kForeignFormats) {
    for (const char letter : format.endings) {
      endings += letter == ' ' ? ", " : std::string(1, letter);
    }
    endings += ", ";
  }
  return endings.substr(0, endings.size() - 2);
}

void check_foreign_sonar(const std::filesystem::path& path, const std::string& wanted, const std::string& found) {
  if (!wanted.empty() && wanted != found) {
    throw Error(fmt::format("{}: has no sonar {}; its sonar is {}", path.string(), printable(wanted), found));
  }
}

}  // namespace insonify
