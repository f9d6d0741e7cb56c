// mesh_cleanup_test.cpp -- normals, polygons and numbers of mesh files, and warnings about dropped parts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "insonify/files.h"
#include "io/loaded_mesh.h"
#include "io/mesh_texts.h"
#include "scene/mesh_checks.h"

namespace insonify::mesh_cleanup_test {
namespace {

using testing::ElementsAre;

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

TEST(MeshCleanupTest, ARoundShapeWithoutNormalsIsSmooth) {
  const Mesh sphere = make_sphere(2, 0.2);
  const ScratchFolder folder;
  for (const auto& path : {folder.write("a.obj", text_of(sphere)), folder.write("a.stl", stl_of(sphere)),
                           folder.write("a.ply", binary_ply(sphere.vertices, sphere.triangles))}) {
    const Mesh mesh = load_mesh(path);
    EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size()) << path;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      // The mean of the normals around a vertex errs by much less than the 0.2 rad between faces.
      ASSERT_GT(mesh.normals[i].dot(mesh.vertices[i].normalized()), std::cos(0.05)) << path;
    }
  }
}

TEST(MeshCleanupTest, NormalsOfTheFileAreKept) {
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(
      folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.6 0 0.8\nvn 0 0 7\nvn 0 0.6 0.8\nf 1//1 2//2 3//3\n"));
  ASSERT_EQ(mesh.normals.size(), 3U);
  EXPECT_LT((mesh.normals[0] - Vec3f(0.6F, 0, 0.8F)).norm(), kFloat);
  EXPECT_LT((mesh.normals[1] - Vec3f(0, 0, 1)).norm(), kFloat);
}

// STL stores one normal per triangle, which is often wrong; here it points sideways.
TEST(MeshCleanupTest, NormalsOfStlAreNot) {
  std::string text = binary_stl({{Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)}});
  text.replace(84, 4, bytes_of(1.0F));
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write("a.stl", text));
  EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 1));
}

TEST(MeshCleanupTest, PolygonsAreCutIntoTriangles) {
  const ScratchFolder folder;
  // An L: a square of side 2 less a quarter, 3 m^2; its second corner is concave.
  const Mesh mesh =
      load_mesh(folder.write("a.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n"));
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_NEAR(area_of(mesh), 3, kFloat);
  EXPECT_GT(least_agreement(mesh), 1 - kFloat);
  EXPECT_EQ(mesh.normals[0].z(), 1);
}

TEST(MeshCleanupTest, NumbersMayBeginWithTheirPoint) {
  const ScratchFolder folder;
  const Mesh mesh = load_mesh(folder.write("a.obj", "o .5\nv 1 .5 2\nv\t.25 -.5 0\nv 0 1 .125\nf 1 2 3\n"));
  expect_bounds(mesh, {0, -0.5, 0}, {1, 1, 2});
  EXPECT_EQ(load(folder.path() / "a.obj", {.name = ".5"}).mesh.triangles.size(), 1U) << "names keep theirs";
}

TEST(MeshCleanupTest, NumbersMayHaveADecimalComma) {
  const ScratchFolder folder;
  expect_bounds(load_mesh(folder.write("a.obj", "v 0 0 0\nv 1,5 ,25 0\nv 0 2,0e0 -0,5\nf 1 2 3\n")), {0, 0, -0.5},
                {1.5, 2, 0});
}

TEST(MeshCleanupTest, SaysInOneLineWhatItDropped) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write("wreck.obj",
                                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv nan 0 0\nv 0 0 1e99\n"
                                          "f 1 2 3\nf 1 2 4\nf 1 2 2\nf 1 2 5\nf 1 2 6\nl 1 2\n"));
  EXPECT_THAT(loaded.notes, ElementsAre("warning: wreck.obj: 4 of 5 triangles dropped (2 of zero area, 2 with NaN "
                                        "corners); 1 line or point dropped"));
  EXPECT_EQ(loaded.mesh.triangles.size(), 1U);
  EXPECT_EQ(loaded.mesh.vertices.size(), 3U);
}

TEST(MeshCleanupTest, SaysWhichNormalsItTurned) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write(
      "wreck.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 -1\nf 1//1 2//1 3//1\nf 1//1 3//1 2//1\n"));
  EXPECT_THAT(loaded.notes, ElementsAre("info: wreck.obj: 3 normals turned to the side of their winding"));
}

TEST(MeshCleanupTest, CornersThatDoNotExistAreDropped) {
  const ScratchFolder folder;
  const Loaded loaded =
      load(folder.write("a.ply", ply_header("ascii", 3, 2) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 9\n"));
  EXPECT_THAT(loaded.notes, ElementsAre("warning: a.ply: 1 of 2 triangles dropped (1 with corners that do not exist)"));
}

// At 2^23 m a float resolves 1 m.
TEST(MeshCleanupTest, WarnsOfCoordinatesTooFarForTheirDetail) {
  const ScratchFolder folder;
  const Loaded loaded = load(folder.write("a.obj", "v 8388608 0 0\nv 8388618 0 0\nv 8388608 5 0\nf 1 2 3\n"));
  EXPECT_THAT(loaded.notes,
              ElementsAre("warning: a.obj: coordinates as far as 8388618 m from the origin are rounded to "
                          "1 m; move the mesh nearer to it"));
}

TEST(MeshCleanupTest, BigMeshesKeepTo26BytesATriangle) {
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

}  // namespace
}  // namespace insonify::mesh_cleanup_test
