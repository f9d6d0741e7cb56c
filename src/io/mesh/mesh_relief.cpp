// mesh_relief.cpp -- reads the maps that a mesh file gives a material, and those that a scenario names.

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <assimp/material.h>
#include <fmt/format.h>

#include <array>
#include <span>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/file/scene_folders.h"
#include "io/file/uri.h"
#include "io/mesh/relief_file.h"
#include "io/picture/picture_tile.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

struct Map {
  aiTextureType type;
  std::string name;  // As written in the file.
};

// assimp's texture type depends on the format: glTF, OBJ's `norm` and COLLADA's bump among the normals, OBJ's `bump`
// among the heights.
std::optional<Map> find_map(const aiMaterial& material) {
  for (const aiTextureType type : {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT}) {
    aiString name;
    if (material.GetTexture(type, 0, &name) == aiReturn_SUCCESS && name.length > 0) {
      return Map{type, name.C_Str()};
    }
  }
  return {};
}

fs::path find_picture(const std::string& name, const fs::path& mesh_path) {
  std::string plain = name;
  std::ranges::replace(plain, '\\', '/');
  const fs::path written = plain, folder = mesh_path.parent_path();
  const fs::path textures = folder / ".." / "materials" / "textures";  // The textures of the model that has the mesh.
  bool is_outside = false;
  std::error_code ignored;
  for (const fs::path& given : {written, fs::path(percent_decoded(plain))}) {
    for (const fs::path& candidate : {folder / given, folder / given.filename(), textures / given.filename()}) {
      if (!fs::is_regular_file(candidate, ignored)) {
        continue;
      }
      if (is_in_scene(candidate, mesh_path, textures)) {
        return candidate.lexically_normal();
      }
      is_outside = true;
    }
  }
  throw Error(fmt::format("{}{}", printable((folder / written).lexically_normal().string(), kLongestName),
                          is_outside ? std::string(" ") + kOutsideScene : ": no such file"));
}

PngReader open_picture(const aiScene& scene, const std::string& name, const fs::path& mesh_path) {
  if (const aiTexture* inside = scene.GetEmbeddedTexture(name.c_str())) {
    if (inside->mHeight != 0) {
      throw Error(
          fmt::format("{}: texture {} is not compressed; only PNG is read", mesh_path.string(), printable(name)));
    }
    return {fmt::format("{}: texture {}", mesh_path.string(), printable(name)),
            std::span(reinterpret_cast<const char*>(inside->pcData), inside->mWidth)};
  }
  return PngReader(find_picture(name, mesh_path));
}

float number_of(const aiMaterial& material, const char* key, aiTextureType type, float otherwise) {
  ai_real value = otherwise;
  return material.Get(key, type, 0, value) == aiReturn_SUCCESS ? value : otherwise;
}

Relief read(const aiScene& scene, const aiMaterial& material, const Map& map, const fs::path& mesh_path) {
  Relief relief;
  relief.tile_size = 0;
  const PngReader png = open_picture(scene, map.name, mesh_path);
  if (png.has_colours()) {
    relief.slopes = read_normals(png);
    const float strength = number_of(material, _AI_MATKEY_GLTF_SCALE_BASE, map.type, 1);
    for (Eigen::Vector2f& slope : relief.slopes.texels) {
      slope *= strength;
    }
    return relief;
  }
  const float height = number_of(material, _AI_MATKEY_OBJ_BUMPMULT_BASE, map.type, 1);
  if (height == 1 || !(height > 0)) {
    throw Error(png.name() + ": is a height map, but the material does not say how high (bump -bm METRES)");
  }
  relief.slopes = read_heights(png, static_cast<double>(height));
  relief.rise_per_tile = true;
  return relief;
}

}  // namespace

std::shared_ptr<const Relief> mesh_relief(const aiScene& scene, const aiMaterial& material, const fs::path& mesh_path,
                                          std::vector<std::string>& notes) {
  const std::optional<Map> map = find_map(material);
  if (!map) {
    return nullptr;
  }
  try {
    return std::make_shared<const Relief>(read(scene, material, *map, mesh_path));
  } catch (const Error& error) {
    notes.push_back(fmt::format("skipped the small normals of material {}: {}", printable(material.GetName().C_Str()),
                                error.what()));
    return nullptr;
  }
}

std::shared_ptr<const Relief> load_relief(const ReliefConfig& config, const std::filesystem::path& folder) {
  if (config.empty()) {
    return nullptr;
  }
  Relief relief;
  if (config.has_shape()) {
    relief = make_relief(config);
  } else {
    relief.by_position = config.tile_size > 0;
    relief.tile_size = relief.by_position ? config.tile_size : 1;
  }
  if (!config.normal_map.empty()) {
    relief.slopes = read_normals(PngReader(folder / config.normal_map));
    for (Eigen::Vector2f& slope : relief.slopes.texels) {
      slope *= static_cast<float>(config.normal_strength);
    }
  } else if (!config.height_map.empty()) {
    relief.slopes = read_heights(PngReader(folder / config.height_map), config.height);
    relief.rise_per_tile = true;
  }
  if (!config.reflectivity_map.empty()) {
    relief.reflectivity = read_levels(PngReader(folder / config.reflectivity_map), "a reflectivity map needs");
  }
  return std::make_shared<const Relief>(std::move(relief));
}

}  // namespace insonify
