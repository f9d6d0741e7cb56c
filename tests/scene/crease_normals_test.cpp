// crease_normals_test.cpp -- which edges are round and which are sharp in meshes without vertex normals.

#include <gtest/gtest.h>

#include "insonify/scene.h"
#include "scene/mesh_checks.h"
#include "support/prism.h"

namespace insonify::crease_normals_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Coordinates as texts of whole millimetres have them.
Mesh in_millimetres(Mesh mesh, const Eigen::AngleAxisd& turn, const Vec3& place) {
  for (Vec3f& vertex : mesh.vertices) {
    const Vec3 at = 1000 * (turn * vertex.cast<double>() + place);
    vertex = (at.array().round() / 1000).matrix().cast<float>();
  }
  return mesh;
}

// Corners of a prism's sides have one normal where its edges are round and two where they are sharp; those of its ends
// are sharp.
std::size_t round_prism(int sides) {
  return 2U * 2U * static_cast<std::size_t>(sides);
}
std::size_t faceted_prism(int sides) {
  return 2U * 3U * static_cast<std::size_t>(sides);
}

// Edges of eight sides are of 45 degrees, in bends and by rounding of a few more or less, those of seven of 51.4.
TEST(CreaseNormalsTest, ATubeOfEightSidesIsRoundWhereverItLies) {
  for (int i = 0; i < 200; ++i) {
    const Eigen::AngleAxisd turn(0.37 * i, Vec3(std::sin(i), std::cos(3 * i), std::sin(5 * i)).normalized());
    const Vec3 place(0.0123 * i, -0.1 * i, 0.00071 * i);
    const double radius = 0.02 * std::pow(1.03, i);  // To 7 m.
    Mesh eight = in_millimetres(prism(polygon(8, radius), 10 * radius), turn, place);
    Mesh six = in_millimetres(prism(polygon(6, radius), 10 * radius), turn, place);
    (void)clean_mesh(eight);
    (void)clean_mesh(six);
    ASSERT_EQ(eight.vertices.size(), round_prism(8)) << i;
    ASSERT_EQ(six.vertices.size(), faceted_prism(6)) << i;
  }
  Mesh seven = prism(polygon(7, 1), 10);
  (void)clean_mesh(seven);
  EXPECT_EQ(seven.vertices.size(), faceted_prism(7));
}

// The least cosine between the normal of a triangle in the plane x = 0.5 and those of its vertices.
double flatness(const Mesh& mesh) {
  double least = 1;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 normal = doubled_area(mesh, triangle).normalized();
    if (normal.x() > 1 - 1e-6) {
      for (const std::uint32_t vertex : triangle) {
        least = std::min(least, normal.dot(mesh.normals[vertex].cast<double>()));
      }
    }
  }
  return least;
}

TEST(CreaseNormalsTest, FacesBesideRoundedEdgesStayPlane) {
  for (const double depth : {0.005, 0.02, 0.1}) {
    for (const int steps : {1, 2, 3, 6, 20}) {
      Mesh mesh = prism(rounded_square(1, depth, steps), 1);
      (void)clean_mesh(mesh);
      EXPECT_GT(flatness(mesh), std::cos(0.05 * kDegree)) << depth << ", " << steps;
    }
  }
}

// Chamfers are plane too: every corner of the section has a normal for each side of it. An arc of two steps and more is
// round, and goes on from its neighbours' normals.
TEST(CreaseNormalsTest, ChamfersAreSharpAndRoundedEdgesRound) {
  Mesh chamfered = prism(rounded_square(1, 0.05, 1), 1);
  (void)clean_mesh(chamfered);
  EXPECT_EQ(chamfered.vertices.size(), faceted_prism(8));
  for (const int steps : {2, 3, 6}) {
    Mesh rounded = prism(rounded_square(1, 0.05, steps), 1);
    (void)clean_mesh(rounded);
    EXPECT_EQ(rounded.vertices.size(), round_prism(4 * (steps + 1))) << steps;
  }
}

// Two straight parts of 2 m and a bend between them: the normals at the joints are those of the straight parts.
TEST(CreaseNormalsTest, APipeIsStraightUpToItsBends) {
  constexpr int kSides = 12, kSteps = 4;
  constexpr double kRadius = 0.05, kBend = 0.2;
  std::vector<std::pair<Vec3, Vec3>> rings = {{{-2, 0, 0}, Vec3::UnitX()}};  // Centre and direction.
  for (int step = 0; step <= kSteps; ++step) {
    const double angle = 90 * kDegree * step / kSteps;
    rings.emplace_back(Vec3(kBend * std::sin(angle), kBend * (1 - std::cos(angle)), 0),
                       Vec3(std::cos(angle), std::sin(angle), 0));
  }
  rings.emplace_back(Vec3(kBend, 2 + kBend, 0), Vec3::UnitY());
  Mesh mesh;
  for (const auto& [centre, along] : rings) {
    for (const Eigen::Vector2d& corner : polygon(kSides, kRadius)) {
      mesh.vertices.emplace_back(
          (centre + corner.x() * Vec3::UnitZ().cross(along) + corner.y() * Vec3::UnitZ()).cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < rings.size(); ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = ring * kSides + i, b = ring * kSides + (i + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  }
  (void)clean_mesh(mesh);
  ASSERT_EQ(mesh.vertices.size(), rings.size() * kSides);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const bool along_x = i < 2 * kSides, along_y = i >= (rings.size() - 2) * kSides;
    if (along_x || along_y) {
      EXPECT_NEAR(mesh.normals[i][along_x ? 0 : 1], 0, 1e-5) << i;
    }
  }
}

}  // namespace
}  // namespace insonify::crease_normals_test
