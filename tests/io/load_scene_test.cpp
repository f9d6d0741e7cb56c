// load_scene_test.cpp -- the file extension determines how a world is read.

#include "io/sdf_files.h"

namespace insonify::load_scene_test {
namespace {

using LoadSceneTest = SdfTest;

TEST_F(LoadSceneTest, TakesAMeshFileForOneObjectNamedAfterIt) {
  const Scene scene = load_file(write("North.Reef.OBJ", "v 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n"));
  ASSERT_EQ(scene.instances.size(), 1);
  EXPECT_EQ(scene.instances[0].name, "North.Reef");
  EXPECT_EQ(scene.instances[0].user_material, "");
  EXPECT_THAT(world_bounds(scene.instances[0]).high, Near3(Vec3(1, 2, 3), kVertexError));
}

TEST_F(LoadSceneTest, TakesAHeightGridForASeabedAroundTheOrigin) {
  const Scene scene = load_file(
      write("bed.asc",
            "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 7000000\ncellsize 10\nNODATA_value -9999\n-4 0 4\n1 1 1\n"));
  ASSERT_EQ(scene.instances.size(), 1);
  EXPECT_EQ(scene.instances[0].name, "bed");
  EXPECT_THAT(world_bounds(scene.instances[0]).low, Near3(Vec3(-10, -5, -4), kVertexError));
}

TEST_F(LoadSceneTest, TakesSdfUnderEachOfItsEndings) {
  for (const char* name : {"a.sdf", "a.world", "a.xml", "a.SDF"}) {
    const Scene scene = load_file(write(name, sdf_of("<box><size>1 2 3</size></box>")));
    EXPECT_EQ(scene.instances.at(0).name, "ship::hull::plate") << name;
  }
}

TEST_F(LoadSceneTest, ReadsTheSceneOfAScenarioWithItsMaterials) {
  Scenario scenario;
  scenario.world = write("ship.sdf", R"(<sdf version="1.9"><model name="ship"><link name="hull">
<visual name="plate"><geometry><box><size>1 2 3</size></box></geometry></visual>
<collision name="shell"><geometry><box><size>1 2 3</size></box></geometry></collision></link></model></sdf>)");
  scenario.collisions = true;
  scenario.materials.overrides["shell"].like = "steel";
  const Scene scene = load_scene(scenario);
  ASSERT_EQ(scene.instances.size(), 1);
  ASSERT_EQ(scene.instances[0].materials.size(), 1);
  EXPECT_EQ(scene.materials.at(scene.instances[0].materials[0]).density, find_material("steel")->density);
}

TEST_F(LoadSceneTest, WithoutAWorldThereIsOpenWater) {
  const Scene scene = load_scene(Scenario());
  EXPECT_TRUE(scene.instances.empty());
}

TEST_F(LoadSceneTest, RefusesMeshesBeyondTheWorld) {
  EXPECT_EQ(error_of_file(write("far.obj", "v 0 0 0\nv 1e18 0 0\nv 0 2e18 3\nf 1 2 3\n")),
            "far.obj reaches x = 9.999999843e+17 m, must be from -10000000 to 10000000 m");
}

TEST_F(LoadSceneTest, RefusesOtherEndings) {
  EXPECT_EQ(error_of_file(write("wreck.blend", "?")),
            "wreck.blend: is not a world: SDF ends in .sdf, .world or .xml, a Stonefish scenario in .scn, a mesh in "
            ".obj, .stl, .dae, .ply, .gltf, .glb, "
            "heights in .png, .asc, .bag, .tif, .tiff");
}

}  // namespace
}  // namespace insonify::load_scene_test
