// check_stl.cpp -- compares the size of a binary file with its count of triangles, and looks for the end of a text.

#include "io/mesh/check_stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "insonify/error.h"

namespace insonify {
namespace {

// Throws unless the last line with a word in it begins with endsolid.
void check_stl_end(std::ifstream& file, const std::filesystem::path& path) {
  constexpr std::string_view kSpace = " \t\r";
  std::string text, last;
  int line = 0, last_line = 0;
  for (file.seekg(0); std::getline(file, text);) {
    ++line;
    if (text.find_first_not_of(kSpace) != std::string::npos) {
      last.swap(text);
      last_line = line;
    }
  }
  if (!last.substr(last.find_first_not_of(kSpace)).starts_with("endsolid")) {
    throw Error(
        fmt::format("{}:{}: the text ends before its endsolid: a part of it is missing", path.string(), last_line));
  }
}

}  // namespace

void check_stl(const std::filesystem::path& path) {
  // 80 bytes of anything and the number of triangles, then each with a normal, three corners and two bytes more.
  constexpr std::size_t kTitle = 80, kHeader = 84, kTriangle = 50;
  std::array<char, kHeader> header{};
  std::ifstream file(path, std::ios::binary);
  file.read(header.data(), header.size());
  std::uint64_t triangles = 0;
  for (std::size_t i = kHeader; i-- > kTitle;) {
    triangles = triangles << 8 | static_cast<unsigned char>(header[i]);
  }
  const std::uint64_t expected = kHeader + triangles * kTriangle;
  const std::uint64_t size = std::filesystem::file_size(path);
  if (size == expected) {
    return;
  }
  const std::string_view start(header.data(), static_cast<std::size_t>(file.gcount()));
  const bool has_zeros = start.find('\0') != std::string_view::npos;
  if (!has_zeros &&
      start.substr(std::min(start.find_first_not_of("\xef\xbb\xbf \t\r\n"), start.size())).starts_with("solid")) {
    file.clear();
    check_stl_end(file, path);
    return;
  }
  throw Error(
      fmt::format("{}: is no STL: a text would begin with \"solid\"; binary, with a triangle count of {}, "
                  "would take {} bytes, not {}",
                  path.string(), triangles, expected, size));
}

}  // namespace insonify
