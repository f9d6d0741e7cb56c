// check_gltf.cpp -- counts open brackets, then follows the nodes' lists of children.

#include "io/mesh/check_gltf.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "insonify/error.h"
#include "io/mesh/scene_depth.h"

namespace insonify {
namespace {

// `place(line)` names the place of a bracket in messages.
template <typename Place>
void check_brackets(std::string_view json, const Place& place) {
  std::size_t depth = 0;
  int line = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    line += c == '\n' ? 1 : 0;
    if (quoted) {
      i += c == '\\' ? 1 : 0;
      quoted = c != '"';
      continue;
    }
    quoted = c == '"';
    if (c == '[' || c == '{') {
      if (++depth > kDeepestScene) {
        throw Error(fmt::format("{}: nested too deeply: more than {} brackets are open", place(line), kDeepestScene));
      }
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
}

// Ignores what is malformed: assimp refuses that.
void check_gltf_nodes(std::string_view text, const std::filesystem::path& path) {
  const nlohmann::json gltf = nlohmann::json::parse(text, nullptr, false);
  if (!gltf.is_object() || !gltf.contains("nodes") || !gltf["nodes"].is_array()) {
    return;
  }
  const nlohmann::json& nodes = gltf["nodes"];
  std::vector<NodeLink> links;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].is_object() || !nodes[i].contains("children")) {
      continue;
    }
    for (const nlohmann::json& child : nodes[i]["children"]) {
      if (child.is_number_unsigned() && child.get<std::size_t>() < nodes.size()) {
        links.push_back({i, child.get<std::size_t>()});
      }
    }
  }
  check_depth(nodes.size(), links, path);
}

}  // namespace

void check_gltf(std::string_view text, const std::filesystem::path& path) {
  check_brackets(text, [&](int line) { return fmt::format("{}:{}", path.string(), line); });
  check_gltf_nodes(text, path);
}

void check_glb(const std::filesystem::path& path) {
  // Magic word, version and size of the whole; then size and kind of its first part, the JSON; all of four bytes.
  constexpr std::size_t kHeader = 20, kJsonSize = 12;
  std::ifstream file(path, std::ios::binary);
  std::array<char, kHeader> header{};
  if (!file.read(header.data(), header.size())) {
    return;  // Malformed: assimp refuses it.
  }
  std::uint32_t size = 0;
  for (std::size_t i = 4; i-- > 0;) {
    size = size << 8 | static_cast<unsigned char>(header[kJsonSize + i]);
  }
  std::string text(std::min<std::uintmax_t>(size, std::filesystem::file_size(path)), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  check_brackets(text, [&](int) { return path.string(); });
  check_gltf_nodes(text, path);
}

}  // namespace insonify
