// flatten_scene.cpp -- walks over assimp's tree of nodes and copies their meshes into one.

#include "io/mesh/flatten_scene.h"

#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "base/utf8.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/mesh/import_scene.h"
#include "io/mesh/mesh_checks.h"
#include "io/mesh/ply_file.h"
#include "io/mesh/relief_file.h"
#include "io/mesh/triangulate.h"

namespace insonify {
namespace {

// Which part of a scene to use, and how.
struct FlattenSettings {
  std::filesystem::path path;  // For messages.
  std::string submesh;
  bool keep_normals = true;  // False: ignores the file's normals.
};

// A mesh of the file with the transform of a node that places it.
struct PlacedMesh {
  const aiMesh* mesh = nullptr;
  std::string node;
  std::size_t node_index = 0;  // In the order of the walk.
  Eigen::Affine3d mesh_from_part;
};

Eigen::Affine3d affine_from(const aiMatrix4x4& m) {
  Eigen::Affine3d affine;
  affine.matrix() << static_cast<double>(m.a1), static_cast<double>(m.a2), static_cast<double>(m.a3),
      static_cast<double>(m.a4), static_cast<double>(m.b1), static_cast<double>(m.b2), static_cast<double>(m.b3),
      static_cast<double>(m.b4), static_cast<double>(m.c1), static_cast<double>(m.c2), static_cast<double>(m.c3),
      static_cast<double>(m.c4), 0, 0, 0, 1;
  return affine;
}

void collect_parts(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& mesh_from_parent,
                   std::vector<PlacedMesh>& parts, std::size_t& node_count) {
  const std::size_t index = node_count++;
  const Eigen::Affine3d mesh_from_node = mesh_from_parent * affine_from(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    parts.push_back({scene.mMeshes[node.mMeshes[i]], node.mName.C_Str(), index, mesh_from_node});
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    collect_parts(scene, *node.mChildren[i], mesh_from_node, parts, node_count);
  }
}

// Keeps the parts whose node or mesh has the wanted name.
void choose_parts(std::vector<PlacedMesh>& parts, const FlattenSettings& settings) {
  const std::string& name = settings.submesh;
  std::set<std::string> names;
  for (const PlacedMesh& part : parts) {
    names.insert(printable(part.node.empty() ? part.mesh->mName.C_Str() : part.node));
  }
  std::erase_if(parts, [&](const PlacedMesh& part) { return part.node != name && part.mesh->mName.C_Str() != name; });
  if (parts.empty()) {
    throw Error(fmt::format("{}: no submesh \"{}\"; there are: {}", settings.path.string(), printable(name),
                            fmt::join(names, ", ")));
  }
}

// The name in the file; "" for the default material that assimp adds.
std::string material_name_of(const aiScene& scene, const aiMesh& mesh) {
  aiString name;
  if (mesh.mMaterialIndex >= scene.mNumMaterials ||
      scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name) != aiReturn_SUCCESS ||
      std::string_view(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME) {
    return "";
  }
  return as_utf8(name.C_Str());
}

std::array<Eigen::Vector2f, 3> no_texture_coordinates() {
  return {Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()};
}

// Appends parts to one mesh.
class Flattener {
 public:
  Flattener(ImportedScene imported, const FlattenSettings& settings)
      : scene_(imported.scene),
        lost_(std::move(imported.lost)),
        settings_(settings),
        notes_(std::move(imported.notes)) {
    mesh_.material_names.clear();
  }

  void reserve(const std::vector<PlacedMesh>& parts) {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (const PlacedMesh& part : parts) {
      vertices += part.mesh->mNumVertices;
      for (unsigned i = 0; i < part.mesh->mNumFaces; ++i) {
        triangles += std::max(part.mesh->mFaces[i].mNumIndices, 2U) - 2;
      }
    }
    check_budget(Budget::kTriangles, std::max(static_cast<double>(triangles), static_cast<double>(vertices) / 3),
                 settings_.path.string());
    mesh_.vertices.reserve(vertices);
    mesh_.normals.reserve(vertices);
    mesh_.triangles.reserve(triangles);
  }

