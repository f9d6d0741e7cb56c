// mesh_formats_test.cpp -- PLY, STL and DAE files as programs write them: heads, strips, number types, looks,
// encodings.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "insonify/files.h"
#include "io/loaded_mesh.h"
#include "io/mesh_texts.h"
#include "support/message_of.h"

namespace insonify::mesh_formats_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The corner of mesh_texts.h, with vertices moved so that the first number in the file is `first`.
std::string moved_binary_ply(float first) {
  const float x = first;
  return binary_ply({{x, 0, 0}, {x + 2, 0, 0}, {x, 3, 0}, {x, 0, 5}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

// 0x0A is a line feed, 0x0D a carriage return, as at the end of the header.
TEST(PlyTest, TheFirstByteOfTheDataMayBeALineEnd) {
  for (const std::array<char, 4>& bytes :
       {std::array{'\n', '\n', '\n', 'A'}, {'\r', '\n', 'x', 'A'}, {'\n', '\0', '\0', 'A'}}) {
    const auto first = std::bit_cast<float>(bytes);
    const ScratchFolder folder;
    const Loaded loaded = load(folder.write("a.ply", moved_binary_ply(first)));
    EXPECT_THAT(loaded.notes, IsEmpty());
    EXPECT_NEAR(volume_of(loaded.mesh), 5, 1e-4);
  }
}

TEST(PlyTest, TakesNumbersOfAnyType) {
  const auto text = [](const std::string& format, const std::string& type, const std::string& index) {
    return fmt::format(
        "ply\r\nformat {} 1.0\r\ncomment made by hand\r\nelement vertex 4\r\nproperty {} x\r\nproperty {} y\r\n"
        "property {} z\r\nproperty uchar red\r\nelement face 4\r\nproperty float quality\r\n"
        "property list {} {} vertex_index\r\nend_header\r\n",
        format, type, type, type, index, index);
  };
  const ScratchFolder folder;
  const Mesh ascii = load_mesh(folder.write(
      "a.ply", text("ascii", "double", "uint") +
                   "0 0 0 9\n+2. 0 0 9\n0 3e0 0 9\n0 0 5 9\n1 3 0 2 1\n1 3 0 1 3\n1 3 0 3 2\n1 3 1 2 3\n"));
  expect_bounds(ascii, {0, 0, 0}, {2, 3, 5});

  std::string body;
  for (const auto& corner : {std::array{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 5.0}}) {
    body += bytes_of(corner) + "\x09";
  }
  for (const auto& face : {std::array<std::uint16_t, 4>{3, 0, 2, 1}, {3, 0, 1, 3}, {3, 0, 3, 2}, {3, 1, 2, 3}}) {
    body += bytes_of(1.0F) + bytes_of(face);
  }
  const Mesh binary = load_mesh(folder.write("b.ply", text("binary_little_endian", "double", "ushort") + body));
  expect_bounds(binary, {0, 0, 0}, {2, 3, 5});
  EXPECT_NEAR(volume_of(binary), 5, kFloat);

  std::string big;  // 16 bits, the more significant byte first.
  for (const auto& corner : {std::array<char, 3>{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}}) {
    for (const char value : corner) {
      big += std::string(1, '\0') + value;
    }
    big += "\x09";
  }
  for (const auto& face : {std::array<char, 4>{3, 0, 2, 1}, {3, 0, 1, 3}, {3, 0, 3, 2}, {3, 1, 2, 3}}) {
    big += std::string(4, '\0') + std::string(face.data(), face.size());
  }
  expect_bounds(load_mesh(folder.write("c.ply", text("binary_big_endian", "short", "uchar") + big)), {0, 0, 0},
                {2, 3, 5});
}

// Two strips: a square of (0, 0), (1, 0), (0, 1), (1, 1), and one triangle above. A corner that is repeated leads on.
TEST(PlyTest, StripsAreTriangles) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 2\n1 0 2\n0 1 2\n";
  const ScratchFolder folder;
  for (const std::string strip : {"8 0 1 2 3 -1 4 5 6", "9 0 1 2 3 3 4 4 5 6"}) {
    const Loaded loaded = load(folder.write("a.ply", header + strip + "\n"));
    EXPECT_THAT(loaded.notes, IsEmpty());
    EXPECT_EQ(loaded.mesh.triangles.size(), 3U);
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 area = doubled_area(loaded.mesh, loaded.mesh.triangles[i]);
      EXPECT_NEAR(area.z(), 1, kFloat) << "both wind to the left";
    }
  }
}

TEST(PlyTest, FaultsNameTheRule) {
  const auto error = [](const std::string& text) {
    const ScratchFolder folder;
    const std::string path = folder.write("a.ply", text).string();
    return message_of([&] { (void)load_mesh(path); }).substr(path.size());
  };
  const std::string ascii = ascii_ply_text();
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = ascii;
    return error(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_EQ(changed("format ascii", "format text"),
            ": format \"text\" is not ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(changed("float y", "real y"), ":5: \"real\" is not a type of numbers");
  EXPECT_EQ(changed("float y", "float q"), ":3: element vertex 4 has no properties x, y and z");
  EXPECT_EQ(changed("2 0 0\n", "2 zero 0\n"), ":11: \"zero\" is not a number");
  const ScratchFolder folder;
  const std::string path = folder.write("a.ply", ascii).string();
  EXPECT_EQ(message_of([&] { (void)load(path, {.name = "hull"}); }),
            path + ": no submesh \"hull\"; PLY files have no parts");
}

// ---------------------------------------------------------------------------------------------------------------------

std::string in_capitals(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

TEST(StlTest, KeywordsMayBeCapitals) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write("a.stl", in_capitals(ascii_stl_text())));
  EXPECT_THAT(loaded.notes, IsEmpty());
  EXPECT_NEAR(volume_of(loaded.mesh), 5, kFloat);
  EXPECT_EQ(
      load(folder.write("b.stl", "Solid Hull\n" + ascii_stl_text().substr(13)), {.name = "Hull"}).mesh.triangles.size(),
      4U);
}

TEST(StlTest, ACountOfNoneIsThatOfItsSize) {
  std::string text = binary_stl_text();
  text.replace(80, 4, std::string(4, '\0'));
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write("a.stl", text));
  EXPECT_NEAR(volume_of(loaded.mesh), 5, kFloat);
  EXPECT_THAT(loaded.notes, ElementsAre("warning: a.stl: its count of triangles is 0, its size that of 4 triangles"));
}

