// ply_header.cpp -- parses the lines of a PLY header.

#include "io/mesh/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"

namespace insonify {
namespace {

constexpr std::pair<std::string_view, PlyType> kPlyTypes[] = {
    {"char", PlyType::kInt8},     {"int8", PlyType::kInt8},     {"uchar", PlyType::kUint8},
    {"uint8", PlyType::kUint8},   {"short", PlyType::kInt16},   {"int16", PlyType::kInt16},
    {"ushort", PlyType::kUint16}, {"uint16", PlyType::kUint16}, {"int", PlyType::kInt32},
    {"int32", PlyType::kInt32},   {"uint", PlyType::kUint32},   {"uint32", PlyType::kUint32},
    {"float", PlyType::kFloat},   {"float32", PlyType::kFloat}, {"double", PlyType::kDouble},
    {"float64", PlyType::kDouble}};

PlyType ply_type(const std::string& word, const std::string& where) {
  const auto* found = std::ranges::find(kPlyTypes, word, &std::pair<std::string_view, PlyType>::first);
  if (found == std::end(kPlyTypes)) {
    throw Error(fmt::format("{}: \"{}\" is not a type of numbers", where, printable(word)));
  }
  return found->second;
}

std::uint64_t element_count(const std::string& word, const std::string& where) {
  std::uint64_t count = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (failure == std::errc::invalid_argument || end != word.data() + word.size()) {
    throw Error(fmt::format("{}: \"{}\" is not a number of elements", where, printable(word)));
  }
  return failure == std::errc() ? count : std::numeric_limits<std::uint64_t>::max();
}

bool starts_as_ply(std::string_view line) {
  line.remove_prefix(line.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  return line.starts_with("ply") || line.starts_with("PLY");
}

}  // namespace

int PlyElement::index_of(std::initializer_list<std::string_view> names) const {
  const auto found =
      std::ranges::find_if(properties, [&](const PlyProperty& one) { return std::ranges::count(names, one.name) > 0; });
  return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
}

PlyHeader read_ply_header(std::ifstream& file, const std::filesystem::path& path) {
  PlyHeader header;
  std::string text, key;
  while (key != "end_header") {
    const bool is_line = static_cast<bool>(std::getline(file, text));
    ++header.lines;
    if (header.lines == 1 && !starts_as_ply(text)) {
      throw Error(path.string() + ": is no PLY: it does not begin with \"ply\"");
    }
    if (!is_line) {
      throw Error(path.string() + ": its header does not end: no line says end_header");
    }
    key.clear();
    std::istringstream words(text);
    std::string first, second, third, fourth;
    words >> key >> first >> second >> third >> fourth;
    const std::string where = fmt::format("{}:{}", path.string(), header.lines);
    if (key == "format") {
      header.format = first;
    } else if (key == "element") {
      header.elements.push_back({first, second, element_count(second, where), header.lines, {}});
    } else if (key == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(
          first == "list" ? PlyProperty{fourth, ply_type(third, where), ply_type(second, where), true}
                          : PlyProperty{second, ply_type(first, where)});
    }
  }
  return header;
}

}  // namespace insonify
