// mend_gltf.cpp -- changes the JSON of a glTF file: extensions, vertices, URIs, looks.

#include "io/mesh/mend_gltf.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <set>
#include <span>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/file/scene_folders.h"
#include "io/file/uri.h"
#include "io/mesh/gltf_file.h"

namespace insonify {
namespace {

using nlohmann::json;

// Extensions without which a file has the same shape, by the beginnings of their names, and those that are read here.
bool is_read_or_has_no_shape(const std::string& extension) {
  static const std::set<std::string> kRead = {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing"};
  constexpr std::string_view kWithoutShape[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_",   "MSFT_texture_",
                                                "KHR_lights_",    "EXT_lights_",  "KHR_animation_", "KHR_xmp"};
  return kRead.contains(extension) || std::ranges::any_of(kWithoutShape, [&](std::string_view start) {
           return std::string_view(extension).starts_with(start);
         });
}

void check_required_extensions(const GltfFile& file, const std::filesystem::path& path) {
  for (const json& extension : file.json.value("extensionsRequired", json::array())) {
    const std::string name = extension.get<std::string>();
    if (!is_read_or_has_no_shape(name)) {
      throw Error(fmt::format("{}: requires the glTF extension {}, which is not read", path.string(), printable(name)));
    }
  }
}

// ---------------------------------------------------------------- Nodes

// Attribute of instances: one vector for each; empty if it is not given.
std::vector<float> instance_numbers(GltfFile& file, const json& attributes, const char* name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? std::vector<float>() : file.numbers(file.whole(attributes, name));
}

// Gives a node with EXT_mesh_gpu_instancing a child for each instance.
void place_instances(GltfFile& file, std::size_t index, const std::filesystem::path& path) {
  const json::json_pointer pointer("/extensions/EXT_mesh_gpu_instancing/attributes");
  const json node = file.list("nodes")[index];
  if (!node.contains(pointer) || !node.contains("mesh")) {
    return;
  }
  const json& attributes = node.at(pointer);
  const auto positions = instance_numbers(file, attributes, "TRANSLATION");
  auto turns = instance_numbers(file, attributes, "ROTATION");
  const auto scales = instance_numbers(file, attributes, "SCALE");
  const std::size_t count = std::max({positions.size() / 3, turns.size() / 4, scales.size() / 3});
  const auto is_whole = [count](std::size_t size, std::size_t each) { return size == 0 || size == count * each; };
  if (!is_whole(positions.size(), 3) || !is_whole(turns.size(), 4) || !is_whole(scales.size(), 3)) {
    throw Error(
        fmt::format("{}: the instances of nodes[{}] have attributes of different counts", path.string(), index));
  }
  check_budget(Budget::kInstances, static_cast<double>(count), path.string());
  json children = node.value("children", json::array());
  json& nodes = file.list("nodes");
  for (std::size_t i = 0; i < count; ++i) {
    json child = {{"name", node.value("name", std::string())}, {"mesh", node["mesh"]}};
    const auto part = [i](const std::vector<float>& all, std::size_t each) {
      return std::vector<float>(all.begin() + static_cast<long>(i * each),
                                all.begin() + static_cast<long>((i + 1) * each));
    };
    if (!positions.empty()) {
      child["translation"] = part(positions, 3);
    }
    if (!turns.empty()) {
      Eigen::Map<Eigen::Vector4f> turn(&turns[i * 4]);
      turn.normalize();
      child["rotation"] = part(turns, 4);
    }
    if (!scales.empty()) {
      child["scale"] = part(scales, 3);
    }
    children.push_back(nodes.size());
    nodes.push_back(std::move(child));
  }
  nodes[index].erase("mesh");
  nodes[index]["children"] = std::move(children);
}

// ---------------------------------------------------------------- Vertices

// Converts accessors, and keeps the results in a buffer of their own.
class Converter {
 public:
  Converter(GltfFile& file, std::string& bytes) : file_(file), bytes_(bytes) {}

  // The accessor to use instead, itself if assimp reads it right.
  std::size_t converted(std::size_t index) {
    const json accessor = file_.at("accessors", index);
    constexpr int kFloat = 5126;
    if (accessor.value("componentType", 0) == kFloat && !accessor.contains("sparse") &&
        accessor.contains("bufferView")) {
      return index;
    }
    const auto [entry, is_new] = known_.try_emplace(index, file_.list("accessors").size());
    if (is_new) {
      const std::vector<float> numbers = file_.numbers(index);
      const std::size_t size = numbers.size() * sizeof(float);
      json& views = file_.list("bufferViews");
      file_.list("accessors")
          .push_back({{"bufferView", views.size()},
                      {"componentType", kFloat},
                      {"count", accessor["count"]},
                      {"type", accessor["type"]}});
      views.push_back({{"buffer", file_.list("buffers").size()}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
      bytes_.append(reinterpret_cast<const char*>(numbers.data()), size);
    }
    return entry->second;
  }

 private:
  GltfFile& file_;
  std::string& bytes_;
  std::map<std::size_t, std::size_t> known_;
};

// Keeps the attributes that are used.
json kept_attributes(const json& primitive, GltfFile& file, Converter& converter) {
  json kept = json::object();
  const json attributes = primitive.value("attributes", json::object());
  for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0"}) {
    if (attributes.contains(name)) {
      kept[name] = converter.converted(file.whole(attributes, name));
    }
  }
  return kept;
}

void mend_meshes(GltfFile& file, std::string& numbers, MendedGltf& mended) {
  Converter converter(file, numbers);
  for (json& mesh : file.list("meshes")) {
    json primitives = json::array();
    for (const json& primitive : mesh.value("primitives", json::array())) {
      mended.triangles.push_back(triangle_count(file, primitive));
      json kept = {{"attributes", kept_attributes(primitive, file, converter)}};
      for (const char* key : {"indices", "mode", "material"}) {
        if (primitive.contains(key)) {
          kept[key] = primitive[key];
        }
      }
      primitives.push_back(std::move(kept));
    }
    mesh = {{"name", mesh.value("name", std::string())}, {"primitives", std::move(primitives)}};
  }
}

// ---------------------------------------------------------------- Looks and URIs

// A material with no more than its name and its normal map, if that is there.
json kept_material(const json& material, const GltfFile& file) {
  json kept = {{"name", material.value("name", std::string())}};
  const json map = material.value("normalTexture", json::object());
  try {
    (void)file.at("images", file.whole(file.at("textures", file.whole(map, "index")), "source"));
    kept["normalTexture"] = map;
  } catch (const Error&) {
    // A look that cannot be found.
  }
  return kept;
}

void leave_out_what_has_no_shape(GltfFile& file) {
  for (json& material : file.list("materials")) {
    material = kept_material(material, file);
  }
  for (json& texture : file.list("textures")) {
    texture = texture.contains("source") ? json{{"source", texture["source"]}} : json::object();
  }
  for (json& node : file.list("nodes")) {
    for (const char* key : {"camera", "skin", "weights", "extensions", "extras"}) {
      node.erase(key);
    }
  }
  for (const char* key :
       {"animations", "cameras", "extensions", "extensionsRequired", "extensionsUsed", "extras", "samplers", "skins"}) {
    file.json.erase(key);
  }
}

// The path that a URI names; the URI itself where only a file of that name exists, or for data.
std::string path_of_uri(const std::string& uri, const std::filesystem::path& folder) {
  const std::string decoded = percent_decoded(uri);
  std::error_code ignored;
  const bool stays = uri.starts_with("data:") || (!std::filesystem::exists(folder / decoded, ignored) &&
                                                  std::filesystem::exists(folder / uri, ignored));
  return stays ? uri : decoded;
}

void decode_uris(GltfFile& file, const std::filesystem::path& path) {
  for (const char* name : {"buffers", "images"}) {
    for (json& entry : file.list(name)) {
      if (entry.contains("uri")) {
        entry["uri"] = path_of_uri(entry["uri"].get<std::string>(), path.parent_path());
      }
    }
  }
  for (const json& buffer : file.list("buffers")) {
    const std::string uri = buffer.value("uri", std::string());
    const std::filesystem::path named = path.parent_path() / uri;
    std::error_code ignored;
    if (!uri.starts_with("data:") && std::filesystem::exists(named, ignored) && !is_in_scene(named, path)) {
      throw Error(fmt::format("{}: '{}' {}", path.string(), printable(uri), kOutsideScene));
    }
  }
}

// Buffers that are not files, and the converted numbers as the last one, become files in memory.
void name_buffers(GltfFile& file, std::string numbers, MendedGltf& mended) {
  json& buffers = file.list("buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const std::string uri = buffers[i].value("uri", std::string());
    if (uri.empty() || uri.starts_with("data:")) {
      const std::string name = fmt::format("insonify-buffer-{}.bin", i);
      mended.buffers[name] = file.buffer(i);
      buffers[i]["uri"] = name;
    }
  }
  if (!numbers.empty()) {
    const std::string name = "insonify-numbers.bin";
    buffers.push_back({{"uri", name}, {"byteLength", numbers.size()}});
    mended.buffers[name] = std::move(numbers);
  }
}

}  // namespace

MendedGltf mend_gltf(const std::filesystem::path& path) {
  try {
    GltfFile file(path);
    MendedGltf mended;
    if (file.json.value(json::json_pointer("/asset/version"), std::string()).starts_with('1')) {
      return mended;
    }
    check_required_extensions(file, path);
    decode_uris(file, path);
    for (std::size_t i = 0, count = file.list("nodes").size(); i < count; ++i) {
      place_instances(file, i, path);
    }
    check_gltf_nodes(file, path);
    std::string numbers;
    mend_meshes(file, numbers, mended);
    leave_out_what_has_no_shape(file);
    name_buffers(file, std::move(numbers), mended);
    mended.json = file.json.dump();
    return mended;
  } catch (const json::exception& error) {
    const std::string reason = error.what();  // "[json.exception.type_error.302] type must be string, but is number"
    throw Error(fmt::format("{}: is not glTF 2.0: {}", path.string(),
                            foreign_reason(reason.substr(std::min(reason.find("] ") + 2, reason.size())))));
  }
}

}  // namespace insonify