TEST(StlTest, WhatFollowsTheLastTriangleIsLeftOut) {
  const ScratchFolder folder;
  const Loaded binary = load(folder.write("a.stl", binary_stl_text() + "more"));
  EXPECT_NEAR(volume_of(binary.mesh), 5, kFloat);
  EXPECT_THAT(binary.notes, ElementsAre("warning: a.stl: 4 bytes behind the last triangle left out"));
  const Loaded text = load(folder.write("a.stl", ascii_stl_text() + "exported by hand\n"));
  EXPECT_NEAR(volume_of(text.mesh), 5, kFloat);
  EXPECT_THAT(text.notes, ElementsAre("warning: a.stl: 17 bytes behind the last endsolid left out"));
}

// ---------------------------------------------------------------------------------------------------------------------

std::string dae_with_looks(const std::string& color) {
  return dae_text(
      {.materials =
           "<library_lights><light id='l'><technique_common><point><color>" + color +
           "</color></point></technique_common></light></library_lights><library_cameras><camera id='c'><optics>"
           "<technique_common><perspective><yfov>wide</yfov></perspective></technique_common></optics></camera>"
           "</library_cameras><library_effects><effect id='e'><profile_COMMON><technique "
           "sid='t'><phong><diffuse><color>" +
           color +
           "</color></diffuse><shininess><float>very</float></shininess></phong></technique></profile_COMMON>"
           "</effect></library_effects><library_materials><material id='m1' name='Sandstein'>"
           "<instance_effect url='#e'/></material></library_materials>",
       .nodes = "<node id='n'><instance_light url='#l'/><instance_camera url='#c'/><instance_geometry url='#g'>"
                "<bind_material><technique_common><instance_material symbol='m' target='#m1'/></technique_common>"
                "</bind_material></instance_geometry></node>"});
}

TEST(DaeTest, LooksDoNotStopShapes) {
  const ScratchFolder folder;
  for (const std::string color : {" 0.5 0.5 0.5 1 ", "0.5 0.5 0.5", "", "red", "1,1,1,1", "0.5 0.5 0.5 1 1 1"}) {
    const Loaded loaded = load(folder.write("a.dae", dae_with_looks(color)));
    EXPECT_THAT(loaded.notes, IsEmpty()) << color;
    EXPECT_NEAR(volume_of(loaded.mesh), 5, kFloat) << color;
    EXPECT_THAT(loaded.mesh.material_names, ElementsAre("Sandstein")) << color;
  }
}

// assimp crashes on an image without a file.
TEST(DaeTest, ImagesWithoutFilesDoNotStopShapes) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write(
      "a.dae", dae_text({.materials = "<library_images><image id='i'><init_from/></image><image><init_from>a.png"
                                      "</init_from></image></library_images>"})));
  EXPECT_NEAR(volume_of(loaded.mesh), 5, kFloat);
}

