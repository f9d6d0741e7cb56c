// stl_text.cpp -- compares the size of a binary STL with its count of triangles, and looks for the end of a text.

#include <fmt/format.h>

#include <algorithm>

#include "base/names.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/mesh/mesh_checks.h"

namespace insonify {
namespace {

// 80 bytes of anything and the number of triangles, then each with a normal, three corners and two bytes more.
constexpr std::size_t kStlTitle = 80, kStlHeader = 84, kStlTriangle = 50;

// The text with its keywords in lower case; names, behind solid and endsolid, stay. Without lines behind the last
// endsolid, unless they begin another solid.
std::string mend_stl_text(std::string_view text, const std::filesystem::path& path, std::vector<std::string>& notes) {
  constexpr std::string_view kBlank = " \t\r\n";
  std::string mended;
  mended.reserve(text.size());
  int line = 0, last_line = 0;
  bool is_open = false;
  std::size_t whole = 0;  // Length up to the last endsolid.
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string_view now = text.substr(at, end - at);
    ++line;
    at = end;
    const std::size_t first = std::min(now.find_first_not_of(kBlank), now.size());
    const std::size_t key_end = std::min(now.find_first_of(kBlank, first), now.size());
    const std::string key = lower_case(now.substr(first, key_end - first));
    last_line = key.empty() ? last_line : line;
    if (key.starts_with("solid") || key.starts_with("endsolid")) {
      mended.append(now.substr(0, first)).append(key).append(now.substr(key_end));
      is_open = key.starts_with("solid");
      whole = is_open ? whole : mended.size();
    } else {
      is_open = is_open || key == "facet";
      mended += lower_case(now);
    }
  }
  if (is_open) {
    throw Error(
        fmt::format("{}:{}: the text ends before its endsolid: a part of it is missing", path.string(), last_line));
  }
  if (mended.find_first_not_of(kBlank, whole) != std::string::npos) {
    notes.push_back(fmt::format("{} behind the last endsolid left out", counted(mended.size() - whole, "byte")));
    mended.resize(whole);
  }
  return mended;
}

std::uint64_t stl_count(std::string_view text) {
  std::uint64_t triangles = 0;
  for (std::size_t i = std::min(kStlHeader, text.size()); i-- > kStlTitle;) {
    triangles = triangles << 8 | static_cast<unsigned char>(text[i]);
  }
  return triangles;
}

// Where the text begins with "solid"; npos for a binary file, which may do so too, but has zeros in its header.
std::size_t begin_of_stl_text(std::string_view text) {
  const std::string_view start = text.substr(0, kStlHeader);
  const std::size_t mark = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  const std::size_t word = start.find_first_not_of(" \t\r\n", mark);
  const bool is_text = start.find('\0') == std::string_view::npos && word != std::string_view::npos &&
                       lower_case(start.substr(word, 5)) == "solid";
  return is_text ? word : std::string_view::npos;
}

}  // namespace

std::string mend_stl(const std::filesystem::path& path, std::vector<std::string>& notes) {
  std::string text = read_text(path);
  const std::uint64_t triangles = stl_count(text), expected = kStlHeader + triangles * kStlTriangle;
  const std::size_t begin = begin_of_stl_text(text);
  if (text.size() == expected) {
    // As it should be.
  } else if (begin != std::string_view::npos) {
    text = mend_stl_text(std::string_view(text).substr(begin), path, notes);
  } else if (text.size() > kStlHeader && triangles == 0 && (text.size() - kStlHeader) % kStlTriangle == 0) {
    const std::uint64_t count = (text.size() - kStlHeader) / kStlTriangle;
    notes.push_back(fmt::format("its count of triangles is 0, its size that of {}", counted(count, "triangle")));
    for (std::size_t i = kStlTitle; i < kStlHeader; ++i) {
      text[i] = static_cast<char>(count >> 8 * (i - kStlTitle) & 0xff);
    }
  } else if (text.size() > expected && triangles > 0) {
    notes.push_back(fmt::format("{} behind the last triangle left out", counted(text.size() - expected, "byte")));
    text.resize(expected);
  } else {
    throw Error(
        fmt::format("{}: is no STL: a text would begin with \"solid\"; binary, with a triangle count of {}, "
                    "would take {} bytes, not {}",
                    path.string(), triangles, expected, text.size()));
  }
  return text;
}

}  // namespace insonify
