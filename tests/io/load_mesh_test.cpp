// load_mesh_test.cpp -- every mesh format gives the same solid, in metres, z up, with its names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "io/mesh_file.h"
#include "io/mesh_texts.h"
#include "scene/mesh_checks.h"
#include "support/message_of.h"

namespace insonify {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Rounding of floats in sums and products of a few of them.
constexpr double kFloat = 1e-5;

// Loads a file and what was said about it.
struct Loaded {
  Mesh mesh;
  std::vector<std::string> notes;
};

Loaded load(const std::filesystem::path& path, const Submesh& submesh = {}) {
  Loaded loaded;
  loaded.mesh = load_mesh_file(path, submesh, [&](Severity severity, const std::string& note) {
    loaded.notes.push_back((severity == Severity::kWarning ? "warning: " : "info: ") + note);
  });
  return loaded;
}

void expect_bounds(const Mesh& mesh, const Vec3& low, const Vec3& high) {
  const Box3 box = bounds_of(mesh);
  EXPECT_LT((box.low - low).cwiseAbs().maxCoeff(), kFloat) << box.low.transpose();
  EXPECT_LT((box.high - high).cwiseAbs().maxCoeff(), kFloat) << box.high.transpose();
}

// ---------------------------------------------------------------------------------------------------------------------

struct Format {
  std::string name;
  std::string file;
  std::string text;
  std::vector<std::string> materials;
};
void PrintTo(const Format& format, std::ostream* out) {
  *out << format.name;
}

class MeshFormatTest : public testing::TestWithParam<Format> {};

TEST_P(MeshFormatTest, HoldsTheSameSolid) {
  const ScratchFolder folder;
  folder.write("corner.bin", gltf_buffer());
  const Loaded loaded = load(folder.write(GetParam().file, GetParam().text));
  const Mesh& mesh = loaded.mesh;

  EXPECT_THAT(loaded.notes, IsEmpty());
  EXPECT_EQ(mesh.name, "corner");
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(mesh.vertices.size(), 12U) << "all edges are sharp: no vertex is shared";
  EXPECT_NEAR(volume_of(mesh), 5, kFloat) << "of the right size, and winding outwards";
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_GT(least_agreement(mesh), 1 - kFloat);
  expect_bounds(mesh, {0, 0, 0}, {2, 3, 5});
  EXPECT_EQ(mesh.material_names, GetParam().materials);
}

INSTANTIATE_TEST_SUITE_P(
    All, MeshFormatTest,
    testing::Values(Format{"Obj", "corner.obj", obj_text(), {""}},
                    Format{"ObjWithWindowsLineEnds",
                           "corner.OBJ",
                           "v 0 0 0\r\nv 2 0 0\r\nv 0 3 0\r\nv 0 0 5\r\nf 1 3 2\r\nf 1 2 4\r\nf 1 4 3\r\nf 2 3 4\r\n",
                           {""}},
                    Format{"AsciiStl", "corner.stl", ascii_stl_text(), {""}},
                    Format{"BinaryStl", "corner.stl", binary_stl_text(), {""}},
                    Format{"AsciiPly", "corner.ply", ascii_ply_text(), {""}},
                    Format{"BinaryPly", "corner.ply", binary_ply_text(), {""}},
                    Format{"Dae", "corner.dae", dae_text(), {""}},
                    Format{"Gltf", "corner.gltf", gltf_text("corner.bin"), {"hull"}},
                    Format{"Glb", "corner.glb", glb_text(), {"hull"}}),
    [](const auto& format) { return format.param.name; });

// ---------------------------------------------------------------------------------------------------------------------

TEST(LoadMeshTest, DaeUnitsBecomeMetres) {
  const ScratchFolder folder;
  expect_bounds(load_mesh(folder.write("a.dae", dae_text({.unit = "0.01"}))), {0, 0, 0}, {0.02, 0.03, 0.05});
}

TEST(LoadMeshTest, DaeUpAxisIsLeftAlone) {
  const ScratchFolder folder;
  for (const std::string up_axis : {"Y_UP", "X_UP"}) {
    expect_bounds(load_mesh(folder.write("a.dae", dae_text({.up_axis = up_axis}))), {0, 0, 0}, {2, 3, 5});
  }
}

// The outer node moves by (10, 0, 0), the inner one turns a quarter about z and doubles: (x, y, z) -> (10 - 2y, 2x,
// 2z).
TEST(LoadMeshTest, NodesPlaceTheirMeshes) {
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write(
      "a.dae", dae_text({.nodes = R"(<node id="o"><translate>10 0 0</translate><node id="i"><rotate>0 0 1 90</rotate>)"
                                  R"(<scale>2 2 2</scale><instance_geometry url="#g"/></node></node>)"})));
  expect_bounds(mesh, {4, 0, 0}, {10, 4, 10});
  EXPECT_NEAR(volume_of(mesh), 5 * 8, 40 * kFloat);
}

TEST(LoadMeshTest, AMeshMayStandInSeveralPlaces) {
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write(
      "a.dae",
      dae_text({.nodes = R"(<node id="a"><instance_geometry url="#g"/></node>)"
                         R"(<node id="b"><translate>0 0 20</translate><instance_geometry url="#g"/></node>)"})));
  EXPECT_EQ(mesh.triangles.size(), 8U);
  expect_bounds(mesh, {0, 0, 0}, {2, 3, 25});
}

TEST(LoadMeshTest, MirroredNodesStillWindOutwards) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write(
      "a.dae", dae_text({.nodes = R"(<node id="n"><scale>-1 1 2</scale><instance_geometry url="#g"/></node>)"})));
  EXPECT_NEAR(volume_of(loaded.mesh), 10, kFloat);
  expect_bounds(loaded.mesh, {-2, 0, 0}, {0, 3, 10});
}

// A triangle in the plane x + z = 1 with its normal. Stretched by 3 along z the plane is x + z / 3 = 1: the normal
// becomes (3, 0, 1) / sqrt(10), not (1, 0, 3); mirrored in x it becomes (-3, 0, 1) / sqrt(10).
TEST(LoadMeshTest, NormalsFollowTheirNodesStretch) {
  const auto text = [](const std::string& x) {
    return dae_text({.positions = "1 0 0 1 1 0 0 0 1",
                     .triangles = R"(<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/>)"
                                  R"(<input semantic="NORMAL" source="#q" offset="1"/><p>0 0 1 0 2 0</p></triangles>)",
                     .nodes = "<node id=\"n\"><scale>" + x + " 1 3</scale><instance_geometry url=\"#g\"/></node>"});
  };
  const std::string normals =
      R"(<source id="q"><float_array id="qa" count="3">0.70710678 0 0.70710678</float_array><technique_common>)"
      R"(<accessor source="#qa" count="1" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>)"
      R"(<param name="Z" type="float"/></accessor></technique_common></source><vertices )";
  const ScratchFolder folder;
  for (const double x : {1.0, -1.0}) {
    std::string dae = text(x > 0 ? "1" : "-1");
    dae.replace(dae.find("<vertices "), std::string_view("<vertices ").size(), normals);
    const Loaded loaded = load(folder.write("a.dae", dae));
    EXPECT_THAT(loaded.notes, IsEmpty());
    ASSERT_EQ(loaded.mesh.normals.size(), 3U);
    for (const Vec3f& normal : loaded.mesh.normals) {
      EXPECT_LT((normal.cast<double>() - Vec3(3 * x, 0, 1) / std::sqrt(10)).norm(), kFloat);
    }
    EXPECT_GT(least_agreement(loaded.mesh), 1 - kFloat);
  }
}

// ---------------------------------------------------------------------------------------------------------------------

TEST(LoadMeshTest, ObjMaterialsBecomeSlots) {
  const ScratchFolder folder;
  const Mesh mesh =
      load_mesh(folder.write("a.obj",
                             "mtllib gone.mtl\nv 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 5\n"
                             "usemtl steel\nf 1 3 2\nusemtl rust\nf 1 2 4\nf 1 4 3\nusemtl steel\nf 2 3 4\n"));
  EXPECT_THAT(mesh.material_names, ElementsAre("steel", "rust"));
  double rusty = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    rusty += mesh.slot_of(i) == 1 ? doubled_area(mesh, mesh.triangles[i]).norm() / 2 : 0;
  }
  // The sides across y (2 x 5 / 2) and across x (3 x 5 / 2).
  EXPECT_NEAR(rusty, 12.5, kFloat);
}

TEST(LoadMeshTest, DaeMaterialsBecomeSlots) {
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write(
      "a.dae", dae_text({.materials = R"(<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert/>)"
                                      R"(</technique></profile_COMMON></effect></library_effects><library_materials>)"
                                      R"(<material id="m1" name="Sandstein"><instance_effect url="#e"/></material>)"
                                      R"(</library_materials>)",
                         .nodes = R"(<node id="n" name="corner"><instance_geometry url="#g"><bind_material>)"
                                  R"(<technique_common><instance_material symbol="m" target="#m1"/></technique_common>)"
                                  R"(</bind_material></instance_geometry></node>)"})));
  EXPECT_THAT(mesh.material_names, ElementsAre("Sandstein"));
  EXPECT_THAT(mesh.material_slots, IsEmpty()) << "one material needs no slots";
}

// ---------------------------------------------------------------------------------------------------------------------

std::string two_object_text() {
  return "o hull\nv 0 0 0\nv 2 0 0\nv 0 3 0\nf 1 2 3\no mast\nv 10 0 0\nv 10 4 0\nv 10 0 8\nf 4 5 6\n";
}

TEST(SubmeshTest, IsFoundByTheNameOfItsNode) {
  const ScratchFolder folder;
  const Mesh mesh = load(folder.write("ship.obj", two_object_text()), {.name = "mast"}).mesh;
  EXPECT_EQ(mesh.triangles.size(), 1U);
  expect_bounds(mesh, {10, 0, 0}, {10, 4, 8});
}

TEST(SubmeshTest, IsFoundByTheNameOfItsMesh) {
  const ScratchFolder folder;
  EXPECT_EQ(load(folder.write("a.dae", dae_text()), {.name = "corner_mesh"}).mesh.triangles.size(), 4U);
  EXPECT_EQ(load(folder.write("a.dae", dae_text()), {.name = "corner"}).mesh.triangles.size(), 4U);
}

TEST(SubmeshTest, IsCentredOnRequest) {
  const ScratchFolder folder;
  const Mesh mesh = load(folder.write("ship.obj", two_object_text()), {.name = "mast", .center = true}).mesh;
  expect_bounds(mesh, {0, -2, -4}, {0, 2, 4});
}

TEST(SubmeshTest, UnknownNamesAreAnsweredWithTheKnown) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.write("ship.obj", two_object_text());
  EXPECT_EQ(message_of([&] { (void)load(path, {.name = "keel"}); }),
            path.string() + ": no submesh \"keel\"; there are: hull, mast");
}

// ---------------------------------------------------------------------------------------------------------------------

std::string text_of(const Mesh& mesh) {
  std::string text;
  for (const Vec3f& vertex : mesh.vertices) {
    text += fmt::format("v {} {} {}\n", vertex.x(), vertex.y(), vertex.z());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  }
  return text;
}

std::string stl_of(const Mesh& mesh) {
  std::vector<std::array<Vec3f, 3>> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  return binary_stl(triangles);
}

TEST(LoadMeshTest, ARoundShapeWithoutNormalsIsSmooth) {
  const Mesh sphere = make_sphere(2, 0.2);
  const ScratchFolder folder;
  for (const auto& path : {folder.write("a.obj", text_of(sphere)), folder.write("a.stl", stl_of(sphere)),
                           folder.write("a.ply", binary_ply(sphere.vertices, sphere.triangles))}) {
    const Mesh mesh = load_mesh(path);
    EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size()) << path;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      // The mean of the faces round a vertex errs by much less than the 0.2 rad between faces.
      ASSERT_GT(mesh.normals[i].dot(mesh.vertices[i].normalized()), std::cos(0.05)) << path;
    }
  }
}

TEST(LoadMeshTest, NormalsOfTheFileAreKept) {
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(
      folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.6 0 0.8\nvn 0 0 7\nvn 0 0.6 0.8\nf 1//1 2//2 3//3\n"));
  ASSERT_EQ(mesh.normals.size(), 3U);
  EXPECT_LT((mesh.normals[0] - Vec3f(0.6F, 0, 0.8F)).norm(), kFloat);
  EXPECT_LT((mesh.normals[1] - Vec3f(0, 0, 1)).norm(), kFloat);
}

// STL stores one normal a triangle and it is often wrong; here it points sideways.
TEST(LoadMeshTest, NormalsOfStlAreNot) {
  std::string text = binary_stl({{Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)}});
  text.replace(84, 4, bytes_of(1.0F));
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write("a.stl", text));
  EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 1));
}

TEST(LoadMeshTest, PolygonsAreCutIntoTriangles) {
  const ScratchFolder folder;
  // An L: the square of side 2 without its quarter, 3 m^2; its second corner is concave.
  const Mesh mesh =
      load_mesh(folder.write("a.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n"));
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_NEAR(area_of(mesh), 3, kFloat);
  EXPECT_GT(least_agreement(mesh), 1 - kFloat);
  EXPECT_EQ(mesh.normals[0].z(), 1);
}

TEST(LoadMeshTest, NumbersMayBeginWithTheirPoint) {
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write("a.obj", "o .5\nv 1 .5 2\nv\t.25 -.5 0\nv 0 1 .125\nf 1 2 3\n"));
  expect_bounds(mesh, {0, -0.5, 0}, {1, 1, 2});
  EXPECT_EQ(load(folder.path() / "a.obj", {.name = ".5"}).mesh.triangles.size(), 1U) << "names keep theirs";
}

