// relief_file_test.cpp -- reliefs from normal maps of mesh files and of scenarios.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "io/loaded_mesh.h"
#include "support/message_of.h"
#include "support/picture_files.h"
#include "support/test_files.h"
#include "support/working_folder.h"

namespace insonify::relief_file_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A normal that leans left and down: rises of 96/64 to the right... of 8 bits: (128 - 32, 128 - 64, 255).
const Eigen::Vector2f kSlope(32.0F / 127, 64.0F / 127);
void write_normal_map(const std::string& name) {
  write_levels<std::uint8_t>(name, 1, 1, {96, 64, 255}, 3);
}

// A square of 2 m in x-y whose picture covers it once.
std::string obj(const std::string& library) {
  return "mtllib " + library +
         "\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl stone\nf 1/1 2/2 3/3 4/4\n";
}

const Relief* relief_of(const Mesh& mesh) {
  return mesh.reliefs.empty() ? nullptr : mesh.reliefs[0].get();
}

void expect_slope(const Mesh& mesh, const Eigen::Vector2f& slope) {
  ASSERT_NE(relief_of(mesh), nullptr);
  EXPECT_LT((relief_of(mesh)->slopes.at(0.5F, 0.5F) - slope).norm(), 1e-5F)
      << relief_of(mesh)->slopes.at(0.5F, 0.5F).transpose();
  EXPECT_FALSE(relief_of(mesh)->by_position);
  EXPECT_EQ(relief_of(mesh)->tile_size, 0);
  ASSERT_THAT(mesh.texture_coordinates, SizeIs(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec3f& vertex = mesh.vertices[mesh.triangles[t][k]];
      EXPECT_LT((mesh.texture_coordinates[t][k] - 0.5F * vertex.head<2>()).norm(), 1e-5F);
    }
  }
}

TEST(MeshReliefTest, ObjBringsItsNormalMap) {
  for (const char* key : {"norm", "map_Kn", "map_bump", "bump", "map_Bump -bm 1.0"}) {
    SCOPED_TRACE(key);
    const WorkingFolder folder;
    write_normal_map("stone.png");
    const Loaded loaded = [&] {
      folder.write("a.mtl", std::string("newmtl stone\nKd 1 1 1\n") + key + " stone.png\n");
      folder.write("a.obj", obj("a.mtl"));
      return load("a.obj");
    }();
    EXPECT_THAT(loaded.notes, IsEmpty());
    EXPECT_THAT(loaded.mesh.material_names, ElementsAre("stone"));
    expect_slope(loaded.mesh, kSlope);
  }
}

TEST(MeshReliefTest, GreyBumpMapsAreHeights) {
  const WorkingFolder folder;
  write_levels<std::uint8_t>("bumps.png", 4, 1, {0, 0, 255, 255});
  folder.write("a.mtl", "newmtl stone\nmap_bump -bm 0.02 bumps.png\n");
  folder.write("a.obj", obj("a.mtl"));
  const Loaded loaded = load("a.obj");
  EXPECT_THAT(loaded.notes, IsEmpty());
  ASSERT_NE(relief_of(loaded.mesh), nullptr);
  EXPECT_TRUE(relief_of(loaded.mesh)->rise_per_tile);
  // From the second texel's left to the third, a rise of 2 cm over two of four texels.
  EXPECT_NEAR(relief_of(loaded.mesh)->slopes.at(0.375F, 0.5F).x(), 0.04, 1e-5);

  folder.write("a.mtl", "newmtl stone\nmap_bump bumps.png\n");
  const Loaded unknown = load("a.obj");
  EXPECT_EQ(relief_of(unknown.mesh), nullptr);
  EXPECT_THAT(unknown.notes, ElementsAre("warning: a.obj: skipped the small normals of material stone: bumps.png: is a "
                                         "height map, but the material does not say how high (bump -bm METRES)"));
}

