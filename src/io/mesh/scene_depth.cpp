// scene_depth.cpp -- one pass over brackets or tags, and one over the nodes.

#include "io/mesh/scene_depth.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "insonify/error.h"
#include "io/file/xml_scan.h"

namespace insonify {
namespace {

constexpr std::size_t kDeepest = 512;  // A scene needs a dozen.

// `place` names the line that a bracket stands in.
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
      if (++depth > kDeepest) {
        throw Error(fmt::format("{}: nested too deeply: more than {} brackets are open", place(line), kDeepest));
      }
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
}

struct Link {
  std::size_t parent, child;
};

// A ring is endlessly deep. Each pass takes every node one level further down.
void check_nodes(std::size_t count, const std::vector<Link>& links, const std::filesystem::path& path) {
  std::vector<std::size_t> depths(count, 1);
  for (bool moved = true; moved;) {
    moved = false;
    for (const Link& link : links) {
      if (depths[link.child] <= depths[link.parent]) {
        depths[link.child] = depths[link.parent] + 1;
        moved = true;
        if (depths[link.child] > kDeepest) {
          throw Error(fmt::format("{}: nested too deeply: more than {} nodes hang below each other, or in a ring",
                                  path.string(), kDeepest));
        }
      }
    }
  }
}

// What is not as it should be is left out: assimp says so.
void check_gltf_nodes(std::string_view text, const std::filesystem::path& path) {
  const nlohmann::json gltf = nlohmann::json::parse(text, nullptr, false);
  if (!gltf.is_object() || !gltf.contains("nodes") || !gltf["nodes"].is_array()) {
    return;
  }
  const nlohmann::json& nodes = gltf["nodes"];
  std::vector<Link> links;
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
  check_nodes(nodes.size(), links, path);
}

}  // namespace

void check_gltf_depth(std::string_view text, const std::filesystem::path& path) {
  check_brackets(text, [&](int line) { return fmt::format("{}:{}", path.string(), line); });
  check_gltf_nodes(text, path);
}

void check_glb_depth(const std::filesystem::path& path) {
  // Magic word, version and size of the whole; then size and kind of its first part, the JSON; all of four bytes.
  constexpr std::size_t kHeader = 20, kJsonSize = 12;
  std::ifstream file(path, std::ios::binary);
  std::array<char, kHeader> header{};
  if (!file.read(header.data(), header.size())) {
    return;  // assimp says so.
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

void check_dae_depth(std::string_view text, const std::filesystem::path& path) {
  const std::vector<XmlTag> tags = scan_xml(text, path.string());
  std::map<std::string, std::size_t> named;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (tags[i].name == "node") {
      named.emplace(fmt::format("#{}", tags[i].attribute("id")), i);
    }
  }
  // A node hangs on what it stands in; and what an <instance_node> names, on that element.
  std::vector<Link> links;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (tags[i].parent >= 0) {
      links.push_back({static_cast<std::size_t>(tags[i].parent), i});
    }
    if (tags[i].name == "instance_node") {
      if (const auto target = named.find(tags[i].attribute("url")); target != named.end()) {
        links.push_back({i, target->second});
      }
    }
  }
  check_nodes(tags.size(), links, path);
}

}  // namespace insonify
