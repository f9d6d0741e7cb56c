// same_places_test.cpp -- corners that are one place, against all pairs of them; triangles that are given twice.

#include "scene/same_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "insonify/mesh.h"

namespace insonify::same_places_test {
namespace {

// Points of a lattice of 1 mm, moved by up to 4e-6 m, each several times.
TEST(SamePlacesTest, MovedCornersAreTheFirstAtTheirPlace) {
  std::mt19937 random(7);
  std::vector<Vec3f> places, lattice;
  for (int i = 0; i < 4000; ++i) {
    const auto near = [&] { return 1e-3F * static_cast<float>(random() % 7) - 3e-3F; };
    lattice.emplace_back(near(), near(), near());
    const auto off = [&] { return 4e-6F * (static_cast<float>(random() % 2001) / 1000 - 1); };
    places.push_back(lattice.back() + Vec3f(off(), off(), off()));
  }
  for (const int threads : {1, 4}) {
    Workers workers(threads);
    const std::vector<std::uint32_t> numbers = same_places(places, kSamePlace, {}, workers);
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::size_t first = 0;
      while (lattice[first] != lattice[i]) {
        ++first;
      }
      ASSERT_EQ(numbers[i], first);
    }
  }
}

TEST(SamePlacesTest, ToleranceIsThatOfFloatsFarAway) {
  const std::vector<Vec3f> near = {{1, 2, 3}}, far = {{1, -2000, 3}};
  EXPECT_EQ(same_place_tolerance(near), 5e-5F);
  EXPECT_FLOAT_EQ(same_place_tolerance(far), 2000 * 2.384186e-7F);  // 2^-22: floats are 2^-13 apart there.
}

// Three in a row, each within the tolerance of the next: the third is not at the place of the first.
TEST(SamePlacesTest, ChainsDoNotCreep) {
  Workers workers(1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vec3f> places = {{0, 0, 0}, {4e-5F, 0, 0}, {8e-5F, 0, 0}, {nan, 0, 0}, {nan, 0, 0}, {-0.0F, 0, 0}};
  EXPECT_EQ(same_places(places, kSamePlace, {}, workers), (std::vector<std::uint32_t>{0, 0, 2, 3, 4, 0}));
  EXPECT_EQ(same_places(places, kSamePlace, {1, 3e-5F, 1, 1, 1, 1}, workers),
            (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 0}));
}

TEST(SamePlacesTest, TrianglesGivenTwiceAreKnownInAnyOrder) {
  Workers workers(2);
  Mesh mesh = make_box({1, 2, 3});
  EXPECT_TRUE(repeated_triangles(mesh, workers).empty());
  const std::size_t count = mesh.triangles.size();
  const auto [a, b, c] = mesh.triangles[5];
  mesh.vertices.push_back(Vec3f(mesh.vertices[b]));
  mesh.triangles.push_back({c, static_cast<std::uint32_t>(mesh.vertices.size() - 1), a});
  mesh.triangles.push_back({a, a, b});  // As many corners in common, but another triangle.
  const std::vector<std::uint32_t> first = repeated_triangles(mesh, workers);
  ASSERT_EQ(first.size(), count + 2);
  for (std::uint32_t i = 0; i < count; ++i) {
    EXPECT_EQ(first[i], i);
  }
  EXPECT_EQ(first[count], 5U);
  EXPECT_EQ(first[count + 1], count + 1);
}

}  // namespace
}  // namespace insonify::same_places_test
