// load_mesh_test.cpp -- every mesh format gives the same solid, in metres, z up, with its names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "io/loaded_mesh.h"
#include "io/mesh_texts.h"
#include "scene/mesh_checks.h"
#include "support/message_of.h"

namespace insonify::load_mesh_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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

// Byte-order mark that some editors write before UTF-8.
const std::string kByteOrderMark = "\xef\xbb\xbf";

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
                    Format{"ObjWithByteOrderMark", "corner.obj", kByteOrderMark + obj_text(), {""}},
                    Format{"ObjWithCommentsBehindNumbers",
                           "corner.obj",
                           "v 0 0 0 # o\nv 2 0 0\nv 0 3 0\nv 0 0 5\nf 1 3 2 # below\r\nf 1 2 4\nf 1 4 3\nf 2 3 4 #",
                           {""}},
                    Format{"ObjWithStatementsOnSeveralLines",
                           "corner.obj",
                           "v 0 0 0\nv 2 \\\n 0 0\nv 0 3 0\nv 0 0 \\\r\n5\nf 1 3 \\\n2\nf 1 2 4\nf 1 4 3\nf 2 3 4",
                           {""}},
                    Format{"AsciiStl", "corner.stl", ascii_stl_text(), {""}},
                    Format{"AsciiStlWithByteOrderMark", "corner.stl", kByteOrderMark + ascii_stl_text(), {""}},
                    Format{"BinaryStl", "corner.stl", binary_stl_text(), {""}},
                    Format{"AsciiPly", "corner.ply", ascii_ply_text(), {""}},
                    Format{"AsciiPlyWithByteOrderMark", "corner.ply", kByteOrderMark + ascii_ply_text(), {""}},
                    Format{"BinaryPly", "corner.ply", binary_ply_text(), {""}},
                    Format{"Dae", "corner.dae", dae_text(), {""}},
                    Format{"DaeWithByteOrderMark", "corner.dae", kByteOrderMark + dae_text(), {""}},
                    Format{"Gltf", "corner.gltf", gltf_text("corner.bin"), {"hull"}},
                    Format{"GltfWithByteOrderMark", "corner.gltf", kByteOrderMark + gltf_text("corner.bin"), {"hull"}},
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

// Sizes as the files' publishers state them, or raw coordinates times the matrices of their nodes.
struct RealMesh {
  std::string file;
  Vec3 size;
  std::size_t triangles;  // In the file.
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
    // As clean_mesh promises: no shading normal is on the back of its triangle, except for rounding.
    EXPECT_GT(least_agreement(mesh), -0.002) << real.file;
  }
}

TEST(RealMeshTest, KeepsTheNamesOfItsMaterials) {
  INSONIFY_REAL_DATA(wreck, "models_smarc/skytteren__skytteren_repaired.dae");
  EXPECT_THAT(load_mesh(wreck).material_names, ElementsAre("beyaz", "kirmizi", "odun", "metal", "odun2", "bisi"));
}

}  // namespace
}  // namespace insonify::load_mesh_test