TEST(MeshReliefTest, WhatCannotBeReadIsToldAndLeftOut) {
  const WorkingFolder folder;
  folder.write("sub/a.obj", obj("a.mtl"));
  folder.write("sub/a.mtl", "newmtl stone\nnorm gone.png\n");
  EXPECT_THAT(load("sub/a.obj").notes,
              ElementsAre("warning: a.obj: skipped the small normals of material stone: sub/gone.png: no such file"));
  folder.write("sub/stone.jpg", "\xff\xd8\xff\xe0 no picture");
  folder.write("sub/a.mtl", "newmtl stone\nnorm stone.jpg\n");
  EXPECT_THAT(load("sub/a.obj").notes, ElementsAre("warning: a.obj: skipped the small normals of material stone: "
                                                   "sub/stone.jpg: cannot be read: Not a PNG file"));
  write_levels<std::uint8_t>("sub/red.png", 1, 1, {255, 0, 0}, 3);
  folder.write("sub/a.mtl", "newmtl stone\nnorm red.png\n");
  EXPECT_THAT(
      load("sub/a.obj").notes,
      ElementsAre("warning: a.obj: skipped the small normals of material stone: sub/red.png: is not a normal map "
                  "in tangent space: its mean normal is (1.00, -1.01, -1.01), must point out of the surface, "
                  "(0, 0, 1) or nearly"));
}

TEST(MeshReliefTest, PicturesAreFoundWhereGazeboPutsThem) {
  const WorkingFolder folder;
  folder.write("meshes/a.obj", obj("a.mtl"));
  folder.write("meshes/a.mtl", "newmtl stone\nnorm C:\\work\\stone.png\n");
  folder.write("materials/textures/x", "");
  write_normal_map("materials/textures/stone.png");
  const Loaded loaded = load("meshes/a.obj");
  EXPECT_THAT(loaded.notes, IsEmpty());
  expect_slope(loaded.mesh, kSlope);
}

TEST(MeshReliefTest, DaeBringsItsBumpMap) {
  const WorkingFolder folder;
  write_normal_map("stone.png");
  folder.write("a.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="img" name="img"><init_from>stone.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="s"><surface type="2D"><init_from>img</init_from></surface></newparam>
<newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
<technique sid="c"><lambert/><extra><technique profile="FCOLLADA"><bump><texture texture="t" texcoord="UV"/></bump></technique></extra></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="stone"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 2 0 0 2 2 0 0 2 0</float_array><technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common><accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2" material="mm"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#u" offset="1" set="0"/><p>0 0 1 1 2 2 0 0 2 2 3 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node id="n"><instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="mm" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>)");
  const Loaded loaded = load("a.dae");
  EXPECT_THAT(loaded.notes, IsEmpty());
  expect_slope(loaded.mesh, kSlope);
}

// y up in the file; pictures start at the top. The scale of the normal texture applies.
std::string gltf(const std::string& image) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"materials":[{"name":"stone","normalTexture":{"index":0,"scale":0.5}}],"textures":[{"source":0}],"images":[)" +
         image + R"(],"buffers":[{"uri":"a.bin","byteLength":92}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},{"buffer":0,"byteOffset":80,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,-2],"max":[2,0,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}]})";
}

TEST(MeshReliefTest, GltfBringsItsNormalTexture) {
  const WorkingFolder folder;
  write_normal_map("stone.png");
  // Our (x, y, z) is written (x, z, -y).
  folder.write("a.bin", bytes_of(std::array<float, 12>{0, 0, 0, 2, 0, 0, 2, 0, -2, 0, 0, -2}) +
                            bytes_of(std::array<float, 8>{0, 1, 1, 1, 1, 0, 0, 0}) +
                            bytes_of(std::array<std::uint16_t, 6>{0, 1, 2, 0, 2, 3}));
  folder.write("a.gltf", gltf(R"({"uri":"stone.png"})"));
  const Loaded loaded = load("a.gltf");
  EXPECT_THAT(loaded.notes, IsEmpty());
  expect_slope(loaded.mesh, 0.5F * kSlope);

  // Picture embedded in the file.
  std::string bytes;
  {
    std::ifstream file("stone.png", std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
  }
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string base64;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned three = 0;
    for (std::size_t k = i; k < i + 3; ++k) {
      three = three << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0);
    }
    for (int digit = 0; digit < 4; ++digit) {
      base64 += i + digit > bytes.size() ? '=' : kDigits[three >> (18 - 6 * digit) & 63];
    }
  }
  folder.write("b.gltf", gltf(R"({"mimeType":"image/png","uri":"data:image/png;base64,)" + base64 + "\"}"));
  const Loaded inside = load("b.gltf");
  EXPECT_THAT(inside.notes, IsEmpty());
  expect_slope(inside.mesh, 0.5F * kSlope);
}

