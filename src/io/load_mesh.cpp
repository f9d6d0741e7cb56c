// load_mesh.cpp -- mesh files through assimp, flattened into one mesh in metres with z up.

#include <assimp/config.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <limits>
#include <new>

#include "insonify/error.h"
#include "insonify/files.h"
#include "io/flatten_scene.h"
#include "io/input_file.h"
#include "io/mesh_file.h"

namespace insonify {
namespace {

constexpr std::array<std::string_view, 6> kEndings{".obj", ".stl", ".dae", ".ply", ".gltf", ".glb"};

// assimp skips a vertex, and so scrambles all that follow, if one of its numbers begins with its point.
std::string with_leading_zeros(const std::string& obj) {
  const auto is_vertex_line = [&](std::size_t at) {
    const std::size_t line_break = obj.rfind('\n', at);
    const std::size_t start = obj.find_first_not_of(" \t", line_break == std::string::npos ? 0 : line_break + 1);
    return obj[start] == 'v';
  };
  std::string mended;
  std::size_t copied = 0;
  for (std::size_t at = obj.find('.'); at != std::string::npos; at = obj.find('.', at + 1)) {
    if (at > 0 && (obj[at - 1] == ' ' || obj[at - 1] == '\t') && is_vertex_line(at)) {
      mended.append(obj, copied, at - copied).append("0");
      copied = at;
    }
  }
  return mended.append(obj, copied);
}

// Parses the file and no more. clean_mesh joins vertices and makes normals in linear time, and assimp cuts a concave
// polygon with a corner on a diagonal, such as a plain L, into triangles that overlap.
const aiScene& import(Assimp::Importer& importer, const std::filesystem::path& path, const std::string& ending) {
  constexpr unsigned kNoSteps = 0;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  if (ending == ".obj") {
    // From memory its material library is not found, which does not matter: materials keep their names.
    const std::string text = with_leading_zeros(read_text(path));
    importer.ReadFileFromMemory(text.data(), text.size(), kNoSteps, "obj");
  } else {
    importer.ReadFile(path.string(), kNoSteps);
  }

  const aiScene* scene = importer.GetScene();
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string reason = one_line(importer.GetErrorString());
    if (reason == std::bad_alloc().what()) {
      throw std::bad_alloc();
    }
    throw Error(
        fmt::format("{}: cannot be read: {}", path.string(),
                    reason.starts_with("No suitable reader") ? "what it holds is not " + ending.substr(1) : reason));
  }
  return *scene;
}

// Everything of the file that was asked for, as it is there.
FlattenedScene read(const std::filesystem::path& path, const std::string& submesh) {
  const std::string ending = ending_of(path);
  Assimp::Importer importer;
  const aiScene& scene = import(importer, path, ending);

  FlattenSettings settings{.path = path, .submesh = submesh};
  // STL has one normal a triangle, whatever was smooth before it was written.
  settings.keep_normals = ending != ".stl";
  if (ending == ".gltf" || ending == ".glb") {
    settings.mesh_from_file << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // y up to z up.
  }
  return flatten_scene(scene, settings);
}

void move_to_origin(Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& vertex : mesh.vertices) {
    box.extend(vertex);
  }
  const Vec3f center = box.center();
  for (Vec3f& vertex : mesh.vertices) {
    vertex -= center;
  }
}

// Far from their origin floats are coarse: survey coordinates of a seabed in a mesh file lose its shape.
void warn_of_rounding(const Mesh& mesh, const std::string& name, const Log& log) {
  constexpr float kCoarse = 0.01F;  // [m]: half a range bin of a fine sonar.
  float furthest = 0;
  for (const Vec3f& vertex : mesh.vertices) {
    furthest = std::max(furthest, vertex.cwiseAbs().maxCoeff());
  }
  const float rounding = furthest * std::numeric_limits<float>::epsilon();
  if (rounding > kCoarse) {
    log(Severity::kWarning, fmt::format("{}: coordinates as far as {:.0f} m from the origin are rounded to {:.2g} m; "
                                        "move the mesh nearer to it",
                                        name, furthest, rounding));
  }
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void tell(const MeshReport& report, std::size_t lines_and_points, const std::string& name, const Log& log) {
  std::vector<std::string> notes;
  if (report.dropped() > 0) {
    notes.push_back(report.text());
  }
  if (lines_and_points > 0) {
    notes.push_back(counted(lines_and_points, "line or point", "lines or points") + " dropped");
  }
  const bool is_loss = !notes.empty();
  if (report.normals_flipped > 0) {
    notes.push_back(counted(report.normals_flipped, "normal", "normals") + " turned to the side of their winding");
  }
  if (!notes.empty()) {
    log(is_loss ? Severity::kWarning : Severity::kInfo, fmt::format("{}: {}", name, fmt::join(notes, "; ")));
  }
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
  return std::ranges::count(kEndings, ending_of(path)) > 0;
}

std::string mesh_file_endings() {
  return fmt::format("{}", fmt::join(kEndings, ", "));
}

Mesh load_mesh_file(const std::filesystem::path& path, const Submesh& submesh, const Log& log) {
  check_input_file(path);
  if (!is_mesh_file(path)) {
    throw Error(fmt::format("{}: \"{}\" is no known ending of a mesh file; known: {}", path.string(),
                            path.extension().string(), mesh_file_endings()));
  }

  auto [mesh, lines_and_points] = read(path, submesh.name);
  if (mesh.triangles.empty()) {
    throw Error(fmt::format(
        "{}: no triangles{}", path.string(),
        lines_and_points > 0 ? ", only " + counted(lines_and_points, "line or point", "lines or points") : ""));
  }
  mesh.name = path.string();  // As clean_mesh's errors should name it.
  const MeshReport report = clean_mesh(mesh);
  mesh.name = path.stem().string();
  if (submesh.center) {
    move_to_origin(mesh);
  }

  if (log) {
    tell(report, lines_and_points, path.filename().string(), log);
    warn_of_rounding(mesh, path.filename().string(), log);
  }
  return mesh;
}

Mesh load_mesh(const std::filesystem::path& path, const Log& log) {
  return load_mesh_file(path, {}, log);
}

}  // namespace insonify
