// mirror_tree_test.cpp -- what a tree of triangles finds, against all triangles, and how many boxes it looks at.

#include "echo/targets/mirror_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace insonify::mirror_tree_test {
namespace {

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
  const MirrorTree tree(random_mirrors(200), 1e-5, 0.01);
  ASSERT_EQ(tree.items().size(), 2000U);
  for (const MirrorTree::Item& own : tree.items()) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> found, expected;
    tree.visit([&](const MirrorBox& box) { return box.meets(own.box); },
               [&](const MirrorTree::Item& item) { found.emplace(item.mirror, item.triangle); });
    for (const MirrorTree::Item& item : tree.items()) {
      if (item.box.meets(own.box)) {
        expected.emplace(item.mirror, item.triangle);
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
  const MirrorTree tree(mirrors, kMargin, kReach);
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

// The number of boxes per search grows with the logarithm of the number of triangles.
TEST(MirrorTreeTest, ASearchLooksAtFewBoxes) {
  const auto boxes_per_search = [](int mirrors) {
    const MirrorTree tree(random_mirrors(mirrors), 1e-5, 0.01);
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