TEST(LoadMeshTest, SaysInOneLineWhatItDropped) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write("wreck.obj",
                                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv nan 0 0\nv 0 0 1e99\n"
                                          "f 1 2 3\nf 1 2 4\nf 1 2 2\nf 1 2 5\nf 1 2 6\nl 1 2\n"));
  EXPECT_THAT(loaded.notes, ElementsAre("warning: wreck.obj: 4 of 5 triangles dropped (2 of zero area, 2 with NaN "
                                        "corners); 1 line or point dropped"));
  EXPECT_EQ(loaded.mesh.triangles.size(), 1U);
  EXPECT_EQ(loaded.mesh.vertices.size(), 3U);
}

TEST(LoadMeshTest, SaysWhichNormalsItTurned) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write(
      "wreck.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 -1\nf 1//1 2//1 3//1\nf 1//1 3//1 2//1\n"));
  EXPECT_THAT(loaded.notes, ElementsAre("info: wreck.obj: 3 normals turned to the side of their winding"));
}

TEST(LoadMeshTest, CornersThatDoNotExistAreDropped) {
  const ScratchFolder folder;
  const Loaded loaded =
      load(folder.write("a.ply", ply_header("ascii", 3, 2) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 9\n"));
  EXPECT_THAT(loaded.notes, ElementsAre("warning: a.ply: 1 of 2 triangles dropped (1 with corners that do not exist)"));
}

// 2^23 m away a float resolves 1 m.
TEST(LoadMeshTest, WarnsOfCoordinatesTooFarForTheirDetail) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write("a.obj", "v 8388608 0 0\nv 8388618 0 0\nv 8388608 5 0\nf 1 2 3\n"));
  EXPECT_THAT(loaded.notes,
              ElementsAre("warning: a.obj: coordinates as far as 8388618 m from the origin are rounded to "
                          "1 m; move the mesh nearer to it"));
}

