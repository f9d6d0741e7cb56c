// sdf_material_test.cpp -- acoustic materials written into SDF files.

#include "io/sdf_files.h"

namespace insonify::sdf_material_test {
namespace {

constexpr const char* kBox = "<box><size>1 2 3</size></box>";

using SdfMaterialTest = SdfTest;

TEST_F(SdfMaterialTest, ReadsTheNamespacedElementOfAVisual) {
  EXPECT_EQ(load(sdf_of(kBox, "<insonify:material>\n steel </insonify:material>")).instances.at(0).user_material,
            "steel");
}

TEST_F(SdfMaterialTest, ReadsThePluginOfAVisual) {
  const char* plugin = "<plugin name='insonify' filename='none'><material>mud</material></plugin>";
  EXPECT_EQ(load(sdf_of(kBox, plugin)).instances.at(0).user_material, "mud");
}

TEST_F(SdfMaterialTest, LeavesOtherPluginsAlone) {
  const char* plugin = "<plugin name='paint' filename='none'><material>mud</material><colour>red</colour></plugin>";
  EXPECT_EQ(load(sdf_of(kBox, plugin)).instances.at(0).user_material, "");
}

TEST_F(SdfMaterialTest, ReadsBothFormsOnCollisions) {
  const std::string text =
      R"(<sdf version="1.9" xmlns:insonify="https://insonify.org/sdf"><model name="ship"><link name="l">
<collision name="a"><geometry><box><size>1 2 3</size></box></geometry><insonify:material>rock</insonify:material></collision>
<collision name="b"><geometry><box><size>1 2 3</size></box></geometry>
<plugin name="insonify" filename="none"><material>sand</material></plugin></collision></link></model></sdf>)";
  const Scene scene = load(text, true);
  EXPECT_EQ(scene.instances.at(0).user_material, "rock");
  EXPECT_EQ(scene.instances.at(1).user_material, "sand");
  EXPECT_TRUE(said.empty());
}

TEST_F(SdfMaterialTest, HandsLinksAndModelsDownToPartsWithoutTheirOwn) {
  const std::string part = "<visual name='{}'><geometry><box><size>1 2 3</size></box></geometry>{}</visual>";
  const std::string own = "<insonify:material>rubber</insonify:material>";
  const Scene scene = load(
      "<sdf version='1.6' xmlns:insonify='https://insonify.org/sdf'><model name='m'>"
      "<insonify:material>steel</insonify:material><link name='a'>" +
      fmt::format(fmt::runtime(part), "plain", "") + fmt::format(fmt::runtime(part), "own", own) +
      "</link><link name='b'><insonify:material>wood</insonify:material>" +
      fmt::format(fmt::runtime(part), "plain", "") + "</link></model></sdf>");
  ASSERT_EQ(scene.instances.size(), 3);
  EXPECT_EQ(scene.instances[0].user_material, "steel");
  EXPECT_EQ(scene.instances[1].user_material, "rubber");
  EXPECT_EQ(scene.instances[2].user_material, "wood");
}

TEST_F(SdfMaterialTest, GivesAnIncludedModelTheMaterialOfItsInclude) {
  write("part.sdf", sdf_of(kBox));
  const Scene scene = load(R"(<sdf version="1.9"><world name="w"><include><uri>part.sdf</uri>
<plugin name="insonify" filename="none"><material>pvc</material></plugin></include></world></sdf>)");
  EXPECT_EQ(scene.instances.at(0).user_material, "pvc");
}

TEST_F(SdfMaterialTest, NamesThePlaceOfAMaterialThatDoesNotExist) {
  Scene scene = load(sdf_of(kBox, "<insonify:material>unobtainium</insonify:material>"));
  EXPECT_EQ(scene.places.at(scene.instances.at(0).name).line, 4);
  const std::string message = without_folder(message_of([&] { assign_materials(scene, {}); }));
  EXPECT_THAT(message, testing::StartsWith("scene.sdf:4:1: "));
  EXPECT_THAT(message, testing::HasSubstr("unobtainium"));
}

TEST_F(SdfMaterialTest, RefusesWhatItDoesNotKnow) {
  const std::string where = "scene.sdf:4:1: visual 'ship::hull::plate'";
  EXPECT_EQ(error_of(sdf_of(kBox, "<insonify:materail>steel</insonify:materail>")),
            where + ": <insonify:materail> is unknown, insonify knows <material>");
  EXPECT_EQ(error_of(sdf_of(kBox, "<plugin name='insonify' filename='x'><colour>red</colour></plugin>")),
            where + ": <colour> is unknown, insonify knows <material>");
  EXPECT_EQ(error_of(sdf_of(kBox, "<insonify:material> </insonify:material>")),
            where + ": <insonify:material> is empty");
  EXPECT_EQ(error_of(sdf_of(kBox, "<plugin name='insonify' filename='x'><material/></plugin>")),
            where + ": <material> is empty");
  EXPECT_EQ(error_of(sdf_of(kBox,
                            "<insonify:material>mud</insonify:material>"
                            "<plugin name='insonify' filename='x'><material>silt</material></plugin>")),
            where + " has two materials, 'silt' and 'mud'");
}

}  // namespace
}  // namespace insonify::sdf_material_test
