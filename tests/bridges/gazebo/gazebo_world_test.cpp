// gazebo_world_test.cpp -- the tree of entities that follows from Gazebo's messages.

#include "gazebo/gazebo_world.h"

#include <gmock/gmock.h>

#include "gazebo/gazebo_names.h"
#include "gazebo/gazebo_shapes.h"
#include "gazebo/world_stepper.h"

namespace insonify {
namespace {

using ignition::msgs::Geometry;

void set_position(ignition::msgs::Pose& pose, double x, double y, double yaw = 0) {
  const Eigen::Quaterniond turn = orientation_from_rpy(0, 0, yaw);
  pose.mutable_position()->set_x(x);
  pose.mutable_position()->set_y(y);
  pose.mutable_orientation()->set_z(turn.z());
  pose.mutable_orientation()->set_w(turn.w());
}

// boat 1 { hull 2 { plate 3 }, crane 10 { arm 11 { hook 12 } } }, each at x = 1 in its parent, the boat turned by 90
// deg.
ignition::msgs::Scene boat() {
  ignition::msgs::Scene scene;
  const auto fill = [](auto& entity, std::uint32_t id, const std::string& name) -> auto& {
    entity.set_id(id);
    entity.set_name(name);
    set_position(*entity.mutable_pose(), 1, 0);
    return entity;
  };
  auto& model = fill(*scene.add_model(), 1, "boat");
  set_position(*model.mutable_pose(), 1, 0, radians_from_degrees(90));
  fill(*fill(*model.add_link(), 2, "hull").add_visual(), 3, "plate").mutable_geometry()->set_type(Geometry::EMPTY);
  auto& crane = fill(*model.add_model(), 10, "crane");
  auto& hook = fill(*fill(*crane.add_link(), 11, "arm").add_visual(), 12, "hook");
  hook.mutable_geometry()->set_type(Geometry::SPHERE);
  hook.mutable_geometry()->mutable_sphere()->set_radius(0.3);
  return scene;
}

ignition::msgs::Pose_V poses(const std::vector<std::pair<std::uint32_t, double>>& xs) {
  ignition::msgs::Pose_V all;
  for (const auto& [id, x] : xs) {
    all.add_pose()->set_id(id);
    set_position(*all.mutable_pose(all.pose_size() - 1), x, 0);
  }
  return all;
}

TEST(GazeboWorldTest, NamesAndPosesAreComposedThroughNestedModels) {
  GazeboWorld world;
  world.set(boat());
  EXPECT_EQ(world.entities().at(12).name, "boat::crane::arm::hook");
  EXPECT_EQ(world.find("boat::crane::arm"), 11U);
  EXPECT_FALSE(world.find("boat::crane::arm::hook"));  // A visual carries nothing.
  // 1 to the boat, then three times 1 along its x, which is the world's y.
  EXPECT_LT((world.world_from(12).position - Vec3(1, 3, 0)).norm(), 1e-12);
}

TEST(GazeboWorldTest, PosesAreThoseInTheParentAndStayWhenTheSceneIsReadAgain) {
  GazeboWorld world;
  world.set(boat());
  world.take(poses({{11, 5}}), true);
  EXPECT_LT((world.world_from(12).position - Vec3(1, 7, 0)).norm(), 1e-12);  // 1 + 5 + 1.
  world.set(boat());
  EXPECT_LT((world.world_from(12).position - Vec3(1, 7, 0)).norm(), 1e-12);
  world.clear();
  world.set(boat());
  EXPECT_LT((world.world_from(12).position - Vec3(1, 3, 0)).norm(), 1e-12);
}

TEST(GazeboWorldTest, WhatIsInSomethingGoesWithIt) {
  GazeboWorld world;
  world.set(boat());
  world.remove(std::vector<GazeboWorld::Id>{10, 77});
  EXPECT_EQ(world.entities().size(), 3U);
  EXPECT_FALSE(world.find("boat::crane"));
  world.remove(std::vector<GazeboWorld::Id>{1});
  EXPECT_TRUE(world.entities().empty());
}

TEST(GazeboWorldTest, KnowsWhatMoves) {
  GazeboWorld world;
  ignition::msgs::Scene scene = boat();
  world.set(scene);
  EXPECT_TRUE(world.is_moving(3));  // Nothing says otherwise.
  world.take(poses({{10, 1}, {11, 1}}), true);
  EXPECT_FALSE(world.is_moving(3));
  EXPECT_TRUE(world.is_moving(12));
  scene.mutable_model(0)->set_is_static(true);
  world.set(scene);
  EXPECT_FALSE(world.is_moving(12));
}

TEST(GazeboWorldTest, NoticesWhatPosesAndSceneLack) {
  GazeboWorld world;
  world.set(boat());
  EXPECT_FALSE(world.is_outdated());
  world.take(poses({{1, 1}, {2, 1}, {3, 1}, {10, 1}, {11, 1}, {12, 1}}), false);
  EXPECT_FALSE(world.is_outdated());
  world.take(poses({{1, 1}, {2, 1}, {3, 1}, {10, 1}, {11, 1}, {12, 1}, {50, 1}}), false);
  EXPECT_TRUE(world.is_outdated());
  world.accept();  // As a light, which is no entity here.
  EXPECT_FALSE(world.is_outdated());
  world.take(poses({{1, 1}, {2, 1}, {3, 1}, {50, 1}}), false);
  EXPECT_TRUE(world.is_outdated());
}

TEST(GazeboWorldTest, EqualNamesAreToldApart) {
  GazeboWorld world;
  ignition::msgs::Scene scene = boat();
  *scene.add_model() = boat().model(0);
  scene.mutable_model(1)->set_id(101);
  scene.mutable_model(1)->mutable_link()->Clear();
  scene.mutable_model(1)->mutable_model()->Clear();
  world.set(scene);
  EXPECT_EQ(world.entities().at(101).name, "boat#101");
  EXPECT_EQ(world.model_names(), "boat, boat#101");
}

TEST(GazeboShapesTest, AreThoseOfSdf) {
  Geometry geometry;
  geometry.set_type(Geometry::PLANE);
  geometry.mutable_plane()->mutable_normal()->set_z(2);
  geometry.mutable_plane()->mutable_size()->set_x(3);
  geometry.mutable_plane()->mutable_size()->set_y(4);
  const Shape plane = std::get<Shape>(shape_of(geometry));
  EXPECT_EQ(plane.kind, ShapeKind::kPlane);
  EXPECT_EQ(plane.normal, Vec3::UnitZ());
  EXPECT_EQ(plane.size->head<2>(), Eigen::Vector2d(3, 4));
  geometry.set_type(Geometry::MESH);
  geometry.mutable_mesh()->set_filename("model://ship/hull.dae");
  geometry.mutable_mesh()->set_submesh("keel");
  const Shape mesh = std::get<Shape>(shape_of(geometry));
  EXPECT_EQ(mesh.uri, "model://ship/hull.dae");
  EXPECT_EQ(mesh.submesh, "keel");
  EXPECT_EQ(mesh.scale, Vec3::Ones());
  geometry.set_type(Geometry::HEIGHTMAP);
  EXPECT_EQ(std::get<std::string>(shape_of(geometry)), "Gazebo does not publish the file of its heightmap");
  geometry.set_type(Geometry::POLYLINE);
  EXPECT_EQ(std::get<std::string>(shape_of(geometry)), "insonify has no shape POLYLINE");
}

TEST(GazeboNamesTest, AreThoseOfBothGenerations) {
  EXPECT_EQ(ignition_type_name("gz.msgs.Pose_V"), "ignition.msgs.Pose_V");
  EXPECT_EQ(world_of_service("/world/tank/scene/info"), "tank");
  EXPECT_FALSE(world_of_service("/world/tank/scene/graph"));
  EXPECT_FALSE(world_of_service("/world//scene/info"));
}

// Steps of 4 ms; the first poses after the pause are 3 steps late, so that the first difference is none of a step.
TEST(WorldStepperTest, MeasuresTheStepAndThenGoesToTheNextPing) {
  WorldStepper stepper;
  const WorldStepper::Clock::time_point now;
  EXPECT_EQ(stepper.steps(2, {}, now), 0U);  // Pings are made.
  EXPECT_EQ(stepper.steps(2, 2.05, now), 1U);
  EXPECT_EQ(stepper.steps(2, 2.05, now), 0U);  // Its poses have not come.
  EXPECT_EQ(stepper.steps(2.012, 2.05, now), 1U);
  EXPECT_EQ(stepper.steps(2.016, 2.05, now), 1U);
  EXPECT_EQ(stepper.steps(2.020, 2.05, now), 8U);  // 30 ms are 7.5 steps.
  EXPECT_EQ(stepper.steps(2.048, 2.05, now), 0U);
  EXPECT_EQ(stepper.steps(2.052, {}, now), 0U);
  EXPECT_EQ(stepper.steps(2.052, 2.1, now), 12U);
  EXPECT_EQ(stepper.steps(2.1, 2.1001, now), 1U);
}

TEST(WorldStepperTest, AsksAgainForLostPosesAndAfterAReset) {
  WorldStepper stepper;
  WorldStepper::Clock::time_point now;
  EXPECT_EQ(stepper.steps(7, 7.5, now), 1U);
  now += std::chrono::seconds(1);
  EXPECT_EQ(stepper.steps(7, 7.5, now), 0U);
  now += std::chrono::seconds(2);
  EXPECT_EQ(stepper.steps(7, 7.5, now), 1U);
  EXPECT_EQ(stepper.steps(0.25, 0.25, now), 1U);  // Time was set back.
}

}  // namespace
}  // namespace insonify
