// clean_mesh_test.cpp -- removal of invalid triangles, merging of vertices, and computation of normals.

#include <gtest/gtest.h>

#include "insonify/scene.h"
#include "scene/mesh_checks.h"
#include "support/message_of.h"

namespace insonify::clean_mesh_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Rounding of a unit normal in floats.
constexpr double kFloat = 5e-7;

std::string message_for(Mesh mesh) {
  return message_of([&] { (void)clean_mesh(mesh); });
}

// Every triangle with three vertices of its own, as STL has them.
Mesh as_soup(const Mesh& mesh) {
  Mesh soup;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t vertex : triangle) {
      soup.vertices.push_back(Vec3f(mesh.vertices[vertex]));
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// A strip of `count` unit squares along x, each turned against the last by `angle` about y.
Mesh folded_strip(const std::vector<double>& angles) {
  Mesh mesh;
  Vec3 at = Vec3::Zero();
  double turn = 0;
  for (std::size_t i = 0; i <= angles.size() + 1; ++i) {
    mesh.vertices.push_back(Vec3f(at.cast<float>()));
    mesh.vertices.push_back(Vec3f((at + Vec3::UnitY()).cast<float>()));
    at += Vec3(std::cos(turn), 0, std::sin(turn));
    turn += i < angles.size() ? angles[i] : 0;
  }
  for (std::uint32_t i = 0; i + 3 < mesh.vertices.size(); i += 2) {
    mesh.triangles.push_back({i, i + 2, i + 1});
    mesh.triangles.push_back({i + 1, i + 2, i + 3});
  }
  return mesh;
}

TEST(CleanMeshTest, DropsWhatCannotBeTracedAndSaysSo) {
  Mesh mesh;
  mesh.name = "wreck";
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {kNan, 0, 0}, {0, INFINITY, 0}, {5, 5, 5}};
  mesh.material_names = {"steel", "rust"};
  mesh.triangles = {{0, 1, 1}, {0, 1, 3}, {0, 1, 2}, {0, 4, 1}, {5, 0, 1}, {0, 1, 7}, {1, 3, 2}};
  mesh.material_slots = {0, 0, 1, 0, 0, 0, 0};
  const MeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.text(),
            "5 of 7 triangles dropped (2 of zero area, 2 with NaN corners, 1 with corners that do not exist)");
  EXPECT_EQ(report.triangles_read, 7U);
  EXPECT_EQ(report.dropped(), 5U);
  EXPECT_TRUE(report.normals_computed);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.slot_of(0), 1);
  EXPECT_EQ(mesh.slot_of(1), 0);
  EXPECT_EQ(mesh.vertices.size(), 4U) << "vertices that no triangle uses are gone, NaN among them";
  EXPECT_LT(normal_length_error(mesh), kFloat);
}

TEST(CleanMeshTest, SaysNothingOfACleanMesh) {
  Mesh mesh = make_box({1, 2, 3});
  EXPECT_EQ(clean_mesh(mesh).text(), "");
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_EQ(mesh.vertices.size(), 24U);
}

// Ten metres long: a float there resolves 1e-6 m, a height of 2e-6 is a sliver but a triangle, one of 5e-7 is rounding.
TEST(CleanMeshTest, ZeroAreaIsJudgedAgainstTheTrianglesOwnSize) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {5, 2e-6F, 0}, {5, 5e-7F, 0}, {1e-9F, 0, 0}, {0, 1e-9F, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 4, 5}};
  EXPECT_EQ(clean_mesh(mesh).zero_area, 1U);
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

TEST(CleanMeshTest, AMeshWithNothingLeftIsAnError) {
  Mesh mesh;
  mesh.name = "wreck.obj";
  EXPECT_EQ(message_for(mesh), "wreck.obj: no triangles");
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {kNan, 1, 0}};
  mesh.triangles = {{0, 1, 1}, {0, 1, 2}, {1, 0, 2}};
  EXPECT_EQ(message_for(mesh),
            "wreck.obj: no triangles left: 3 of 3 triangles dropped (1 of zero area, 2 with NaN corners)");
}

TEST(CleanMeshTest, SlotsMustFit) {
  Mesh mesh = make_box({1, 1, 1});
  mesh.material_slots = {0, 0};
  EXPECT_EQ(message_for(mesh), "mesh: 2 material slots for 12 triangles");
  mesh.material_slots.assign(12, 0);
  mesh.material_slots[7] = 1;
  EXPECT_EQ(message_for(mesh), "mesh: material slot 1 must be less than 1, the number of material names");
}

