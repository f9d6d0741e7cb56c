// mend_gltf.h -- rewrites glTF files into what assimp reads right.

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace insonify {

/// A glTF file for assimp 5.2.
struct MendedGltf {
  std::string json;                            ///< "" if assimp is to read the file itself: glTF 1.0.
  std::map<std::string, std::string> buffers;  ///< Files in memory, by the names by which the JSON refers to them.
  std::vector<std::size_t> triangles;  ///< Number of triangles of each primitive, in order; 0 for lines and points.
};

/// Converts vertices of any component type and sparse ones to single precision, which assimp takes for that whatever
/// they are (KHR_mesh_quantization); makes nodes of instances (EXT_mesh_gpu_instancing); decodes the URIs of buffers
/// and pictures; and leaves out what has no shape, so that its faults do not matter.
/// @throws Error for a file that requires an extension which is not read, and as GltfFile.
[[nodiscard]] MendedGltf mend_gltf(const std::filesystem::path& path);

}  // namespace insonify
