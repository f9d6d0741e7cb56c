// mesh_error_test.cpp -- errors about mesh files contain position and reason.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "io/file/reader_process.h"
#include "io/mesh_texts.h"
#include "support/message_of.h"

namespace insonify::mesh_error_test {
namespace {

struct BadFile {
  std::string name;
  std::string text;
  std::string message;  // After the path.
};

TEST(LoadMeshErrorTest, TellsThePathAndTheReason) {
  const std::string known = "; known: .obj, .stl, .dae, .ply, .gltf, .glb";
  const std::vector<BadFile> files{
      {"a.fbx", "x", ": \".fbx\" is not a known extension of a mesh file" + known},
      {"a", "x", ": \"\" is not a known extension of a mesh file" + known},
      {"a.obj", "", ": the file is empty"},
      {"a.obj", "# only a comment\n", ": no triangles"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\np 1\n", ": no triangles, only 2 lines or points"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n", ":4: f 1 2 7: there is no vertex 7, the file has 3"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 2\nf 1 2 3\n",
       ": no triangles left: 2 of 2 triangles dropped (1 of zero area, 1 with NaN corners)"},
      {"a.stl", std::string(200, 'x'),
       ": is no STL: a text would begin with \"solid\"; binary, with a triangle count of 2021161080, would take "
       "101058054084 bytes, not 200"},
      {"a.stl", std::string(84, '\0'), ": cannot be read: STL: file is empty. There are no facets defined"},
      {"a.ply", "ply\nformat ascii 1.0\n", ": its header does not end: no line says end_header"},
      {"a.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nend_hea",
       ": its header does not end: no line says end_header"},
      {"a.ply", "plyx\nformat ascii 1.0\n", ": its header does not end: no line says end_header"},
      {"a.ply", "plumb", ": is no PLY: it does not begin with \"ply\""},
      {"a.dae", "<COLLADA><asset>", ":1:16: not valid XML: an element is not closed, or closed twice"},
      {"a.dae", dae_text({.positions = "0 0 0 2 0 0"}),
       ": cannot be read: Invalid data index (2/2) in primitive specification"},
      {"a.gltf", "{\"asset\":\n 2 }}", ":2:5: not valid JSON"},
      {"a.gltf", "{\"asset\":{}}", ": cannot be read: what it holds is not gltf"},
      {"a.glb", "glTF", ": what it holds is not GLB"},
      {"a.glb", glb_text() + "more", ": its header says that it has 640 bytes, not 644"},
      {"a.gltf", gltf_text("gone.bin"), ": cannot be read: GLTF: could not open referenced file \"gone.bin\""},
  };
  for (const BadFile& file : files) {
    const ScratchFolder folder;
    const std::string path = folder.write(file.name, file.text).string();
    EXPECT_EQ(message_of([&] { (void)load_mesh(path); }), path + file.message);
  }
}

// At once: assimp would take 16 s and 2.4 GB for them.
TEST(LoadMeshErrorTest, TooManyMaterialsAreRefusedBeforeTheyAreRead) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i <= 65536; ++i) {
    text += fmt::format("usemtl m{}\nf 1 2 3\n", i);
  }
  const ScratchFolder folder;
  const std::string path = folder.write("a.obj", text).string();
  EXPECT_EQ(message_of([&] { (void)load_mesh(path); }), path + ": more than 65536 material names");
}

TEST(LoadMeshErrorTest, TellsTheLineOfAnObj) {
  const std::string start = "# quay\nv 0 0 0\nv 1 0 0\n";  // Lines 1 to 3.
  const std::string triangle = start + "v 0 1 0\n";
  const std::string count = ": a vertex has 3 numbers, 4 with a weight or 6 with a colour";
  const std::vector<BadFile> files{
      {"A word for a number", start + "v a b c\nf 1 2 3\n", ":4: v a b c: a is not a number"},
      {"Skipped by assimp, although the faces have enough", triangle + "v 0 1 x\nv 0 0 1\nf 1 2 5\n",
       ":5: v 0 1 x: x is not a number"},
      {"Rubbish behind a number", start + "v 0 1abc 0\n", ":4: v 0 1abc 0: 1abc is not a number"},
      {"Hexadecimal", start + "v 0 0x10 0\n", ":4: v 0 0x10 0: 0x10 is not a number"},
      {"Too few", start + "v 1 2\n", ":4: v 1 2" + count},
      {"None", start + "v\n", ":4: v" + count},
      {"Too many", start + "  v 0 1 0 1 2 # five\n", ":4: v 0 1 0 1 2 # five" + count},
      {"On several lines", "v 0 \\\n0 0\nv 0 0\n", ":3: v 0 0" + count},
      {"Long", "v " + std::string(80, '1') + "\n",
       ":1: v " + std::string(36, '1') + "..." + std::string(19, '1') + count},
      {"Long word", "v 0 0 " + std::string(80, 'x') + "\n",
       ":1: v 0 0 " + std::string(32, 'x') + "..." + std::string(19, 'x') + ": " + std::string(38, 'x') + "..." +
           std::string(19, 'x') + " is not a number"},
      {"Control characters", "v 0 0 \x1b[7m\n", ":1: v 0 0 \\x1b[7m: \\x1b[7m is not a number"},
      {"Normal", triangle + "vn 0 up 1\nf 1//1 2//1 3//1\n", ":5: vn 0 up 1: up is not a number"},
      {"A word for an index", triangle + "f 1 2 x\n", ":5: f 1 2 x: x is not a number of a vertex"},
      {"Fraction", triangle + "f 1 2 3.5\n", ":5: f 1 2 3.5: 3.5 is not a number of a vertex"},
      {"A word for a texture's index", triangle + "f 1/a 2 3\n", ":5: f 1/a 2 3: 1/a is not a number of a vertex"},
      {"Zero", triangle + "f 1 2 0\n", ":5: f 1 2 0: there is no vertex 0, they count from 1"},
      {"Beyond the last", triangle + "f 1 2 3\nf 1//1 2 4\n", ":6: f 1//1 2 4: there is no vertex 4, the file has 3"},
      {"Before the first", start + "f 1 2 -3\nv 0 1 0\n", ":4: f 1 2 -3: there is no vertex -3, 2 precede this"},
      {"Beyond all integers", triangle + "f 1 2 99999999999999999999\n",
       ":5: f 1 2 99999999999999999999: there is no vertex 99999999999999999999, the file has 3"},
  };
  for (const BadFile& file : files) {
    const ScratchFolder folder;
    const std::string path = folder.write("quay.obj", file.text).string();
    EXPECT_EQ(message_of([&] { (void)load_mesh(path); }), path + file.message) << file.name;
  }
}