TEST(CleanMeshTest, SmoothsAShapeWithoutNormals) {
  for (const bool soup : {false, true}) {
    const Mesh sphere = make_sphere(2, 0.1);
    Mesh mesh = soup ? as_soup(sphere) : sphere;
    mesh.normals.clear();
    EXPECT_TRUE(clean_mesh(mesh).normals_computed);
    EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      // The mean of the faces round a vertex errs by much less than the 0.1 rad between faces.
      ASSERT_GT(mesh.normals[i].dot(mesh.vertices[i].normalized()), std::cos(0.02));
    }
  }
}

// Texts of six digits, and programs that compute corners anew for each triangle, move them by some 1e-6 m.
TEST(CleanMeshTest, CornersThatAreMovedALittleAreOne) {
  const Mesh sphere = make_sphere(0.5, 0.1);
  Mesh mesh = as_soup(sphere);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] += 2e-6F * Vec3f(std::sin(static_cast<float>(7 * i)), std::sin(static_cast<float>(5 * i)),
                                      std::cos(static_cast<float>(3 * i)));
  }
  EXPECT_EQ(clean_mesh(mesh).dropped(), 0U);
  EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size());
  EXPECT_EQ(mesh.triangles.size(), sphere.triangles.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    ASSERT_GT(mesh.normals[i].dot(mesh.vertices[i].normalized()), std::cos(0.02));
  }
}

TEST(CleanMeshTest, SmallTrianglesKeepTheirCorners) {
  Mesh mesh = make_box({1e-4, 2e-4, 2e-5});
  mesh.normals.clear();
  EXPECT_EQ(clean_mesh(mesh).dropped(), 0U);
  EXPECT_EQ(mesh.vertices.size(), 24U);
  EXPECT_TRUE(is_closed(mesh));
}

TEST(CleanMeshTest, SplitsABoxAtItsEdges) {
  Mesh mesh = as_soup(make_box({1, 2, 3}));
  const MeshReport report = clean_mesh(mesh);
  EXPECT_TRUE(report.normals_computed);
  EXPECT_EQ(report.normals_flipped, 0U);
  EXPECT_EQ(mesh.vertices.size(), 24U);
  EXPECT_GT(least_agreement(mesh), 1 - kFloat) << "each face keeps its own normal";
  EXPECT_TRUE(is_closed(mesh));
}

// A cylinder of 45 degrees a facet at most is round outside and flat at its ends.
TEST(CleanMeshTest, CylinderIsSmoothRoundAndCreasedAtItsEnds) {
  Mesh mesh = as_soup(make_cylinder(1, 2, 0.2));
  const MeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.dropped(), 0U);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 at = mesh.vertices[i].cast<double>();
    const Vec3 normal = mesh.normals[i].cast<double>();
    const Vec3 side = Vec3(at.x(), at.y(), 0);
    const bool is_end = std::abs(normal.z()) > 0.5;
    // Two long triangles of one facet meet at a vertex at unlike angles, so the mean leans by less than half a facet.
    EXPECT_GT(is_end ? std::abs(normal.z()) : normal.dot(side), is_end ? 1 - kFloat : std::cos(0.1));
  }
}

TEST(CleanMeshTest, CreaseAngleDecidesWhatIsSharp) {
  const double kink = radians_from_degrees(30);
  Mesh smooth = folded_strip({kink});
  Mesh sharp = folded_strip({kink});
  (void)clean_mesh(smooth, radians_from_degrees(28));
  (void)clean_mesh(sharp, radians_from_degrees(27));
  EXPECT_EQ(smooth.vertices.size(), 6U);
  EXPECT_EQ(sharp.vertices.size(), 8U);
  EXPECT_GT(least_agreement(sharp), 1 - kFloat);
}

// Two vertices on the fold: one triangle of a square meets the first with 90 degrees and one of the other with 45 + 45,
// so weights by angle make the mean the bisector: 15 degrees from each side.
TEST(CleanMeshTest, NormalOnAFoldIsItsBisector) {
  Mesh mesh = folded_strip({radians_from_degrees(30)});
  (void)clean_mesh(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertices[i].x() == 1) {
      EXPECT_NEAR(mesh.normals[i].z(), std::cos(radians_from_degrees(15)), kFloat);
    }
  }
}

