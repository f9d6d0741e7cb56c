// load_mesh.cpp -- has mesh files read, and cleans them: one mesh in metres with z up.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <new>
#include <set>

#include "base/log_line.h"
#include "base/utf8.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "io/file/input_file.h"
#include "io/file/reader_process.h"
#include "io/mesh/flatten_scene.h"
#include "io/mesh/mesh_file.h"

namespace insonify {
namespace {

constexpr std::array<std::string_view, 6> kEndings{".obj", ".stl", ".dae", ".ply", ".gltf", ".glb"};

// Reads the wanted part of the file, not yet cleaned.
FlattenedScene read(const std::filesystem::path& path, const std::string& submesh) {
  if (reads_here()) {
    return read_mesh(path, submesh);
  }
  std::string format = ending_of(path).substr(1);
  std::ranges::transform(format, format.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
  return read_apart<FlattenedScene>({path, format}, ReaderTask::kMesh, path.string(), submesh);
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

// Single precision is too coarse for survey coordinates: a seabed in such a mesh file loses its shape.
void warn_of_rounding(const Mesh& mesh, const std::string& name, const Log& log) {
  constexpr float kCoarse = 0.01F;  // [m]: half a range bin of a fine sonar.
  float furthest = 0;
  for (const Vec3f& vertex : mesh.vertices) {
    furthest = std::max(furthest, vertex.cwiseAbs().maxCoeff());
  }
  const float rounding = furthest * std::numeric_limits<float>::epsilon();
  if (rounding > kCoarse) {
    log_line(log, Severity::kWarning,
             fmt::format("{}: coordinates as far as {:.0f} m from the origin are rounded to {:.2g} m; "
                         "move the mesh nearer to it",
                         name, furthest, rounding));
  }
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void log_report(const MeshReport& report, std::size_t lines_and_points, const std::string& name, const Log& log) {
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
    log_line(log, is_loss ? Severity::kWarning : Severity::kInfo, fmt::format("{}: {}", name, fmt::join(notes, "; ")));
  }
}

Mesh load_and_clean(const std::filesystem::path& path, const Submesh& submesh, const Log& log) {
  auto [mesh, lines_and_points, notes] = read(path, submesh.name);
  if (mesh.triangles.empty()) {
    throw Error(fmt::format(
        "{}: no triangles{}", path.string(),
        lines_and_points > 0 ? ", only " + counted(lines_and_points, "line or point", "lines or points") : ""));
  }
  mesh.name = path.string();  // For the messages of clean_mesh.
  const MeshReport report = clean_mesh(mesh);
  mesh.name = as_utf8(path.stem().string());
  if (submesh.center) {
    move_to_origin(mesh);
  }

  const std::string name = path.string();
  log_report(report, lines_and_points, name, log);
  warn_of_rounding(mesh, name, log);
  for (const std::string& note : notes) {
    log_line(log, Severity::kWarning, fmt::format("{}: {}", name, note));
  }
  return mesh;
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
    static const std::set<std::string> kOpenSceneGraph = {".osgb", ".osg", ".osgt", ".ive"};
    if (kOpenSceneGraph.contains(ending_of(path))) {
      const std::string stem = path.stem().string();
      throw Error(fmt::format("{0}: OpenSceneGraph's files are not read; convert it: osgconv {1} {2}.obj",
                              path.string(), path.filename().string(), stem));
    }
    throw Error(fmt::format("{}: \"{}\" is not a known extension of a mesh file; known: {}", path.string(),
                            path.extension().string(), mesh_file_endings()));
  }

  if (is_stream(path)) {
    throw Error(path.string() + ": is not a regular file");
  }
  try {
    return load_and_clean(path, submesh, log);
  } catch (const std::bad_alloc&) {
    throw Error(path.string() + ": takes more memory than there is");
  }
}

Mesh load_mesh(const std::filesystem::path& path, const Log& log) {
  return load_mesh_file(path, {}, log);
}

}  // namespace insonify
