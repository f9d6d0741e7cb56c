// mesh_checks.cpp -- compares the size of a binary STL with its count of triangles, looks for the end of a text, and
// looks up what instances in COLLADA name.

#include "io/mesh/mesh_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <set>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/xml_file.h"

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

// The kinds of elements that an <instance_...> may name.
const std::map<std::string, std::set<std::string>> kInstances = {{"instance_geometry", {"geometry"}},
                                                                 {"instance_controller", {"controller", "geometry"}},
                                                                 {"instance_node", {"node"}}};

// Calls visit(element) for all elements.
template <typename Visit>
void each_element(pugi::xml_node root, const Visit& visit) {
  root.find_node([&](pugi::xml_node node) {
    visit(node);
    return false;
  });
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

void check_dae(std::string_view text, const std::filesystem::path& path) {
  const XmlFile xml(text, path.string());
  std::set<std::string> named;  // By kind and reference: "node #ship".
  each_element(xml.root(), [&](pugi::xml_node element) {
    if (const pugi::xml_attribute id = element.attribute("id")) {
      named.insert(fmt::format("{} #{}", element.name(), id.value()));
    }
  });
  each_element(xml.root(), [&](pugi::xml_node element) {
    const auto kinds = kInstances.find(element.name());
    const std::string url = element.attribute("url").value();
    if (kinds == kInstances.end() || !url.starts_with('#')) {
      return;  // assimp refuses other references.
    }
    if (std::ranges::none_of(kinds->second,
                             [&](const std::string& kind) { return named.contains(kind + " " + url); })) {
      throw Error(fmt::format("{}<{}> names {}, which is not in this file", xml.where(element), element.name(),
                              printable(url)));
    }
  });
}

}  // namespace insonify