TEST(LoadMeshTest, BigMeshesKeepTo26BytesATriangle) {
  std::vector<float> heights(300 * 300);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    heights[i] = static_cast<float>(std::sin(0.1 * static_cast<double>(i)));
  }
  const Mesh field = make_height_field({300, 300, 4, 4, heights, {}});
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write("a.stl", stl_of(field)));
  EXPECT_EQ(mesh.triangles.size(), field.triangles.size());
  const std::size_t bytes = (mesh.vertices.capacity() + mesh.normals.capacity()) * sizeof(Vec3f) +
                            mesh.triangles.capacity() * sizeof(mesh.triangles[0]) + mesh.material_slots.capacity() * 2;
  EXPECT_LT(static_cast<double>(bytes) / static_cast<double>(mesh.triangles.size()), 26);
}

// ---------------------------------------------------------------------------------------------------------------------

struct BadFile {
  std::string name;
  std::string text;
  std::string message;  // After the path.
};

TEST(LoadMeshErrorTest, TellsThePathAndTheReason) {
  const std::string known = "; known: .obj, .stl, .dae, .ply, .gltf, .glb";
  const std::vector<BadFile> files{
      {"a.fbx", "x", ": \".fbx\" is no known ending of a mesh file" + known},
      {"a", "x", ": \"\" is no known ending of a mesh file" + known},
      {"a.obj", "", ": the file is empty"},
      {"a.obj", "# only a comment\n", ": no triangles"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\np 1\n", ": no triangles, only 2 lines or points"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n", ": cannot be read: OBJ: vertex index out of range"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 2\nf 1 2 3\n",
       ": no triangles left: 2 of 2 triangles dropped (1 of zero area, 1 with NaN corners)"},
      {"a.stl", std::string(200, 'x'), ": cannot be read: Failed to determine STL storage representation for {path}"},
      {"a.stl", std::string(84, '\0'), ": cannot be read: STL: file is empty. There are no facets defined"},
      {"a.ply", "plumb", ": cannot be read: Invalid .ply file: Incorrect magic number (expected 'ply' or 'PLY')"},
      {"a.dae", "<COLLADA><asset>", ": cannot be read: Unable to read file, malformed XML"},
      {"a.dae", dae_text({.positions = "0 0 0 2 0 0"}),
       ": cannot be read: Invalid data index (2/2) in primitive specification"},
      {"a.gltf", "{\"asset\":", ": cannot be read: what it holds is not gltf"},
      {"a.glb", "glTF", ": cannot be read: what it holds is not glb"},
      {"a.gltf", gltf_text("gone.bin"), ": cannot be read: GLTF: could not open referenced file \"gone.bin\""},
  };
  for (const BadFile& file : files) {
    const ScratchFolder folder;
    const std::string path = folder.write(file.name, file.text).string();
    std::string expected = path + file.message;
    if (const std::size_t at = expected.find("{path}"); at != std::string::npos) {
      expected.replace(at, 6, path);
    }
    EXPECT_EQ(message_of([&] { (void)load_mesh(path); }), expected);
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

// ---------------------------------------------------------------------------------------------------------------------

// Sizes as the files' publishers give them, or as their raw coordinates times the matrices of their nodes.
struct RealMesh {
  std::string file;
  Vec3 size;
  std::size_t triangles;  // That the file holds.
  std::size_t dropped;
};

TEST(RealMeshTest, HasItsKnownSize) {
  INSONIFY_REAL_DATA(folder, "models_smarc");
  const std::vector<RealMesh> meshes{
      {"models_smarc/skytteren__skytteren_repaired.dae", {175.717, 42.016, 35.999}, 8358, 10},
      {"models_smarc/pipeline__pipeline.dae", {502.012, 161.634, 2.820}, 6528, 0},
      {"models_smarc/pipeline__pipeline_collision.stl", {502.012, 161.634, 2.820}, 6528, 0},
      {"models_smarc/large_rock__large_rock.dae", {2.520, 2.000, 1.886}, 320, 0},
      {"models_uuv_simulator/rov_bop_panel__BOP_Panel.dae", {0.5, 0.8, 0.36}, 5212, 0},
      {"models_uuv_simulator/aurora_static__aurora_collision.stl", {12.235, 37, 19.693}, 22744, 494},
      {"models_dave/mbari_mars__mbari_mars.dae", {7.204, 6.004, 1.603}, 10694, 0},
      {"models_dave/Coke_Can__coke_can.obj", {0.067, 0.067, 0.124}, 5120, 0},
      {"bathymetry_meshes/uuv__munkholmen_seabed__seabed.dae", {2386.02, 1478.55, 65.352}, 2115, 4},
      {"bathymetry_meshes/uuv__lake__LakeBottom.dae",
       {14.620648 * 68.27943, 16.101481 * 61.95707, 3.7793199 * 39.55682},
       12020,
       0},
  };
  for (const RealMesh& real : meshes) {
    const Mesh mesh = load_mesh(folder.parent_path() / real.file);
    const Box3 box = bounds_of(mesh);
    EXPECT_LT((box.high - box.low - real.size).cwiseAbs().maxCoeff(), 0.005) << real.file;
    EXPECT_EQ(mesh.triangles.size(), real.triangles - real.dropped) << real.file;
    EXPECT_LT(normal_length_error(mesh), kFloat) << real.file;
    // As clean_mesh promises: no shading normal leans to the far side of its triangle by more than rounding.
    EXPECT_GT(least_agreement(mesh), -0.002) << real.file;
  }
}

TEST(RealMeshTest, KeepsTheNamesOfItsMaterials) {
  INSONIFY_REAL_DATA(wreck, "models_smarc/skytteren__skytteren_repaired.dae");
  EXPECT_THAT(load_mesh(wreck).material_names, ElementsAre("beyaz", "kirmizi", "odun", "metal", "odun2", "bisi"));
}

}  // namespace
}  // namespace insonify
