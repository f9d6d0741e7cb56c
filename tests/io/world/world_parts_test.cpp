// world_parts_test.cpp -- scenes of shapes that another program describes.

#include "insonify/world_parts.h"

#include <gmock/gmock.h>

#include "support/working_folder.h"

namespace insonify::world_parts_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class WorldPartsTest : public testing::Test {
 protected:
  Scene scene_of(const std::vector<WorldPart>& parts, const WorldOptions& options = {}) {
    WorldParts maker("base.yaml", options, [this](Severity severity, const std::string& text) {
      if (severity == Severity::kWarning) {
        warnings_.push_back(text);
      }
    });
    return maker.scene(parts, "the world tank");
  }

  WorkingFolder folder_;
  std::vector<std::string> warnings_;
};

Box3 box_of(const Scene& scene) {
  return scene.bounds();
}

TEST_F(WorldPartsTest, ShapesHaveTheirSizesAndPlaces) {
  const Pose turned{Vec3(10, 0, 0), orientation_from_rpy(0, 0, radians_from_degrees(90))};
  const Scene box = scene_of({{.name = "a", .shape = {.size = Vec3(1, 2, 4)}, .world_from_part = turned}});
  EXPECT_LT((box_of(box).low - Vec3(9, -0.5, -2)).norm(), 1e-6);
  EXPECT_LT((box_of(box).high - Vec3(11, 0.5, 2)).norm(), 1e-6);
  const Scene cone =
      scene_of({{.name = "a", .shape = {.kind = ShapeKind::kCone, .radius = 0.5, .length = 3}, .world_from_part = {}}});
  EXPECT_NEAR(box_of(cone).high.z(), 1.5, 1e-6);
  const Scene plane =
      scene_of({{.name = "a", .shape = {.kind = ShapeKind::kPlane, .size = Vec3(6, 8, 1)}, .world_from_part = {}}});
  EXPECT_LT((box_of(plane).high - Vec3(3, 4, 0)).norm(), 1e-6);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(WorldPartsTest, PartsKeepTheirMarksAndEqualShapesShareAMesh) {
  const Shape shape{.size = Vec3(1, 1, 1)};
  const Scene scene =
      scene_of({{.name = "m::l::a", .shape = shape, .world_from_part = {}, .moving = true, .material = "steel"},
                {.name = "m::l::b", .shape = shape, .world_from_part = {}}});
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_TRUE(scene.instances[0].moving);
  EXPECT_EQ(scene.instances[0].user_material, "steel");
  EXPECT_FALSE(scene.instances[1].moving);
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh);
}

TEST_F(WorldPartsTest, MeshesAreFoundAsInSdfAndScaled) {
  folder_.write("models/dock/wall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene =
      scene_of({{.name = "a",
                 .shape = {.kind = ShapeKind::kMesh, .uri = "model://dock/wall.obj", .scale = Vec3(2, 3, 1)},
                 .world_from_part = {}}});
  EXPECT_LT((box_of(scene).high - Vec3(2, 3, 0)).norm(), 1e-6);
}

TEST_F(WorldPartsTest, WhatCannotBeMadeIsLeftOutWithOneWarning) {
  const Scene scene = scene_of(
      {{.name = "a", .shape = {.kind = ShapeKind::kMesh, .uri = "file:///gone.dae"}, .world_from_part = {}},
       {.name = "b", .shape = {.kind = ShapeKind::kSphere, .radius = -1}, .world_from_part = {}},
       {.name = "c", .shape = {.kind = ShapeKind::kSphere, .radius = 1}, .world_from_part = {}},
       {.name = "d", .shape = {.kind = ShapeKind::kSphere, .radius = 1}, .world_from_part = {Vec3(1e9, 0, 0)}}});
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.instances[0].name, "c");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_THAT(warnings_[0],
              HasSubstr("the world tank: 3 parts of the world are skipped (an error with strict: true): visual 'a': "
                        "'file:///gone.dae' does not exist; "));
  EXPECT_THAT(warnings_[0], HasSubstr("visual 'b': <radius> = -1 m must be greater than 0 m"));
  EXPECT_THAT(warnings_[0], HasSubstr("visual 'd' reaches x = 1000000000 m"));
  EXPECT_THROW(
      (void)scene_of({{.name = "b", .shape = {.kind = ShapeKind::kSphere}, .world_from_part = {}}}, {.strict = true}),
      Error);
}

TEST_F(WorldPartsTest, PatternsLeaveOutModelsLinksAndVisuals) {
  const Shape shape{.size = Vec3(1, 1, 1)};
  const std::vector<WorldPart> parts = {{.name = "sea::l::v", .shape = shape, .world_from_part = {}},
                                        {.name = "rov::arm::v", .shape = shape, .world_from_part = {}},
                                        {.name = "rov::hull::sticker", .shape = shape, .world_from_part = {}},
                                        {.name = "rov::hull::plate", .shape = shape, .world_from_part = {}}};
  WorldParts maker("base.yaml", {.ignore = {"sea", "arm", "stick*", "unused"}},
                   [this](Severity, const std::string& text) { warnings_.push_back(text); });
  const Scene scene = maker.scene(parts, "the world tank");
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.instances[0].name, "rov::hull::plate");
  maker.report_unused_patterns("the world tank");
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("unused")));
}

TEST_F(WorldPartsTest, EqualNamesAreAnError) {
  const Shape shape{.size = Vec3(1, 1, 1)};
  try {
    (void)scene_of(
        {{.name = "a", .shape = shape, .world_from_part = {}}, {.name = "a", .shape = shape, .world_from_part = {}}});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "visual 'a' has the name of another one");
  }
}

}  // namespace
}  // namespace insonify::world_parts_test