  void add(const PlacedMesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    add_vertices(*part.mesh, part.mesh_from_part);
    // A mirroring transform reverses the winding; swapping two corners restores it.
    add_triangles(*part.mesh, first, part.mesh_from_part.linear().determinant() < 0);
    // Triangles that assimp has left out are there again, with corners that do not exist: clean_mesh counts them.
    if (const auto lost = lost_.find(part.mesh); lost != lost_.end()) {
      constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
      mesh_.triangles.resize(mesh_.triangles.size() + lost->second, {kNone, kNone, kNone});
    }
    part_of_triangle_.resize(mesh_.triangles.size(), part_index(part));
    add_slot(slot_of(material_name_of(scene_, *part.mesh)));
    add_relief(*part.mesh);
  }

  [[nodiscard]] FlattenedScene take() {
    if (mesh_.material_names.empty()) {
      mesh_.material_names.emplace_back();
    }
    if (!mesh_.texture_coordinates.empty()) {
      mesh_.texture_coordinates.resize(mesh_.triangles.size(), no_texture_coordinates());
    }
    if (!mesh_.reliefs.empty()) {
      mesh_.reliefs.resize(mesh_.material_names.size());
    }
    return {std::move(mesh_), lines_and_points_, std::move(notes_), std::move(part_names_),
            std::move(part_of_triangle_)};
  }

 private:
  // OBJ's groups of equal names are one part; of other formats each node is one.
  std::uint32_t part_index(const PlacedMesh& part) {
    const std::string given = as_utf8(part.node.empty() ? part.mesh->mName.C_Str() : part.node);
    const std::string name = given.empty() ? "part" : given;
    const bool is_obj = ending_of(settings_.path) == ".obj";
    const auto [entry, is_new] =
        parts_.try_emplace(is_obj ? name : std::to_string(part.node_index), static_cast<std::uint32_t>(parts_.size()));
    if (is_new) {
      const int count = ++names_[name];
      part_names_.push_back(count == 1 ? name : fmt::format("{}_{}", name, count));
    }
    return entry->second;
  }

  void add_vertices(const aiMesh& part, const Eigen::Affine3d& mesh_from_part) {
    // Normals are transformed by the matrix of cofactors: the inverse transpose times the determinant, which may be 0.
    const Eigen::Matrix3d& m = mesh_from_part.linear();
    Eigen::Matrix3d cofactors;
    cofactors << m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0)), m.col(0).cross(m.col(1));
    if (m.determinant() < 0) {
      cofactors = -cofactors;
    }

