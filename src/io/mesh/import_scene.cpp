// import_scene.cpp -- checks mesh files, corrects texts that assimp would misread, and passes them to assimp.

#include "io/mesh/import_scene.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <fmt/format.h>

#include <array>
#include <fstream>
#include <new>
#include <set>
#include <string>

#include "insonify/error.h"
#include "io/file/input_file.h"
#include "io/mesh/mesh_checks.h"

namespace insonify {
namespace {

bool has_byte_order_mark(const std::filesystem::path& path) {
  std::array<char, kByteOrderMark.size()> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return std::string_view(start.data(), start.size()) == kByteOrderMark;
}

// Gives assimp a text in memory when it opens the mesh file. Other files, such as buffers and material libraries, are
// opened as usual.
class TextForFile : public Assimp::DefaultIOSystem {
 public:
  TextForFile(std::string path, std::string_view text) : path_(std::move(path)), text_(text) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (path_ == file) {
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text_.data()), text_.size());
    }
    return DefaultIOSystem::Open(file, mode);
  }

 private:
  std::string path_;
  std::string_view text_;
};

// Checks the file. Returns the text to read instead of it, or "" if assimp can read the file itself.
std::string check_and_mend(const std::filesystem::path& path, const std::string& ending) {
  const bool has_mark = has_byte_order_mark(path);
  if (ending == ".stl") {
    check_stl(path);
  } else if (ending == ".ply") {
    check_ply(path);
  }
  const bool is_checked_as_text = ending == ".obj" || ending == ".dae";
  if (!is_checked_as_text && (!has_mark || ending == ".stl")) {  // assimp skips the mark of an STL itself.
    return "";
  }
  std::string text = read_text(path);
  text.erase(0, has_mark ? kByteOrderMark.size() : 0);
  if (ending == ".obj") {
    return mend_obj(text, path);
  }
  if (ending == ".dae") {
    check_dae(text, path);
  }
  return has_mark ? text : "";
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
const aiScene& import_scene(Assimp::Importer& importer, const std::filesystem::path& path) {
  constexpr unsigned kNoSteps = 0;
  const std::string ending = ending_of(path);
  const std::string text = check_and_mend(path, ending);
  keep_readers_of(ending, importer);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  if (!text.empty()) {
    importer.SetIOHandler(new TextForFile(path.string(), text));
  }
  importer.ReadFile(path.string(), kNoSteps);
  importer.SetIOHandler(new Assimp::DefaultIOSystem);  // Deletes the TextForFile.

  const aiScene* scene = importer.GetScene();
  if (scene == nullptr || scene->mRootNode == nullptr) {
    // assimp's messages may quote the rest of the file after a line break.
    const std::string message = importer.GetErrorString();
    throw_refusal(foreign_reason(message.substr(0, message.find('\n'))), path, ending, text);
  }
  return *scene;
}

}  // namespace insonify
