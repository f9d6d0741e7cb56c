// load_mesh.cpp -- has mesh files read, and cleans them: one mesh in metres with z up.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <span>

#include "base/log_line.h"
#include "base/utf8.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/file/reader_process.h"
#include "io/file/scene_folders.h"
#include "io/mesh/flatten_scene.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_read_ahead.h"

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
  return read_apart<FlattenedScene>({path, format}, ReaderTask::kMesh, path.string(), submesh, SceneFolders::current());
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

std::string count_text(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void log_report(const MeshReport& report, std::size_t lines_and_points, const std::string& name, const Log& log) {
  std::vector<std::string> notes;
  if (report.dropped() > 0) {
    notes.push_back(report.text());
  }
  if (lines_and_points > 0) {
    notes.push_back(count_text(lines_and_points, "line or point", "lines or points") + " dropped");
  }
  const bool is_loss = !notes.empty();
  if (report.normals_flipped > 0) {
    notes.push_back(count_text(report.normals_flipped, "normal", "normals") + " turned to the side of their winding");
  }
  if (!notes.empty()) {
    log_line(log, is_loss ? Severity::kWarning : Severity::kInfo, fmt::format("{}: {}", name, fmt::join(notes, "; ")));
  }
}

void log_notes(const FlattenedScene& scene, const std::string& name, const Log& log) {
  for (const std::string& note : scene.notes) {
    log_line(log, Severity::kWarning, fmt::format("{}: {}", name, note));
  }
}

void check_not_empty(const FlattenedScene& scene, const std::filesystem::path& path) {
  if (scene.mesh.triangles.empty()) {
    throw Error(fmt::format("{}: no triangles{}", path.string(),
                            scene.lines_and_points > 0
                                ? ", only " + count_text(scene.lines_and_points, "line or point", "lines or points")
                                : ""));
  }
}

Mesh load_and_clean(const std::filesystem::path& path, const Submesh& submesh, const Log& log) {
  FlattenedScene scene = read(path, submesh.name);
  check_not_empty(scene, path);
  Mesh& mesh = scene.mesh;
  mesh.name = path.string();  // For the messages of clean_mesh.
  const MeshReport report = clean_mesh(mesh);
  mesh.name = as_utf8(path.stem().string());
  if (submesh.center) {
    move_to_origin(mesh);
  }

  const std::string name = path.string();
  log_report(report, scene.lines_and_points, name, log);
  warn_of_rounding(mesh, name, log);
  log_notes(scene, name, log);
  return std::move(mesh);
}

// Some triangles of a scene as a mesh of their own, with their vertices and materials.
Mesh part_of(const FlattenedScene& scene, std::span<const std::size_t> triangles) {
  const Mesh& whole = scene.mesh;
  Mesh mesh;
  mesh.material_names.clear();
  std::map<std::uint32_t, std::uint32_t> vertices;  // New index by the old one.
  std::map<std::uint16_t, std::uint16_t> slots;
  for (const std::size_t i : triangles) {
    std::array<std::uint32_t, 3> triangle = whole.triangles[i];
    for (std::uint32_t& corner : triangle) {
      if (corner < whole.vertices.size()) {
        const auto [entry, is_new] = vertices.try_emplace(corner, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new) {
          mesh.vertices.push_back(whole.vertices[corner]);
          mesh.normals.push_back(whole.normals[corner]);
        }
        corner = entry->second;
      }
    }
    mesh.triangles.push_back(triangle);
    const std::uint16_t slot = whole.slot_of(i);
    const auto [entry, is_new] = slots.try_emplace(slot, static_cast<std::uint16_t>(slots.size()));
    if (is_new) {
      mesh.material_names.push_back(whole.material_names[slot]);
      mesh.reliefs.push_back(whole.reliefs.empty() ? nullptr : whole.reliefs[slot]);
    }
    mesh.material_slots.push_back(entry->second);
    if (!whole.texture_coordinates.empty()) {
      mesh.texture_coordinates.push_back(whole.texture_coordinates[i]);
    }
  }
  if (std::ranges::all_of(mesh.reliefs, [](const auto& relief) { return relief == nullptr; })) {
    mesh.reliefs.clear();
  }
  if (slots.size() == 1) {
    mesh.material_slots.clear();
  }
  return mesh;
}

// The mesh of another format that somebody has converted a file to: beside it, with its name.
std::optional<std::filesystem::path> converted_mesh(const std::filesystem::path& path) {
  std::error_code ignored;
  for (const std::string_view ending : kEndings) {
    std::filesystem::path beside = path;
    if (std::filesystem::is_regular_file(beside.replace_extension(ending), ignored)) {
      return beside;
    }
  }
  return std::nullopt;
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
      if (const std::optional<std::filesystem::path> beside = converted_mesh(path)) {
        log_line(log, Severity::kWarning,
                 fmt::format("{}: OpenSceneGraph's files are not read; {} beside it is", path.string(),
                             beside->filename().string()));
        return load_mesh_file(*beside, submesh, log);
      }
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
  if (MeshReadAhead* const ahead = MeshReadAhead::current()) {
    if (std::optional<Mesh> mesh = ahead->take(path, submesh, log)) {
      return std::move(*mesh);
    }
  }
  try {
    return load_and_clean(path, submesh, log);
  } catch (const std::bad_alloc&) {
    throw Error(path.string() + ": takes more memory than there is");
  }
}

std::vector<Mesh> load_mesh_parts(const std::filesystem::path& path, const Log& log) {
  check_input_file(path);
  const FlattenedScene scene = is_mesh_file(path) ? read(path, "") : FlattenedScene();
  if (scene.part_of_triangle.empty()) {
    Mesh whole = load_mesh(path, log);
    return {std::move(whole)};
  }
  check_not_empty(scene, path);
  std::vector<Mesh> parts;
  std::vector<std::vector<std::size_t>> triangles(scene.part_names.size());
  for (std::size_t i = 0; i < scene.part_of_triangle.size(); ++i) {
    triangles[scene.part_of_triangle[i]].push_back(i);
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i].empty()) {
      continue;
    }
    Mesh part = part_of(scene, triangles[i]);
    part.name = scene.part_names[i];
    const std::string name = fmt::format("{}: {}", path.string(), printable(part.name, kLongestName));
    try {
      log_report(clean_mesh(part), 0, name, log);
      parts.push_back(std::move(part));
    } catch (const Error& error) {
      log_line(log, Severity::kWarning, fmt::format("{}: {}", path.string(), error.what()));
    }
  }
  log_notes(scene, path.string(), log);
  if (parts.empty()) {
    throw Error(path.string() + ": no part has a triangle");
  }
  return parts;
}

Mesh load_mesh(const std::filesystem::path& path, const Log& log) {
  return load_mesh_file(path, {}, log);
}

}  // namespace insonify
