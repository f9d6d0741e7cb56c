// mesh_file.h -- reads a whole mesh file or one named part of it.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "insonify/mesh.h"

namespace insonify {

/// The part of a mesh file to read: SDF's <submesh>.
struct Submesh {
  std::string name;     ///< Name of a node or a mesh in the file; "" for the whole file.
  bool center = false;  ///< Move the middle of its bounding box to the origin.
};

/// As load_mesh(path, log), for one part of the file.
/// @throws Error with the path, also for an unknown name; the message lists the known ones.
[[nodiscard]] Mesh load_mesh_file(const std::filesystem::path& path, const Submesh& submesh, const Log& log);

/// The named parts of a mesh file as meshes, in the order of the file, each with its name: OBJ's objects and groups
/// (those of equal names as one), nodes of DAE and glTF (the second of a name becomes NAME_2). A part without triangles
/// is left out.
[[nodiscard]] std::vector<Mesh> load_mesh_parts(const std::filesystem::path& path, const Log& log);

/// Whether the file name ends as that of a mesh does.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& path);

/// Endings of mesh files for messages: ".obj, .stl, ...".
[[nodiscard]] std::string mesh_file_endings();

}  // namespace insonify
