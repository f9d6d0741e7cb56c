// mesh_file.h -- mesh files as a scene needs them: whole, or one named part of them.

#pragma once

#include <filesystem>
#include <string>

#include "insonify/log.h"
#include "insonify/mesh.h"

namespace insonify {

/// What of a mesh file to take: SDF's <submesh>.
struct Submesh {
  std::string name;     ///< Of a node or of a mesh in the file; "" for the whole file.
  bool center = false;  ///< Move the middle of its bounding box to the origin.
};

/// As load_mesh(path, log), for one part of the file.
/// @throws Error with the path, also for a name that is not there; the message lists those that are.
[[nodiscard]] Mesh load_mesh_file(const std::filesystem::path& path, const Submesh& submesh, const Log& log);

/// Whether the file's ending is that of a mesh.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& path);

/// Endings of mesh files for messages: ".obj, .stl, ...".
[[nodiscard]] std::string mesh_file_endings();

}  // namespace insonify
