// mirror_tree_test.cpp -- what a tree of triangles finds, against all triangles, and how many boxes it looks at.

#include "echo/targets/mirror_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <type_traits>

namespace insonify::mirror_tree_test {
namespace {

Workers workers(2);

// Mirrors of ten triangles of about 1 m each, as dense everywhere.
std::vector<PlaneMirror> random_mirrors(int count) {
  std::mt19937 random(5);
  const double size = std::cbrt(count) * 3;
  std::uniform_real_distribution<double> anywhere(-size, size), near(-1, 1);
  std::vector<PlaneMirror> mirrors(count);
  for (PlaneMirror& mirror : mirrors) {
    for (int i = 0; i < 10; ++i) {
      const Vec3 middle(anywhere(random), anywhere(random), anywhere(random));
      PlaneMirror::Triangle& triangle = mirror.triangles.emplace_back();
      for (Vec3& corner : triangle.corners) {
        corner = middle + Vec3(near(random), near(random), near(random));
      }
    }
  }
  return mirrors;
}

TEST(MirrorTreeTest, FindsAllThatMeetABox) {
  const MirrorTree tree(random_mirrors(200), 1e-5, 0.01, workers);
  ASSERT_EQ(tree.items().size(), 2000U);
  for (const MirrorTree::Item& own : tree.items()) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> found, expected;
    tree.visit([&](const MirrorBox& box) { return box.meets(own.box); },
               [&](const MirrorTree::Item& item) { found.emplace(item.box.mirror, item.triangle); });
    for (const MirrorTree::Item& item : tree.items()) {
      if (item.box.meets(own.box)) {
        expected.emplace(item.box.mirror, item.triangle);
      }
    }
    ASSERT_EQ(found, expected);
  }
}

// Boxes hold their triangles, enlarged on each side: a point out of the box is not contained.
TEST(MirrorTreeTest, BoxesHoldTheEnlargedTriangles) {
  constexpr double kMargin = 0.02, kReach = 0.001;
  std::vector<PlaneMirror> mirrors(1);
  mirrors[0].normal = Vec3::UnitZ();
  mirrors[0].triangles = {{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 0.1, 0)}, 0, true}};  // A thin one.
  const MirrorTree tree(mirrors, kMargin, kReach, workers);
  const MirrorBox box = tree.items()[0].box;
  int contained = 0;
  for (double x = -3; x < 5; x += 0.01) {
    for (double y = -1; y < 1; y += 0.01) {
      if (mirrors[0].contains(mirrors[0].triangles[0], {x, y, 0}, kMargin)) {
        ++contained;
        const Vec3f place = Vec3(x, y, 0).cast<float>();
        ASSERT_TRUE(box.meets({place, place})) << x << " " << y;
      }
    }
  }
  EXPECT_GT(contained, 1000);
}

// A search for perpendicular mirrors leaves out groups, but none of them.
TEST(MirrorTreeTest, GroupsKnowWhatMayBePerpendicular) {
  constexpr double kMost = 0.01;
  std::vector<PlaneMirror> mirrors = random_mirrors(2000);
  std::mt19937 random(6);
  std::normal_distribution<double> component;
  for (PlaneMirror& mirror : mirrors) {
    mirror.normal = Vec3(component(random), 3, component(random)).normalized();
  }
  const MirrorTree tree(mirrors, 1e-5, 0.01, workers);
  std::size_t left_out = 0;
  for (const Vec3& unit : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
    std::set<std::uint32_t> found, expected;
    tree.visit(
        [&]<typename Box>(const Box& box) {
          if constexpr (std::is_same_v<Box, MirrorGroup>) {
            const bool may_be = box.may_be_perpendicular(unit, kMost);
            left_out += may_be ? 0 : 1;
            return may_be;
          }
          return true;
        },
        [&](const MirrorTree::Item& item) { found.insert(item.box.mirror); });
    for (std::uint32_t i = 0; i < mirrors.size(); ++i) {
      if (std::abs(mirrors[i].normal.dot(unit)) <= kMost) {
        expected.insert(i);
      }
    }
    EXPECT_TRUE(std::ranges::includes(found, expected));
    EXPECT_EQ(expected.empty(), unit.y() == 1);
  }
  EXPECT_GT(left_out, 100U);
}

TEST(MirrorTreeTest, IsTheSameForAnyNumberOfThreads) {
  const std::vector<PlaneMirror> mirrors = random_mirrors(5000);
  Workers one(1);
  const MirrorTree by_one(mirrors, 1e-5, 0.01, one), by_two(mirrors, 1e-5, 0.01, workers);
  ASSERT_EQ(by_one.items().size(), 50'000U);
  for (std::size_t i = 0; i < by_one.items().size(); ++i) {
    EXPECT_EQ(by_one.items()[i].box.mirror, by_two.items()[i].box.mirror);
    EXPECT_EQ(by_one.items()[i].triangle, by_two.items()[i].triangle);
  }
}

// The number of boxes per search grows with the logarithm of the number of triangles.
TEST(MirrorTreeTest, ASearchLooksAtFewBoxes) {
  const auto boxes_per_search = [](int mirrors) {
    const MirrorTree tree(random_mirrors(mirrors), 1e-5, 0.01, workers);
    std::size_t boxes = 0;
    for (const MirrorTree::Item& own : tree.items()) {
      tree.visit(
          [&](const MirrorBox& box) {
            ++boxes;
            return box.meets(own.box);
          },
          [](const MirrorTree::Item&) {});
    }
    return static_cast<double>(boxes) / static_cast<double>(tree.items().size());
  };
  const double few = boxes_per_search(100), many = boxes_per_search(3200);
  EXPECT_LT(many, 1.8 * few);  // log(32 000) / log(1000) = 1.5.
}

}  // namespace
}  // namespace insonify::mirror_tree_test