TEST(CleanMeshTest, TrianglesThatWindAgainstTheirNeighboursStaySmooth) {
  Mesh mesh = make_sphere(1, 0.1);
  mesh.normals.clear();
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  }
  const MeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.dropped(), 0U);
  // Each triangle's normals lie on its own side, and are those of the sphere but for their sign.
  EXPECT_GT(least_agreement(mesh), std::cos(0.1));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    ASSERT_GT(std::abs(mesh.normals[i].dot(mesh.vertices[i].normalized())), std::cos(0.02));
  }
}

TEST(CleanMeshTest, DoubledTrianglesShadeBothSides) {
  Mesh mesh = folded_strip({0.1, 0.1});
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    mesh.triangles.push_back({c, b, a});
  }
  (void)clean_mesh(mesh);
  EXPECT_EQ(mesh.vertices.size(), 16U) << "eight points, each with a normal on either side";
  EXPECT_GT(least_agreement(mesh), std::cos(0.1));
}

TEST(CleanMeshTest, TurnsNormalsThatOpposeTheirWinding) {
  Mesh mesh = make_sphere(1, 0.2);
  const std::size_t vertex_count = mesh.vertices.size();
  for (Vec3f& normal : mesh.normals) {
    normal = -normal;
  }
  EXPECT_EQ(clean_mesh(mesh).normals_flipped, vertex_count);
  EXPECT_EQ(mesh.vertices.size(), vertex_count);
  EXPECT_GT(least_agreement(mesh), 0.9);
}

TEST(CleanMeshTest, SplitsAVertexWhoseTrianglesDisagree) {
  Mesh mesh = make_sphere(1, 0.2);
  const std::size_t vertex_count = mesh.vertices.size();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_EQ(clean_mesh(mesh).normals_flipped, 3U);
  EXPECT_EQ(mesh.vertices.size(), vertex_count + 3);
  EXPECT_GT(least_agreement(mesh), 0.9);
}

TEST(CleanMeshTest, KeepsGivenNormalsAndFillsTheMissing) {
  Mesh mesh = make_sphere(1, 0.2);
  mesh.normals[0] = Vec3f::Zero();
  mesh.normals[1] = Vec3f(kNan, 0, 1);
  mesh.normals[2] *= 7;  // A length is not a fault.
  const Vec3f kept = mesh.normals[5];
  const MeshReport report = clean_mesh(mesh);
  EXPECT_TRUE(report.normals_computed);
  EXPECT_LT(normal_length_error(mesh), kFloat);
  EXPECT_EQ(mesh.normals[5], kept);
  for (const std::size_t i : {0, 1, 2}) {
    EXPECT_GT(mesh.normals[i].dot(mesh.vertices[i]), std::cos(0.03));
  }
}

TEST(CleanMeshTest, NormalsOfTheWrongCountAreReplaced) {
  Mesh mesh = make_box({1, 1, 1});
  mesh.normals.pop_back();
  EXPECT_TRUE(clean_mesh(mesh).normals_computed);
  EXPECT_LT(normal_length_error(mesh), kFloat);
}

TEST(CleanMeshTest, JoinsEqualVerticesOnly) {
  Mesh mesh = as_soup(make_plane({0, 0, 1}, 2, 2));
  mesh.vertices[0].z() = -0.0F;  // Equals its twin at +0.
  (void)clean_mesh(mesh);
  EXPECT_EQ(mesh.vertices.size(), 4U);
}

// Every triangle meets at one point: neither the fan nor the edges may cost the square of their number.
TEST(CleanMeshTest, AFanOfManyTrianglesTakesNoTime) {
  Mesh mesh;
  constexpr int kCount = 200000;
  mesh.vertices.emplace_back(0, 0, 0);
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCount;
    mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    mesh.triangles.push_back({0, 1U + i, 1U + (i + 1) % kCount});
  }
  for (int i = 0; i < kCount; ++i) {  // A book: all pages share an edge.
    mesh.vertices.emplace_back(1 + i, 0, 1);
    mesh.triangles.push_back({0, 1, static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
  }
  (void)clean_mesh(mesh);
  EXPECT_LT(normal_length_error(mesh), kFloat);
}

// Said by check_reach(), with the coordinate.
TEST(CleanMeshTest, ATriangleLargerThanTheWorldIsNotDroppedAsOneWithoutArea) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1e30F, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(clean_mesh(mesh).dropped(), 0U);
  EXPECT_THAT([&] { check_reach({.mesh = std::make_shared<Mesh>(mesh)}, "sheet"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("sheet reaches x = 1.000000015e+30 m")));
}

}  // namespace
}  // namespace insonify::clean_mesh_test
