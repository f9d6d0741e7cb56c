// scene_test.cpp -- triangle counts, bounds and look-up of instances.

#include "insonify/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insonify::scene_test {
namespace {

constexpr double kFloatRounding = 1e-6;  // Vertices are floats; the coordinates here are below 10 m.

Mesh triangle() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 3, 1}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Instance instance(std::string name, Mesh mesh = triangle(), Pose pose = {}) {
  return {.name = std::move(name), .mesh = std::make_shared<Mesh>(std::move(mesh)), .world_from_mesh = pose};
}

Scene scene_of(std::initializer_list<const char*> names) {
  Scene scene;
  for (const char* name : names) {
    scene.instances.push_back(instance(name));
  }
  return scene;
}

TEST(SceneTest, CountsTheTrianglesOfEveryInstance) {
  Mesh two = triangle();
  two.triangles.push_back({2, 1, 0});
  Scene scene;
  scene.instances = {instance("a", two), instance("b", two), instance("c")};
  EXPECT_EQ(scene.triangle_count(), 5U);
}

// Turned by +90 degrees about z, (2, 0, 0) goes to (0, 2, 0) and (0, 3, 1) to (-3, 0, 1); then all move by (5, 6, 7).
TEST(SceneTest, BoundsHoldWhatIsInstancedWhereItIs) {
  Scene scene;
  scene.instances = {
      instance("turned", triangle(), {{5, 6, 7}, orientation_from_rpy(0, 0, radians_from_degrees(90))}),
      instance("low", triangle(), {{4, 6, -1}, Eigen::Quaterniond::Identity()}),
  };
  const Box3 box = scene.bounds();
  EXPECT_LE((box.low - Vec3(2, 6, -1)).norm(), kFloatRounding);
  EXPECT_LE((box.high - Vec3(6, 9, 8)).norm(), kFloatRounding);
}

TEST(SceneTest, BoundsLeaveOutCornersOfNoTriangle) {
  Mesh mesh = triangle();
  mesh.vertices.push_back({NAN, 100, 100});
  Scene scene;
  scene.instances = {instance("stray", mesh)};
  EXPECT_LE((scene.bounds().high - Vec3(2, 3, 1)).norm(), kFloatRounding);
}

// Of instances that share a mesh, the third sticks out by a corner, the others do not.
TEST(SceneTest, BoundsHoldAllInstancesOfOneMesh) {
  Scene scene;
  scene.instances = {instance("large", triangle(), {{0, 0, 0}, Eigen::Quaterniond::Identity()}),
                     instance("far", triangle(), {{5, 5, 5}, Eigen::Quaterniond::Identity()})};
  const auto add = [&](const Vec3& position, double yaw) {
    scene.instances.push_back(scene.instances[0]);
    scene.instances.back().world_from_mesh = {position, orientation_from_rpy(0, 0, yaw)};
  };
  add({2, 2, 2}, 0.1);
  EXPECT_LE((scene.bounds().high - Vec3(7, 8, 6)).norm(), kFloatRounding);
  add({5.5, 1, 1}, 0);
  EXPECT_LE((scene.bounds().high - Vec3(7.5, 8, 6)).norm(), kFloatRounding);
  EXPECT_LE(scene.bounds().low.norm(), kFloatRounding);
}

TEST(SceneTest, AnEmptySceneHasEmptyBounds) {
  const Box3 box = Scene{}.bounds();
  EXPECT_GT(box.low.x(), box.high.x());
  EXPECT_EQ(Scene{}.triangle_count(), 0U);
}

TEST(FindInstanceTest, FindsTheWholeName) {
  EXPECT_EQ(scene_of({"ship::hull::visual", "ship::mast::visual"}).find_instance("ship::mast::visual"), 1);
}

TEST(FindInstanceTest, FindsTheOnlyOneInsideAName) {
  const Scene scene = scene_of({"ship::hull::visual", "ship::mast::visual", "rock::link::visual"});
  EXPECT_EQ(scene.find_instance("rock"), 2);
  EXPECT_EQ(scene.find_instance("rock::link"), 2);
  EXPECT_EQ(scene.find_instance("ship::mast"), 1);
}

TEST(FindInstanceTest, FindsNoneWhereSeveralMatch) {
  EXPECT_EQ(scene_of({"ship::a", "ship::b"}).find_instance("ship"), -1);
  EXPECT_EQ(scene_of({"ship::a", "ship::b", "ship::c"}).find_instance("ship"), -1);
}

TEST(FindInstanceTest, AWholeNameGoesBeforeThoseInsideIt) {
  EXPECT_EQ(scene_of({"ship::a", "ship::b", "ship"}).find_instance("ship"), 2);
}

TEST(FindInstanceTest, FindsNoPartsOfWords) {
  const Scene scene = scene_of({"ship::hull"});
  EXPECT_EQ(scene.find_instance("shi"), -1);
  EXPECT_EQ(scene.find_instance("hull"), -1);
  EXPECT_EQ(scene.find_instance(""), -1);
}

}  // namespace
}  // namespace insonify::scene_test