TEST(ObjTest, LooksDoNotStopShapes) {
  const ScratchFolder folder;
  folder.write("empty.mtl", "");
  folder.write("bad.mtl",
               "newmtl steel\nKd abc\nKa 1\nNs\nillum x\nd -halo .5\nmap_Kd -s 1 1\nbump -bm\nnewmtl\nTf\nnewmtl rust\n"
               "Kd spectral a.rfl\n");
  for (const std::string library : {"bad.mtl", "empty.mtl", "gone.mtl"}) {
    const Loaded loaded = load(folder.write("a.obj", "mtllib " + library + "\nusemtl rust\n" + obj_text()));
    EXPECT_THAT(loaded.notes, IsEmpty()) << library;
    EXPECT_THAT(loaded.mesh.material_names, ElementsAre("rust")) << library;
  }
}

// "Rückwand" in ISO 8859-1, "Стена" in windows-1251 and "壁" in Shift_JIS.
TEST(DaeTest, DeclaredEncodingsAreRead) {
  struct Case {
    std::string encoding, bytes, name;
  };
  for (const Case& now : {Case{"ISO-8859-1",
                               "R\xfc"
                               "ckwand",
                               "R\u00fcckwand"},
                          Case{"windows-1251", "\xd1\xf2\xe5\xed\xe0", "\u0421\u0442\u0435\u043d\u0430"},
                          Case{"Shift_JIS", "\x95\xc7", "\u58c1"},
                          Case{"utf-8",
                               "R\xfc"
                               "ckwand",
                               "R\\xfcckwand"},
                          Case{"unheard-of",
                               "R\xfc"
                               "ckwand",
                               "R\\xfcckwand"}}) {
    std::string text = dae_with_looks("1 1 1 1");
    text.replace(text.find("Sandstein"), 9, now.bytes);
    text.replace(0, text.find("?>"), "<?xml version=\"1.0\" encoding=\"" + now.encoding + "\"");
    const ScratchFolder folder;
    EXPECT_THAT(load_mesh(folder.write("a.dae", text)).material_names, ElementsAre(now.name)) << now.encoding;
  }
}

TEST(LoadMeshTest, NamesThatAreNoTextAreEscaped) {
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write("t\xe9.obj", "usemtl caf\xe9\n" + obj_text()));
  EXPECT_EQ(mesh.name, "t\\xe9");
  EXPECT_THAT(mesh.material_names, ElementsAre("caf\\xe9"));
  EXPECT_EQ(load_scene(folder.path() / "t\xe9.obj").instances[0].name, "t\\xe9");
}

// ---------------------------------------------------------------------------------------------------------------------

std::vector<std::string> part_names(const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const Instance& instance : load_scene(path, {.parts = true}).instances) {
    names.push_back(instance.name);
  }
  return names;
}

TEST(PartsTest, ObjectsAndGroupsOfObjAreInstances) {
  const ScratchFolder folder;
  const auto path =
      folder.write("ship.obj",
                   "o hull\nv 0 0 0\nv 2 0 0\nv 0 3 0\nusemtl steel\nf 1 2 3\ng mast\nv 10 0 0\nv 10 4 0\n"
                   "v 10 0 8\nusemtl wood\nf 4 5 6\nusemtl steel\nf 6 5 4\ng hull\nf 3 2 1\n");
  const Scene scene = load_scene(path, {.parts = true});
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.instances[0].name, "ship::hull");
  EXPECT_EQ(scene.instances[0].mesh->triangles.size(), 2U);
  EXPECT_THAT(scene.instances[0].mesh->material_names, ElementsAre("steel"));
  EXPECT_EQ(scene.instances[1].name, "ship::mast");
  EXPECT_THAT(scene.instances[1].mesh->material_names, testing::UnorderedElementsAre("wood", "steel"));
  expect_bounds(*scene.instances[1].mesh, {10, 0, 0}, {10, 4, 8});
  EXPECT_EQ(load_scene(path).instances.size(), 1U) << "on request only";
}

TEST(PartsTest, NodesAreInstances) {
  const ScratchFolder folder;
  const std::string node = "<node id='{0}' name='leg'><instance_geometry url='#g'/></node>";
  EXPECT_THAT(part_names(folder.write("jacket.dae", dae_text({.nodes = fmt::format(fmt::runtime(node), "a") +
                                                                       fmt::format(fmt::runtime(node), "b")}))),
              ElementsAre("jacket::leg", "jacket::leg_2"));
  folder.write("corner.bin", gltf_buffer());
  EXPECT_THAT(part_names(folder.write("box.gltf", gltf_text("corner.bin"))), ElementsAre("box::corner"));
  EXPECT_THAT(part_names(folder.write("bed.ply", ascii_ply_text())), ElementsAre("bed::bed"));
}

}  // namespace
}  // namespace insonify::mesh_formats_test
