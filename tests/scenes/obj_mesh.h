// obj_mesh.h -- reads the generated OBJ files without the library's reader, so that these tests are independent of it.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "insonify/mesh.h"

namespace insonify::testing_scenes {

inline std::filesystem::path generated_meshes() {
  return std::filesystem::path(INSONIFY_SOURCE_DIR) / "scenes/meshes";
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Vertices, triangles and material names as in the file; no normals.
inline Mesh read_obj(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path << " is made by the target scene_meshes";
  Mesh mesh;
  mesh.name = path.stem().string();
  mesh.material_names.clear();
  for (std::string line; std::getline(file, line);) {
    Vec3f p;
    std::array<std::uint32_t, 3> corners{};
    if (std::sscanf(line.c_str(), "v %f %f %f", &p.x(), &p.y(), &p.z()) == 3) {
      mesh.vertices.push_back(p);
    } else if (std::sscanf(line.c_str(), "f %u %u %u", &corners[0], &corners[1], &corners[2]) == 3 ||
               std::sscanf(line.c_str(), "f %u/%*u %u/%*u %u/%*u", &corners[0], &corners[1], &corners[2]) == 3) {
      std::ranges::for_each(corners, [](std::uint32_t& corner) { --corner; });  // OBJ counts from 1.
      mesh.triangles.push_back(corners);
      mesh.material_slots.push_back(static_cast<std::uint16_t>(mesh.material_names.size() - 1));
    } else if (line.starts_with("usemtl ")) {
      mesh.material_names.push_back(line.substr(7));
    }
  }
  return mesh;
}

}  // namespace insonify::testing_scenes