// ---------------------------------------------------------------------------------------------------------------------

const std::string kScenario = "world: a.obj\nsonars: [{}]\nmaterials:\n  stone: ";

Scene scene_of(const WorkingFolder& folder, const std::string& material) {
  folder.write("a.obj", obj("none.mtl"));
  folder.write("s.yaml", kScenario + material + "\n");
  return load_scene(load_scenario("s.yaml"));
}

TEST(ScenarioReliefTest, PicturesAreLaidByTextureOrByPosition) {
  const WorkingFolder folder;
  folder.write("maps/x", "");
  write_normal_map("maps/stone.png");
  write_levels<std::uint8_t>("grey.png", 1, 1, {51});
  Scene scene = scene_of(folder, "{normal_map: maps/stone.png, normal_strength: 2, reflectivity_map: grey.png}");
  ASSERT_THAT(scene.instances[0].reliefs, SizeIs(1));
  const Relief* relief = scene.instances[0].reliefs[0].get();
  ASSERT_NE(relief, nullptr);
  EXPECT_LT((relief->slopes.at(0, 0) - 2 * kSlope).norm(), 1e-5F);
  EXPECT_FLOAT_EQ(relief->reflectivity.at(0, 0), 0.2F);
  EXPECT_FALSE(relief->by_position);
  EXPECT_EQ(relief->tile_size, 1);

  scene = scene_of(folder, "{height_map: grey.png, height: 0.1, tile_size: 3}");
  EXPECT_TRUE(scene.instances[0].reliefs[0]->by_position);
  EXPECT_EQ(scene.instances[0].reliefs[0]->tile_size, 3);

  scene = scene_of(folder, "{ripple_wavelength: 0.5, ripple_height: 0.05, ripple_direction_deg: 30}");
  EXPECT_EQ(scene.instances[0].reliefs[0]->tile_size, 12);
  EXPECT_TRUE(scene_of(folder, "{reflection: 0.05}").instances[0].reliefs.empty());
}

TEST(ScenarioReliefTest, SixteenBitsCountInFull) {
  const WorkingFolder folder;
  write_levels<std::uint16_t>("deep.png", 1, 1, {32768 - 1, 32768, 65535}, 3);
  const Scene scene = scene_of(folder, "{normal_map: deep.png}");
  EXPECT_NEAR(scene.instances[0].reliefs[0]->slopes.at(0, 0).x(), 1.0 / 32767, 1e-9);
  EXPECT_EQ(scene.instances[0].reliefs[0]->slopes.at(0, 0).y(), 0);
}

TEST(ScenarioReliefTest, MistakesAreToldWithTheirPlace) {
  const WorkingFolder folder;
  write_levels<std::uint8_t>("grey.png", 1, 1, {51});
  write_normal_map("stone.png");
  const auto message = [&](const std::string& material) { return message_of([&] { scene_of(folder, material); }); };
  EXPECT_EQ(message("{normal_map: gone.png}"), "s.yaml:4:3: materials.stone: gone.png: no such file");
  EXPECT_EQ(message("{normal_map: grey.png}"),
            "s.yaml:4:3: materials.stone: grey.png: is grey; a normal map has colours");
  EXPECT_EQ(
      message("{height_map: stone.png, height: 1}"),
      "s.yaml:4:3: materials.stone: stone.png: the pixel in column 0, row 0 is coloured; a height map needs a grey "
      "picture");
  EXPECT_EQ(message("{height_map: grey.png}"),
            "s.yaml:4:11: materials.stone.height_map needs height, how far white lies above black [m]");
  EXPECT_EQ(message("{ripple_wavelenght: 1}"),
            "s.yaml:4:11: materials.stone.ripple_wavelenght is not a known key; did you mean ripple_wavelength?");
  EXPECT_EQ(message("{roughness_height: .nan}"),
            "s.yaml:4:11: materials.stone.roughness_height = nan m must be from 0 to 100 m");
}

}  // namespace
}  // namespace insonify::relief_file_test