std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) {
    result += text;
  }
  return result;
}

// Nesting on which a recursive parser overflows its stack.
TEST(LoadMeshErrorTest, WhatIsNestedTooDeeplyIsRefused) {
  constexpr int kLevels = 200'000;
  const std::string lists = "{\"extras\":\n" + repeated("[", kLevels) + repeated("]", kLevels) + "}";
  std::string chain = R"({"nodes":[{"children":[1]})";
  for (int i = 2; i < kLevels; ++i) {
    chain += fmt::format(R"(,{{"children":[{}]}})", i);
  }
  chain += ",{}]}";
  const auto glb = [](const std::string& json) {
    const auto size = [](std::size_t bytes) { return bytes_of(static_cast<std::uint32_t>(bytes)); };
    return "glTF" + size(2) + size(20 + json.size()) + size(json.size()) + "JSON" + json;
  };
  const auto dae = [](const std::string& nodes) {
    return "<COLLADA>\n<library_nodes>" + nodes + "</library_nodes></COLLADA>";
  };
  const std::vector<BadFile> files{
      {"a.gltf", lists, ": cannot be read: what it holds is not gltf"},
      {"a.gltf", chain, ": cannot be read: what it holds is not gltf"},
      {"a.gltf", R"({"nodes":[{"children":[1]},{"children":[0]}]})", ": cannot be read: what it holds is not gltf"},
      {"a.glb", glb(lists), ": cannot be read: what it holds is not glb"},
      {"a.glb", glb(chain), ": cannot be read: what it holds is not glb"},
      // COLLADA, library_nodes and 198 of them; <node> has six letters.
      {"a.dae", dae(repeated("<node>", kLevels) + repeated("</node>", kLevels)),
       fmt::format(":2:{}: <node> is nested too deeply: more than 200 elements are open", 16 + 198 * 6)},
      {"a.dae", dae(R"(<node id="a"><instance_node url="#b"/></node><node id="b"><instance_node url="#a"/></node>)"),
       ": cannot be read: Collada: File came out empty. Something is wrong here"},
  };
  const SharedReader reader;
  for (const BadFile& file : files) {
    const ScratchFolder folder;
    const std::string path = folder.write(file.name, file.text).string();
    EXPECT_EQ(message_of([&] { (void)load_mesh(path); }), path + file.message);
  }
}

TEST(LoadMeshErrorTest, BracketsInTextAreNoNesting) {
  const ScratchFolder folder;
  folder.write("corner.bin", gltf_buffer());
  std::string text = gltf_text("corner.bin");
  text.insert(1, "\"extras\":\"\\\"" + repeated("[", 600) + "\",");
  EXPECT_EQ(load_mesh(folder.write("a.gltf", text)).triangles.size(), 4U);
}

TEST(LoadMeshErrorTest, CountsThatTheFileCannotHoldAreTold) {
  const std::string body =
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";  // Read as binary numbers: two vertices of 12 bytes and 2 more bytes.
  const auto ply = [](std::uint64_t vertices, std::uint64_t faces, const std::string& format) {
    return ply_header(format, vertices, faces);
  };
  const std::string binary = "binary_little_endian";
  const std::string triangle = binary_stl({{Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)}});
  std::string many = triangle;
  many.replace(80, 4, bytes_of(std::uint32_t{4'000'000'000}));
  std::string odd = ply(3, 1, "ascii") + body;
  odd.replace(odd.find("vertex 3"), 8, "vertex -3");
  const std::vector<BadFile> files{
      {"a.ply", ply(4'000'000'000, 1, "ascii") + body, ":3: element vertex 4000000000: the file ends after 4"},
      {"a.ply", ply(4'000'000'000, 1, binary) + body, ":3: element vertex 4000000000: the file ends after 2"},
      {"a.ply", "\xef\xbb\xbf" + ply(4'000'000'000, 1, "ascii") + body,
       ":3: element vertex 4000000000: the file ends after 4"},
      {"a.ply", ply(3, 4'000'000'000, "ascii") + body, ":7: element face 4000000000: the file ends after 1"},
      {"a.ply", ply(2, 4'000'000'000, binary) + body, ":7: element face 4000000000: the file ends after 0"},
      {"a.ply", "ply\n\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header",
       ":4: element vertex 3 has no properties x, y and z"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n",
       ":3: element vertex 4000000000 has no properties"},
      {"a.ply", odd, ":3: \"-3\" is not a number of elements"},
      {"a.stl", many,
       ": is no STL: a text would begin with \"solid\"; binary, with a triangle count of 4000000000, would take "
       "200000000084 bytes, not 134"},
      {"a.stl", "short",
       ": is no STL: a text would begin with \"solid\"; binary, with a triangle count of 0, would take 84 bytes, not "
       "5"},
  };
  for (const BadFile& file : files) {
    const ScratchFolder folder;
    const std::string path = folder.write(file.name, file.text).string();
    EXPECT_EQ(message_of([&] { (void)load_mesh(path); }), path + file.message);
  }
}

std::string triangles_of(const std::string& name, const std::string& text) {
  const ScratchFolder folder;
  const std::string path = folder.write(name, text).string();
  try {
    return fmt::format("{} triangles", load_mesh(path).triangles.size());
  } catch (const Error&) {
    return "refused";
  }
}

// Truncated files, as from a full disk or an interrupted download. At the end of a text, a line break or the last
// digits of the last word may be missing without an error.
TEST(LoadMeshErrorTest, NoPartIsTakenForTheWhole) {
  struct Whole {
    std::string name, text;
    std::size_t spare;  // Unneeded bytes at the end.
  };
  const std::vector<Whole> files{{"a.stl", ascii_stl_text(), std::string(" corner\n").size()},
                                 {"a.stl", binary_stl_text(), 0},
                                 {"a.ply", ascii_ply_text(), 1},
                                 {"a.ply", binary_ply_text(), 0},
                                 {"a.dae", dae_text(), 0},
                                 {"a.glb", glb_text(), 0}};
  const SharedReader reader;
  for (const Whole& file : files) {
    // All lengths near the end, where most errors are possible, and some others.
    for (std::size_t size = 0; size < file.text.size() - file.spare; size += size + 70 < file.text.size() ? 31 : 1) {
      ASSERT_EQ(triangles_of(file.name, file.text.substr(0, size)), "refused") << file.name << ", " << size << " bytes";
    }
    EXPECT_EQ(triangles_of(file.name, file.text), "4 triangles") << file.name;
  }
}

TEST(LoadMeshErrorTest, TellsWherePartsAreMissing) {
  const std::string stl = ascii_stl_text(), ply = ascii_ply_text();
  const std::vector<BadFile> files{
      {"a.stl", stl.substr(0, stl.find("endsolid")), ":29: the text ends before its endsolid: a part of it is missing"},
      {"a.stl", stl.substr(0, 120) + "\n\n", ":10: the text ends before its endsolid: a part of it is missing"},
      {"a.ply", ply.substr(0, ply.find("3 0 3 2")), ":7: element face 4: the file ends after 2"},
      {"a.ply", ply.substr(0, ply.find("2 0 0\n")), ":3: element vertex 4: the file ends after 1"},
      {"a.ply", ply.substr(0, ply.size() - 3), ":17: fewer numbers than an element face has"},
      {"a.ply", binary_ply_text().substr(0, binary_ply_text().size() - 1), ":7: element face 4: the file ends after 3"},
      {"a.dae", dae_text({.nodes = "<node>\n<instance_geometry url=\"#gone\"/></node>"}),
       ":10:1: <instance_geometry> names #gone, which is not in this file"},
      {"a.dae", dae_text({.nodes = "<node>\n <instance_node url=\"#g\"/></node>"}),
       ":10:2: <instance_node> names #g, which is not in this file"},
  };
  for (const BadFile& file : files) {
    const ScratchFolder folder;
    const std::string path = folder.write(file.name, file.text).string();
    EXPECT_EQ(message_of([&] { (void)load_mesh(path); }), path + file.message);
  }
}

TEST(LoadMeshErrorTest, TellsWhatIsNoFile) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "a.obj");
  EXPECT_EQ(message_of([&] { (void)load_mesh(folder.path() / "a.obj"); }),
            (folder.path() / "a.obj").string() + ": is a folder, not a file");
  EXPECT_EQ(message_of([&] { (void)load_mesh(folder.path() / "b.obj"); }),
            (folder.path() / "b.obj").string() + ": no such file");
}

}  // namespace
}  // namespace insonify::mesh_error_test