    const bool has_normals = settings_.keep_normals && part.mNormals != nullptr;
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& at = part.mVertices[i];
      mesh_.vertices.push_back(Vec3f((mesh_from_part * Vec3f(at.x, at.y, at.z).cast<double>()).cast<float>()));
      if (has_normals) {
        const aiVector3D& normal = part.mNormals[i];
        const Vec3 turned = cofactors * Vec3f(normal.x, normal.y, normal.z).cast<double>();
        mesh_.normals.push_back(Vec3f(turned.normalized().cast<float>()));
      } else {
        mesh_.normals.push_back(Vec3f::Zero());  // clean_mesh computes it.
      }
    }
  }

  void add_triangles(const aiMesh& part, std::uint32_t first, bool mirrored) {
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const std::span<const unsigned> face(part.mFaces[i].mIndices, part.mFaces[i].mNumIndices);
      if (face.size() < 3) {
        ++lines_and_points_;
        continue;
      }
      cut(part, face);
      for (const auto& [a, b, c] : cut_) {
        if (part.mTextureCoords[0] != nullptr) {
          const auto at = [&](std::uint32_t corner) { return texture_at(part, face[corner]); };
          mesh_.texture_coordinates.resize(mesh_.triangles.size(), no_texture_coordinates());
          mesh_.texture_coordinates.push_back(mirrored ? std::array{at(a), at(c), at(b)}
                                                       : std::array{at(a), at(b), at(c)});
        }
        const auto index = [&](std::uint32_t corner) { return index_in_mesh(part, first, face[corner]); };
        mesh_.triangles.push_back(mirrored ? std::array{index(a), index(c), index(b)}
                                           : std::array{index(a), index(b), index(c)});
      }
    }
  }

  static Eigen::Vector2f texture_at(const aiMesh& part, unsigned index) {
    if (index >= part.mNumVertices) {
      return Eigen::Vector2f::Zero();
    }
    const aiVector3D& at = part.mTextureCoords[0][index];
    return std::isfinite(at.x) && std::isfinite(at.y) ? Eigen::Vector2f(at.x, at.y) : Eigen::Vector2f::Zero();
  }

  // An index beyond its part must not refer to the next part.
  static std::uint32_t index_in_mesh(const aiMesh& part, std::uint32_t first, unsigned index) {
    return index < part.mNumVertices ? first + index : std::numeric_limits<std::uint32_t>::max();
  }

  void cut(const aiMesh& part, std::span<const unsigned> face) {
    corners_.clear();
    for (const unsigned index : face) {
      const aiVector3D at = index < part.mNumVertices ? part.mVertices[index] : aiVector3D();
      corners_.emplace_back(at.x, at.y, at.z);
    }
    triangulate(corners_, cut_);
  }

  std::uint16_t slot_of(const std::string& name) {
    const std::size_t next = mesh_.material_names.size();
    const auto [entry, is_new] = slots_.try_emplace(name, static_cast<std::uint16_t>(next));
    if (is_new) {
      check_material_count(next + 1, settings_.path);
      mesh_.material_names.push_back(name);
    }
    return entry->second;
  }

  // Sets the slot of the triangles added last. No slots are stored as long as all are 0.
  void add_slot(std::uint16_t slot) {
    if (slot != 0 || !mesh_.material_slots.empty()) {
      mesh_.material_slots.reserve(mesh_.triangles.capacity());
      mesh_.material_slots.resize(slots_added_, 0);
      mesh_.material_slots.resize(mesh_.triangles.size(), slot);
    }
    slots_added_ = mesh_.triangles.size();
  }

  // Reads the relief of the slot added last, the first time that a part with texture coordinates uses it.
  void add_relief(const aiMesh& part) {
    if (part.mTextureCoords[0] == nullptr || part.mMaterialIndex >= scene_.mNumMaterials ||
        !seen_.insert(part.mMaterialIndex).second) {
      return;
    }
    const aiMaterial& material = *scene_.mMaterials[part.mMaterialIndex];
    if (std::shared_ptr<const Relief> relief = mesh_relief(scene_, material, settings_.path, notes_)) {
      mesh_.reliefs.resize(mesh_.material_names.size());
      mesh_.reliefs[slots_.at(material_name_of(scene_, part))] = std::move(relief);
    }
  }

  const aiScene& scene_;
  std::map<const aiMesh*, std::size_t> lost_;
  const FlattenSettings& settings_;
  Mesh mesh_;
  std::map<std::string, std::uint16_t> slots_;  // By material name.
  std::set<unsigned> seen_;                     // Materials whose maps have been read.
  std::vector<std::string> notes_;
  std::map<std::string, std::uint32_t> parts_;  // By name, or number of the node.
  std::map<std::string, int> names_;            // How many parts have a name.
  std::vector<std::string> part_names_;
  std::vector<std::uint32_t> part_of_triangle_;
  std::size_t slots_added_ = 0;
  std::size_t lines_and_points_ = 0;
  std::vector<Vec3f> corners_;                     // Corners of the present face,
  std::vector<std::array<std::uint32_t, 3>> cut_;  // and its triangles.
};

}  // namespace

FlattenedScene read_mesh(const std::filesystem::path& path, const std::string& submesh) {
  const std::string ending = ending_of(path);
  if (ending == ".ply") {
    if (!submesh.empty()) {
      throw Error(fmt::format("{}: no submesh \"{}\"; PLY files have no parts", path.string(), printable(submesh)));
    }
    return read_ply(path);
  }
  Assimp::Importer importer;
  ImportedScene imported = import_scene(importer, path);
  const aiScene& scene = imported.scene;
  // STL stores one normal per triangle, also for surfaces that were smooth.
  const FlattenSettings settings{.path = path, .submesh = submesh, .keep_normals = ending != ".stl"};
  Eigen::Affine3d mesh_from_file = Eigen::Affine3d::Identity();
  if (ending == ".gltf" || ending == ".glb") {
    mesh_from_file.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // y up to z up.
  }
  std::vector<PlacedMesh> parts;
  std::size_t node_count = 0;
  collect_parts(scene, *scene.mRootNode, mesh_from_file, parts, node_count);
  if (!settings.submesh.empty()) {
    choose_parts(parts, settings);
  }

  Flattener flattener(std::move(imported), settings);
  flattener.reserve(parts);
  for (const PlacedMesh& part : parts) {
    flattener.add(part);
  }
  return flattener.take();
}

}  // namespace insonify
