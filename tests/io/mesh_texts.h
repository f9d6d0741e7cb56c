// mesh_texts.h -- small mesh files in each format.

#pragma once

#include <fmt/format.h>

#include <string>

#include "support/test_files.h"

namespace insonify {

// The solid in all of them: the corner of a box, with legs of 2 m along x, 3 m along y and 5 m along z, wound outwards.
// Volume 2 * 3 * 5 / 6 = 5 m^3. In glTF, where y is up, our (x, y, z) is (x, z, -y).

inline std::string obj_text() {
  return "# a comment\no corner\nv 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 5\n"
         "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

inline std::string ascii_stl_text() {
  const auto facet = [](const char* a, const char* b, const char* c) {
    return fmt::format("facet normal 0 0 0\nouter loop\nvertex {}\nvertex {}\nvertex {}\nendloop\nendfacet\n", a, b, c);
  };
  const char* o = "0 0 0";
  const char* x = "2 0 0";
  const char* y = "0 3 0";
  const char* z = "0 0 5e0";
  return "solid corner\n" + facet(o, y, x) + facet(o, x, z) + facet(o, z, y) + facet(x, y, z) + "endsolid corner\n";
}

/// Triangles of three corners each, with a normal of zero.
inline std::string binary_stl(const std::vector<std::array<Vec3f, 3>>& triangles) {
  std::string text(80, '\0');
  text += bytes_of(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& corners : triangles) {
    text += bytes_of(std::array<float, 3>{});
    for (const Vec3f& corner : corners) {
      text += bytes_of(std::array<float, 3>{corner.x(), corner.y(), corner.z()});
    }
    text += bytes_of(std::uint16_t{0});
  }
  return text;
}

inline std::string binary_stl_text() {
  const Vec3f o(0, 0, 0), x(2, 0, 0), y(0, 3, 0), z(0, 0, 5);
  return binary_stl({{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}});
}

inline std::string ply_header(const std::string& format, std::size_t vertices, std::size_t faces) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, vertices, faces);
}

inline std::string ascii_ply_text() {
  return ply_header("ascii", 4, 4) + "0 0 0\n2 0 0\n0 3 0\n0 0 5\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

inline std::string binary_ply(const std::vector<Vec3f>& vertices,
                              const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::string text = ply_header("binary_little_endian", vertices.size(), triangles.size());
  for (const Vec3f& vertex : vertices) {
    text += bytes_of(std::array<float, 3>{vertex.x(), vertex.y(), vertex.z()});
  }
  for (const auto& triangle : triangles) {
    text += bytes_of(std::uint8_t{3}) + bytes_of(triangle);
  }
  return text;
}

inline std::string binary_ply_text() {
  return binary_ply({{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

// Parameters of the tests' DAE files.
struct Dae {
  std::string unit = "1";
  std::string up_axis = "Z_UP";
  std::string positions = "0 0 0 2 0 0 0 3 0 0 0 5";
  std::string triangles = R"(<triangles count="4" material="m"><input semantic="VERTEX" source="#v" offset="0"/>)"
                          "<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>";
  std::string materials = "";  // Contents of <library_materials>.
  std::string nodes = R"(<node id="n" name="corner"><instance_geometry url="#g"/></node>)";
};

inline std::string dae_text(const Dae& dae = {}) {
  const auto count = std::ranges::count(dae.positions, ' ') + 1;
  return fmt::format(
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="{}"/><up_axis>{}</up_axis></asset>{}
<library_geometries><geometry id="g" name="corner_mesh"><mesh>
<source id="p"><float_array id="a" count="{}">{}</float_array><technique_common>
<accessor source="#a" count="{}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>{}
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">{}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)",
      dae.unit, dae.up_axis, dae.materials, count, dae.positions, count / 3, dae.triangles, dae.nodes);
}

// Positions, then indices.
inline std::string gltf_buffer() {
  std::string buffer = bytes_of(std::array<float, 12>{0, 0, 0, 2, 0, 0, 0, 0, -3, 0, 5, 0});
  return buffer + bytes_of(std::array<std::uint16_t, 12>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

/// @param uri  URI of the file with the buffer; "" if it is the second chunk of a GLB.
inline std::string gltf_text(const std::string& uri) {
  const std::string at = uri.empty() ? "" : fmt::format(R"("uri":"{}",)", uri);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"corner","mesh":0}],)"
         R"("materials":[{"name":"hull"}],)"
         R"("meshes":[{"name":"corner_mesh","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,-3],"max":[2,5,0]},)"
         R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
         R"("buffers":[{)" +
         at + R"("byteLength":72}]})";
}

inline std::string glb_text() {
  std::string json = gltf_text("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string buffer = gltf_buffer();
  const auto size = [](std::size_t bytes) { return bytes_of(static_cast<std::uint32_t>(bytes)); };
  return "glTF" + size(2) + size(12 + 8 + json.size() + 8 + buffer.size()) + size(json.size()) + "JSON" + json +
         size(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

}  // namespace insonify
