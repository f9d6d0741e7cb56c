// import_scene.cpp -- checks mesh files, corrects texts that assimp would misread, and passes them to assimp.

#include "io/mesh/import_scene.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <new>
#include <set>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/file/scene_folders.h"
#include "io/mesh/mend_gltf.h"
#include "io/mesh/mesh_checks.h"

namespace insonify {
namespace {

// Files by the names under which assimp opens them, in whatever folder. The mesh file itself has its whole path.
using FilesInMemory = std::map<std::string, std::string>;

// Opens files in memory; others, such as buffers and material libraries, if the scene may name them.
class MemoryFirst : public Assimp::DefaultIOSystem {
 public:
  /// @param outside  Receives files that the scene may not name, which are not opened.
  MemoryFirst(const FilesInMemory& files, const std::filesystem::path& mesh, std::set<std::string>& outside)
      : files_(files), mesh_(mesh), is_obj_(ending_of(mesh) == ".obj"), outside_(outside) {}

  bool Exists(const char* file) const override { return find(file) != nullptr || DefaultIOSystem::Exists(file); }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (const std::string* text = find(file)) {
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text->data()), text->size());
    }
    if (DefaultIOSystem::Exists(file) && !is_in_scene(file, mesh_)) {
      outside_.emplace(file);
      return nullptr;
    }
    // The mesh itself is in memory, so that what else an OBJ opens is its library of materials.
    return is_obj_ && DefaultIOSystem::Exists(file) ? open_library(file) : DefaultIOSystem::Open(file, mode);
  }

 private:
  static Assimp::IOStream* open_library(const char* file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text = mend_mtl(std::string(std::istreambuf_iterator<char>(stream), {}));
    auto* bytes = new std::uint8_t[text.size()];  // The stream deletes them.
    std::ranges::copy(text, bytes);
    return new Assimp::MemoryIOStream(bytes, text.size(), true);
  }

  [[nodiscard]] const std::string* find(const std::string& file) const {
    auto found = files_.find(file);
    found = found == files_.end() ? files_.find(std::filesystem::path(file).filename().string()) : found;
    return found == files_.end() ? nullptr : &found->second;
  }

  const FilesInMemory& files_;
  const std::filesystem::path& mesh_;
  bool is_obj_;
  std::set<std::string>& outside_;
};

// What assimp is given in place of a file.
struct MendedFile {
  std::string name;  // Under which it is in `files`, with the format's ending.
  FilesInMemory files;
  std::vector<std::size_t> triangles;  // By mesh; empty if they are not known.
  std::vector<std::string> notes;
};

// Checks and corrects the file. `files` stays empty if assimp can read the file itself.
MendedFile check_and_mend(const std::filesystem::path& path, const std::string& ending) {
  MendedFile mended{path.string(), {}, {}, {}};
  if (ending == ".gltf" || ending == ".glb") {
    MendedGltf gltf = mend_gltf(path);
    if (!gltf.json.empty()) {
      mended.name = path.string() + (ending == ".glb" ? ".gltf" : "");
      mended.files = std::move(gltf.buffers);
      mended.files[mended.name] = std::move(gltf.json);
      mended.triangles = std::move(gltf.triangles);
    }
    return mended;
  }
  std::string text = ending == ".stl" ? mend_stl(path, mended.notes) : read_text(path);
  text.erase(0, ending != ".stl" && text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  if (ending == ".obj") {
    text = mend_obj(text, path);
  } else if (ending == ".dae") {
    text = mend_dae(std::move(text), path);
  }
  mended.files.emplace(mended.name, std::move(text));
  return mended;
}

// Number of triangles that assimp has left out, by mesh. It makes one mesh of each primitive.
std::map<const aiMesh*, std::size_t> lost_triangles(const aiScene& scene, const std::vector<std::size_t>& triangles) {
  std::map<const aiMesh*, std::size_t> lost;
  for (std::size_t i = 0; i < triangles.size() && triangles.size() == scene.mNumMeshes; ++i) {
    if (triangles[i] > scene.mMeshes[i]->mNumFaces) {
      lost[scene.mMeshes[i]] = triangles[i] - scene.mMeshes[i]->mNumFaces;
    }
  }
  return lost;
}

// Throws an Error with assimp's reason, or with the faulty line of an OBJ.
[[noreturn]] void throw_refusal(const std::string& reason, const std::filesystem::path& path, const std::string& ending,
                                const std::string& text) {
  if (reason == std::bad_alloc().what()) {
    throw std::bad_alloc();
  }
  if (ending == ".obj") {
    check_obj_indices(text, path);
  }
  throw Error(
      fmt::format("{}: cannot be read: {}", path.string(),
                  reason.starts_with("No suitable reader") ? "what it holds is not " + ending.substr(1) : reason));
}

// Removes all readers but those for this ending. When its reader refuses a file, assimp tries every other reader whose
// signature matches; for these formats the file has not been checked here.
void keep_readers_of(const std::string& ending, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* reader = importer.GetImporter(i);
    std::set<std::string> endings;
    reader->GetExtensionList(endings);
    if (!endings.contains(ending.substr(1))) {
      importer.UnregisterLoader(reader);
      delete reader;  // Unregistering transfers ownership.
    }
  }
}

}  // namespace

// No post-processing: clean_mesh joins vertices and computes normals in linear time, and assimp triangulates a concave
// polygon with a corner on a diagonal, such as an L, into triangles that overlap.
ImportedScene import_scene(Assimp::Importer& importer, const std::filesystem::path& path) {
  constexpr unsigned kNoSteps = 0;
  const std::string ending = ending_of(path);
  MendedFile mended = check_and_mend(path, ending);
  keep_readers_of(ending, importer);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  std::set<std::string> outside;
  importer.SetIOHandler(new MemoryFirst(mended.files, path, outside));
  importer.ReadFile(mended.name, kNoSteps);
  importer.SetIOHandler(new Assimp::DefaultIOSystem);  // Deletes the other one.

  for (const std::string& file : outside) {
    mended.notes.push_back(fmt::format("'{}' {}", printable(file, kLongestName), kOutsideScene));
  }
  const aiScene* scene = importer.GetScene();
  if (scene == nullptr && !outside.empty()) {
    throw Error(fmt::format("{}: {}", path.string(), mended.notes.back()));
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    // assimp's messages may quote the rest of the file after a line break.
    const std::string message = importer.GetErrorString();
    throw_refusal(foreign_reason(message.substr(0, message.find('\n'))), path, ending, mended.files[mended.name]);
  }
  return {*scene, lost_triangles(*scene, mended.triangles), std::move(mended.notes)};
}

}  // namespace insonify
