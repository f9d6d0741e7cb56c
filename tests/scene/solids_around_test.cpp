// solids_around_test.cpp -- whether a point lies inside of an object.

#include <gmock/gmock.h>

#include "insonify/mesh.h"
#include "insonify/scene.h"

namespace insonify::solids_around_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Scene scene_of(Mesh mesh, const Pose& world_from_mesh = {}) {
  Scene scene;
  scene.instances.push_back(
      {.name = "thing", .mesh = std::make_shared<const Mesh>(std::move(mesh)), .world_from_mesh = world_from_mesh});
  return scene;
}

Mesh turned_inside_out(Mesh mesh) {
  for (auto& corners : mesh.triangles) {
    std::swap(corners[1], corners[2]);
  }
  return mesh;
}

TEST(SolidsAroundTest, AreThoseThatAPointLiesInsideOf) {
  const Scene scene =
      scene_of(make_box({2, 4, 1}), {.position = {10, 0, 0}, .orientation = orientation_from_rpy(0, 0, 0.5)});
  EXPECT_THAT(scene.solids_around({10, 0, 0}), ElementsAre(0));
  EXPECT_THAT(scene.solids_around({10, 0, 0.49}), ElementsAre(0));
  EXPECT_THAT(scene.solids_around({10, 0, 0.51}), IsEmpty());
  // Within the box around the turned box, outside of it.
  EXPECT_THAT(scene.solids_around({11.7, -0.9, 0}), IsEmpty());
  EXPECT_THAT(scene.solids_around(Vec3::Zero()), IsEmpty());
}

TEST(SolidsAroundTest, AreNotPoolsWhoseWallsFaceInwards) {
  EXPECT_THAT(scene_of(turned_inside_out(make_sphere(3, 0.2))).solids_around({1, 0, 0}), IsEmpty());
  EXPECT_THAT(scene_of(make_sphere(3, 0.2)).solids_around({1, 0, 0}), ElementsAre(0));
}

TEST(SolidsAroundTest, AreNotOpenVessels) {
  Mesh box = make_box({2, 2, 2});
  // The lid is missing.
  std::erase_if(box.triangles, [&](const auto& corners) {
    return std::ranges::all_of(corners, [&](auto corner) { return box.vertices[corner].z() > 0.99F; });
  });
  ASSERT_EQ(box.triangles.size(), 10U);
  EXPECT_THAT(scene_of(box).solids_around(Vec3::Zero()), IsEmpty());
}

TEST(SolidsAroundTest, AreNotRemovedOrEndlessObjects) {
  Scene scene = scene_of(make_sphere(3, 0.2));
  scene.instances[0].present = false;
  EXPECT_THAT(scene.solids_around({1, 0, 0}), IsEmpty());
  scene.instances[0].present = true;
  scene.instances[0].endless = true;
  EXPECT_THAT(scene.solids_around({1, 0, 0}), IsEmpty());
}

}  // namespace
}  // namespace insonify::solids_around_test
