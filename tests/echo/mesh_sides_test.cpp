// mesh_sides_test.cpp -- welded vertices and shared sides of random triangles, against all pairs of them.

#include "echo/mirror/mesh_sides.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace insonify::mesh_sides_test {
namespace {

// Triangles between the places of a small lattice, each of which is listed many times; -0 is the same as 0.
Mesh random_mesh(int vertices, int triangles) {
  std::mt19937 random(11);
  Mesh mesh;
  for (int i = 0; i < vertices; ++i) {
    const auto place = [&] { return static_cast<float>(random() % 5) - 2; };
    mesh.vertices.emplace_back(place(), place(), random() % 2 == 0 ? 0.0F : -0.0F);
  }
  for (int i = 0; i < triangles; ++i) {
    const auto vertex = [&] { return static_cast<std::uint32_t>(random() % mesh.vertices.size()); };
    mesh.triangles.push_back({vertex(), vertex(), vertex()});
  }
  return mesh;
}

TEST(MeshSidesTest, NumbersAreTheFirstVerticesAtEachPlace) {
  const Mesh mesh = random_mesh(700, 1);
  for (const int threads : {1, 4}) {
    Workers workers(threads);
    const std::vector<std::uint32_t> numbers = welded_vertices(mesh, workers);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      std::size_t first = 0;
      while (mesh.vertices[first] != mesh.vertices[i]) {
        ++first;
      }
      ASSERT_EQ(numbers[i], first);
    }
  }
}

// A square of two triangles beside three of a third of its height each, the corners of which are 2e-5 m off its side.
TEST(MeshSidesTest, CornersOfOthersDivideASide) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}, {0, 3, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const float y : {1.F, 2.F}) {
    mesh.vertices.emplace_back(1, y, 2e-5F);
  }
  mesh.triangles.push_back({1, 4, 5});
  mesh.triangles.push_back({5, 4, 6});
  mesh.triangles.push_back({6, 4, 2});
  Workers workers(2);
  const MeshSides sides(mesh, workers);
  EXPECT_EQ(sides.count(), 15U + 3U);
  std::map<MeshSides::Ends, std::vector<std::uint32_t>> triangles;
  sides.for_each_edge(0, sides.vertex_count(), [&](std::span<const std::uint32_t> together) {
    for (const std::uint32_t side : together) {
      triangles[sides.ends(side)].push_back(sides.triangle(side));
      EXPECT_EQ(sides.ends(side).low == sides.opposite(side) || sides.ends(side).high == sides.opposite(side), false);
    }
  });
  EXPECT_FALSE(triangles.contains({1, 2}));
  EXPECT_EQ((triangles[{1, 5}]), (std::vector<std::uint32_t>{2, 0}));
  EXPECT_EQ((triangles[{5, 6}]), (std::vector<std::uint32_t>{3, 0}));
  EXPECT_EQ((triangles[{2, 6}]), (std::vector<std::uint32_t>{4, 0}));
  EXPECT_TRUE(sides.runs_upwards(15));  // From corner 1 to 5, as the side of the first triangle runs.
}

TEST(MeshSidesTest, SidesWithTheSameEndsAreTogetherAndInOrder) {
  const Mesh mesh = random_mesh(400, 20'000);
  for (const int threads : {1, 4}) {
    Workers workers(threads);
    const MeshSides sides(mesh, workers);
    ASSERT_EQ(sides.count(), 3 * mesh.triangles.size());  // None has corners of others on it.
    std::map<MeshSides::Ends, std::vector<std::uint32_t>> expected;
    for (std::uint32_t side = 0; side < 3 * mesh.triangles.size(); ++side) {
      if (const MeshSides::Ends ends = sides.ends(side); ends.low != ends.high) {
        expected[ends].push_back(side);
      }
    }
    auto next = expected.begin();
    sides.for_each_edge(0, sides.vertex_count(), [&](std::span<const std::uint32_t> together) {
      ASSERT_NE(next, expected.end());
      EXPECT_EQ(std::vector(together.begin(), together.end()), next->second);
      ++next;
    });
    EXPECT_EQ(next, expected.end());
  }
}

}  // namespace
}  // namespace insonify::mesh_sides_test
