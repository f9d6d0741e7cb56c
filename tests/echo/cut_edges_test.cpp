// cut_edges_test.cpp -- edges do not depend on how a mesh is cut, and a thin sheet has those of one plate.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "echo/edge_scene.h"

namespace insonify::cut_edges_test {
namespace {

using namespace edge_scene;

// A side along which the next face has other corners is one edge, not two borders.
TEST(CutEdgesTest, UnequalTrianglesMakeNoBorders) {
  Mesh mesh;
  add_rectangle(mesh, {0, 0, 0}, {0.4F, 0, 0}, {0.4F, 0.3F, 0}, {0, 0.3F, 0});
  add_rectangle(mesh, {0, 0, 0}, {0, 0.12F, 0}, {0, 0.12F, 0.4F}, {0, 0, 0.4F});
  add_rectangle(mesh, {0, 0.12F, 0}, {0, 0.3F, 0}, {0, 0.3F, 0.4F}, {0, 0.12F, 0.4F});
  const auto edges = all_edges(scene_of({{mesh}}));
  ASSERT_EQ(edges.size(), 7U);
  const auto bend = std::ranges::min_element(edges, {}, &StraightEdges::Edge::exterior);
  EXPECT_NEAR(bend->exterior, 1.5, 1e-6);
  EXPECT_NEAR(2 * bend->half, 0.3, 1e-6);
}

// Corners moved by less than `by` along each axis.
Mesh moved(Mesh mesh, float by) {
  std::mt19937 random(3);
  for (Vec3f& vertex : mesh.vertices) {
    for (float& x : vertex) {
      x += by * (static_cast<float>(random() % 2001) / 1000 - 1);
    }
  }
  return mesh;
}

Mesh with_copies(Mesh mesh, bool turned) {
  for (std::size_t i = 0, count = mesh.triangles.size(); i < count; ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    mesh.triangles.push_back({a, turned ? c : b, turned ? b : c});
  }
  return mesh;
}

// A box whose faces are cut in strips, each axis into others, so that corners lie on the sides of their neighbours.
Mesh striped_box(const Vec3f& size) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    const int strips = 2 + axis, along = (axis + 1) % 3, across = (axis + 2) % 3;
    for (const int side : {0, 1}) {
      for (int i = 0; i < strips; ++i) {
        const auto at = [&](int step, int end) {
          Vec3f place;
          place[axis] = static_cast<float>(side) * size[axis];
          place[along] = static_cast<float>(step) / static_cast<float>(strips) * size[along];
          place[across] = static_cast<float>(end) * size[across];
          return Vec3f(place - 0.5F * size);
        };
        side == 1 ? add_rectangle(mesh, at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1))
                  : add_rectangle(mesh, at(i, 0), at(i, 1), at(i + 1, 1), at(i + 1, 0));
      }
    }
  }
  return mesh;
}

// The same box, however its mesh is cut, and 1 km from the origin of its mesh, where floats are 6e-5 m apart.
TEST(CutEdgesTest, ABoxHasTwelveHoweverItIsCut) {
  const Vec3f size(0.7F, 0.4F, 0.2F);
  const Mesh plain = tessellated_box(size, 1), striped = striped_box(size), fine = tessellated_box(size, 3);
  Mesh far = moved(striped, 1e-6F);
  for (Vec3f& vertex : far.vertices) {
    vertex += Vec3f(700, -600, 400);
  }
  for (const Mesh& mesh : {with_copies(plain, false), with_copies(plain, true), moved(plain, 1e-6F), striped,
                           moved(striped, 1e-5F), with_copies(moved(fine, 2e-6F), true), far}) {
    const auto edges = all_edges(scene_of({{mesh}}));
    ASSERT_EQ(edges.size(), 12U);
    EXPECT_NEAR(total_length(edges), 4 * (0.7 + 0.4 + 0.2), 1e-3);
    for (const StraightEdges::Edge& edge : edges) {
      EXPECT_NEAR(edge.exterior, 1.5, 1e-3);
      EXPECT_NE(edge.sides[0].face, edge.sides[1].face);
    }
  }
}

