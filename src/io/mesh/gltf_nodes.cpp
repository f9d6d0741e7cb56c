// gltf_nodes.cpp -- what the nodes of a glTF file amount to, before they are unfolded.

#include <fmt/format.h>

#include <algorithm>

#include "io/file/budgets.h"
#include "io/mesh/gltf_file.h"
#include "io/mesh/node_graph.h"

namespace insonify {
namespace {

using nlohmann::json;

// What counts as triangles for Budget: a mesh may have more vertices than they need.
double size_of_mesh(const GltfFile& file, const json& mesh) {
  double size = 0;
  for (const json& primitive : mesh.value("primitives", json::array())) {
    const json attributes = primitive.value("attributes", json::object());
    const std::size_t vertices = attributes.contains("POSITION")
                                     ? file.whole(file.at("accessors", file.whole(attributes, "POSITION")), "count")
                                     : 0;
    size += std::max(static_cast<double>(triangle_count(file, primitive)), static_cast<double>(vertices) / 3);
  }
  return size;
}

}  // namespace

std::size_t triangle_count(const GltfFile& file, const json& primitive) {
  constexpr std::size_t kTriangles = 4;
  const std::size_t mode = file.whole(primitive, "mode", kTriangles);
  const json attributes = primitive.value("attributes", json::object());
  if (mode < kTriangles || !attributes.contains("POSITION")) {
    return 0;
  }
  const std::size_t accessor =
      primitive.contains("indices") ? file.whole(primitive, "indices") : file.whole(attributes, "POSITION");
  const std::size_t corners = file.whole(file.at("accessors", accessor), "count");
  return mode == kTriangles ? (corners + 2) / 3 : std::max<std::size_t>(corners, 2) - 2;
}

void check_gltf_nodes(GltfFile& file, const std::filesystem::path& path) {
  const std::size_t count = file.list("nodes").size();
  const auto indices_of = [&](const json& owner, const char* key) {
    std::vector<std::size_t> indices;
    for (const json& index : owner.value(key, json::array())) {
      if (index.is_number_unsigned() && index.get<std::size_t>() < count) {
        indices.push_back(index.get<std::size_t>());
      }
    }
    return indices;
  };
  std::vector<double> meshes;
  double all_meshes = 0;
  for (const json& mesh : file.list("meshes")) {
    meshes.push_back(size_of_mesh(file, mesh));
    all_meshes += meshes.back();
  }
  check_budget(Budget::kTriangles, all_meshes, path.string());
  NodeGraph graph;
  for (const json& node : file.list("nodes")) {
    const std::size_t mesh = file.whole(node, "mesh", static_cast<long>(meshes.size()));
    graph.nodes.push_back({fmt::format("nodes[{}]", graph.nodes.size()), indices_of(node, "children"),
                           mesh < meshes.size() ? meshes[mesh] : 0});
  }
  for (const json& scene : file.list("scenes")) {
    graph.roots.push_back(indices_of(scene, "nodes"));
  }
  check_node_graph(graph, path);
}

}  // namespace insonify
