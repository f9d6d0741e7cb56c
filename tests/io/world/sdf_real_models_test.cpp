// sdf_real_models_test.cpp -- third-party models, loaded through SDF files.

#include "io/sdf_files.h"

namespace insonify::sdf_real_models_test {
namespace {

// Extents are the coordinates in the files times the matrix of their node, to four digits.
constexpr double kExtentError = 1e-3;

struct RealModel {
  const char* name;
  const char* file;
  Vec3 extent;  // Along x, y, z [m]
};

class SdfRealModelsTest : public SdfTest, public testing::WithParamInterface<RealModel> {};

// Rotated a quarter turn about z, shifted and scaled by 2: x and y are exchanged.
TEST_P(SdfRealModelsTest, StandsWhereItIsPutInItsRealSize) {
  INSONIFY_REAL_DATA(file, GetParam().file);
  const std::filesystem::path list = file.parent_path().parent_path();
  setenv("GZ_SIM_RESOURCE_PATH", list.c_str(), 1);
  const Scene scene = load(fmt::format(R"(<sdf version="1.6"><world name="sea"><model name="thing"><static>true</static>
<pose>1000 -2000 -30 0 0 1.5707963267948966</pose><link name="l"><visual name="v"><geometry><mesh>
<uri>model://{}</uri><scale>2 2 2</scale></mesh></geometry></visual></link></model></world></sdf>)",
                                       std::filesystem::relative(file, list).string()));
  unsetenv("GZ_SIM_RESOURCE_PATH");
  ASSERT_EQ(scene.instances.size(), 1);
  EXPECT_THAT(scene.instances[0].world_from_mesh.position, Near3(Vec3(1000, -2000, -30), kPoseError));
  const Box3 box = world_bounds(scene.instances[0]);
  const Vec3 extent = (box.high - box.low) / 2;
  const Vec3& expected = GetParam().extent;
  EXPECT_NEAR(extent.y(), expected.x(), kExtentError * expected.x());
  EXPECT_NEAR(extent.x(), expected.y(), kExtentError * expected.y());
  EXPECT_NEAR(extent.z(), expected.z(), kExtentError * expected.z());
}

INSTANTIATE_TEST_SUITE_P(
    , SdfRealModelsTest,
    testing::Values(RealModel{"Wreck", "models_smarc/skytteren__skytteren_repaired.dae", {175.7, 42.02, 36.00}},
                    RealModel{"Rock", "models_smarc/large_rock__large_rock_collision.stl", {2.472, 1.940, 1.773}},
                    RealModel{
                        "BlowOutPreventer", "models_uuv_simulator/rov_bop_panel__BOP_Panel.dae", {0.5, 0.8, 0.36}},
                    RealModel{"ObservatoryNode", "models_dave/mbari_mars__mbari_mars.dae", {7.204, 6.004, 1.603}},
                    RealModel{"Bomb", "models_dave/uxo_b__uxo_b.dae", {1.79, 0.4643, 0.458}}),
    [](const auto& model) { return model.param.name; });

using SdfRealGridsTest = SdfTest;

TEST_F(SdfRealGridsTest, AreHeightmaps) {
  INSONIFY_REAL_DATA(file, "bathymetry_bag/JD211_public_Release_1-4_UTM.bag");
  setenv("INSONIFY_MODEL_PATH", file.parent_path().c_str(), 1);
  const Scene scene = load(sdf_of(fmt::format("<heightmap><uri>file://{}</uri></heightmap>", file.string())));
  unsetenv("INSONIFY_MODEL_PATH");
  EXPECT_GT(scene.instances.at(0).mesh->triangles.size(), 1000);
}

}  // namespace
}  // namespace insonify::sdf_real_models_test