// A sheet is a plate with four borders, whether both of its sides are faces in one place, a box, or two faces without
// a rim; from 1 mm on it is a box. The normal of each side of an edge is that of the face that it names.
TEST(CutEdgesTest, SheetsHaveTheBordersOfOnePlate) {
  Mesh sides = make_plane(Vec3::UnitZ(), 0.5, 0.3);
  sides = with_copies(sides, true);
  for (const float thickness : {1e-5F, 1e-4F, 5e-4F, 9e-4F}) {
    Mesh open;
    const float z = 0.5F * thickness;
    add_rectangle(open, {0, 0, z}, {0.5F, 0, z}, {0.5F, 0.3F, z}, {0, 0.3F, z});
    add_rectangle(open, {0, 0, -z}, {0, 0.3F, -z}, {0.5F, 0.3F, -z}, {0.5F, 0, -z});
    for (const Mesh& mesh : {sides, open, make_box({0.5, 0.3, double{thickness}})}) {
      const auto edges = all_edges(scene_of({{mesh}}));
      ASSERT_EQ(edges.size(), 4U) << thickness;
      EXPECT_NEAR(total_length(edges), 1.6, 4e-3);
      for (const StraightEdges::Edge& edge : edges) {
        EXPECT_EQ(edge.exterior, 2);
        EXPECT_NEAR(std::abs(edge.sides[0].normal.z()), 1, 1e-5);
        EXPECT_NE(edge.sides[0].face, StraightEdges::kNoGlint);
        EXPECT_NE(edge.sides[1].face, StraightEdges::kNoGlint);
      }
    }
  }
  EXPECT_EQ(all_edges(scene_of({{make_box({0.5, 0.3, 1.1e-3})}})).size(), 8U);  // Those of the rim are too short.
}

// The four edges of a square post whose long edges have a chamfer of 0.5 mm are those of the post.
TEST(CutEdgesTest, NarrowChamfersAreOneEdge) {
  Mesh post;
  constexpr float kHalf = 0.1F, kCut = 3.5e-4F;
  std::vector<Vec3f> outline;
  for (const auto& [x, y] : {std::pair(1.F, 1.F), {-1.F, 1.F}, {-1.F, -1.F}, {1.F, -1.F}}) {
    const Vec3f one(x * kHalf, y * (kHalf - kCut), 0), two(x * (kHalf - kCut), y * kHalf, 0);
    outline.push_back(x * y > 0 ? one : two);
    outline.push_back(x * y > 0 ? two : one);
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3f &a = outline[i], &b = outline[(i + 1) % outline.size()];
    add_rectangle(post, a, b, b + Vec3f::UnitZ(), a + Vec3f::UnitZ());
  }
  const auto edges = all_edges(scene_of({{post}}));
  EXPECT_EQ(std::ranges::count_if(edges, [](const auto& edge) { return std::abs(edge.exterior - 1.5) < 1e-4; }), 4);
  EXPECT_EQ(std::ranges::count_if(edges, [](const auto& edge) { return edge.exterior < 1.9; }), 4);
}

// A step of 0.5 mm in a plane has no edges: each half has its other three borders.
TEST(CutEdgesTest, LowStepsInAPlaneHaveNone) {
  Mesh step;
  constexpr float kHigh = 5e-4F;
  add_rectangle(step, {0, 0, 0}, {0.4F, 0, 0}, {0.4F, 0.3F, 0}, {0, 0.3F, 0});
  add_rectangle(step, {0.4F, 0, 0}, {0.4F, 0, kHigh}, {0.4F, 0.3F, kHigh}, {0.4F, 0.3F, 0});
  add_rectangle(step, {0.4F, 0, kHigh}, {0.8F, 0, kHigh}, {0.8F, 0.3F, kHigh}, {0.4F, 0.3F, kHigh});
  const auto edges = all_edges(scene_of({{step}}));
  EXPECT_EQ(edges.size(), 6U);
  EXPECT_NEAR(total_length(edges), 4 * 0.4 + 2 * 0.3, 1e-5);
}

// Each large face of a sheet is covered on the side on which the other lies, so that the nearer one glints.
TEST(CutEdgesTest, FacesOfASheetAreCoveredFromBehind) {
  const Scene scene = scene_of({{make_box({0.5, 0.3, 9e-4})}});
  LeftOut left_out;
  GlintingFaces faces = find_glinting_faces(scene, left_out, workers);
  const std::unique_ptr<TestEngine> engine = test_engine("cpu", 1);
  engine->set_scene(scene);
  cover_faces(scene, engine->engine(), faces);
  ASSERT_EQ(faces.groups.size(), 1U);
  const GlintingFaces::Group& group = faces.groups[0];
  ASSERT_EQ(group.face.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const float normal = group.first_x[i] * group.second_y[i] - group.first_y[i] * group.second_x[i];
    ASSERT_NEAR(std::abs(normal), 1, 1e-5);
    EXPECT_LT(static_cast<float>(group.covered[i]) * normal * group.middle_z[i], 0);
  }
}

}  // namespace
}  // namespace insonify::cut_edges_test
