// mesh_counts.cpp -- reads headers and no more.

#include "io/mesh/mesh_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

#include "insonify/error.h"

namespace insonify {
namespace {

// Of each kind there are `count`, which take at least `bytes` each.
struct Element {
  std::string name, count_as_written;
  std::uint64_t count = 0;
  std::uint64_t bytes = 0;
  int line = 1;
};

constexpr std::pair<std::string_view, std::uint64_t> kTypes[] = {
    {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
    {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
    {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};

std::uint64_t bytes_of_type(const std::string& type) {
  const auto* found = std::ranges::find(kTypes, type, &std::pair<std::string_view, std::uint64_t>::first);
  return found == std::end(kTypes) ? 1 : found->second;  // assimp refuses unknown ones.
}

std::uint64_t read_count(const std::string& word, const std::string& where) {
  std::uint64_t count = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (failure == std::errc::invalid_argument || end != word.data() + word.size()) {
    throw Error(fmt::format("{}: \"{}\" is not a number of elements", where, word));
  }
  return failure == std::errc() ? count : std::numeric_limits<std::uint64_t>::max();
}

// What assimp goes by, after a byte order mark perhaps.
bool starts_as_ply(std::string_view line) {
  if (line.starts_with("\xef\xbb\xbf")) {
    line.remove_prefix(3);
  }
  return line.starts_with("ply") || line.starts_with("PLY");
}

}  // namespace

void check_ply_counts(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<Element> elements;
  bool is_text = false, is_ply = false;
  int line = 0;
  std::uint64_t header_bytes = 0;
  std::string text, key;
  do {
    if (!std::getline(file, text)) {
      if (!is_ply) {
        return;  // assimp says so.
      }
      throw Error(fmt::format("{}: its header does not end: no line says end_header", path.string()));
    }
    ++line;
    header_bytes += text.size() + 1;
    key.clear();
    std::istringstream words(text);
    std::string type, name;
    words >> key >> type;
    is_ply |= line == 1 && starts_as_ply(text);
    if (key == "format") {
      is_text = type == "ascii";
    } else if (key == "element") {
      std::string count;
      words >> count;
      elements.push_back({type, count, read_count(count, fmt::format("{}:{}", path.string(), line)), 0, line});
    } else if (key == "property" && !elements.empty()) {
      // A list may be empty: its size is all of it. A number in a text has a digit and what parts it from the next.
      words >> name;
      elements.back().bytes += is_text ? 2 : bytes_of_type(type == "list" ? name : type);
    }
  } while (key != "end_header");

  const std::uint64_t size = std::filesystem::file_size(path) + (is_text ? 1 : 0);  // The last number needs no space.
  std::uint64_t room = size - std::min(size, header_bytes);
  for (const Element& element : elements) {
    const std::uint64_t most = room / std::max<std::uint64_t>(element.bytes, 1);
    if (element.count > most) {
      throw Error(fmt::format("{}:{}: element {} {}: the file can hold {} at most", path.string(), element.line,
                              element.name, element.count_as_written, most));
    }
    room -= element.count * element.bytes;
  }
}

void check_stl_size(const std::filesystem::path& path) {
  // 80 bytes of anything and the number of triangles, then each with a normal, three corners and two bytes more.
  constexpr std::size_t kTitle = 80, kHeader = 84, kTriangle = 50;
  std::array<char, kHeader> header{};
  std::ifstream file(path, std::ios::binary);
  file.read(header.data(), header.size());
  const std::string_view start(header.data(), static_cast<std::size_t>(file.gcount()));
  if (start.substr(std::min(start.find_first_not_of("\xef\xbb\xbf \t\r\n"), start.size())).starts_with("solid")) {
    return;
  }
  std::uint64_t triangles = 0;
  for (std::size_t i = kHeader; i-- > kTitle;) {
    triangles = triangles << 8 | static_cast<unsigned char>(header[i]);
  }
  const std::uint64_t expected = kHeader + triangles * kTriangle;
  const std::uint64_t size = std::filesystem::file_size(path);
  if (size != expected) {
    throw Error(
        fmt::format("{}: is no STL: a text would begin with \"solid\"; binary, with a triangle count of {}, "
                    "would take {} bytes, not {}",
                    path.string(), triangles, expected, size));
  }
}

}  // namespace insonify
