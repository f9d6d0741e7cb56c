// sdf_odd_elements_test.cpp -- one odd element, encoding or scheme does not stop a world: it is read, or left out with
// a warning.

#include "insonify/printable.h"
#include "io/sdf_files.h"

namespace insonify::sdf_odd_elements_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using SdfOddElementsTest = SdfTest;

std::string box(const std::string& name, const std::string& size = "1 2 3", const std::string& more = "") {
  return "<visual name='" + name + "'><geometry><box><size>" + size + "</size></box></geometry>" + more + "</visual>";
}
std::string model(const std::string& name, const std::string& more = "") {
  return "<model name='" + name + "'><static>true</static>" + more + "<link name='l'>" + box("v") + "</link></model>";
}
std::string world(const std::string& inside) {
  return "<sdf version='1.9'><world name='w'>\n" + inside + "</world></sdf>";
}

TEST_F(SdfOddElementsTest, WhatHasNoShapeIsNotJudged) {
  const Scene scene = load(
      world("<gravity>down</gravity><magnetic_field>none</magnetic_field><atmosphere type='thick'/><wind>strong</wind>"
            "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>north</latitude_deg>"
            "</spherical_coordinates>" +
            model("m", "<self_collide>perhaps</self_collide><enable_wind>perhaps</enable_wind>")));
  EXPECT_THAT(names(scene), ElementsAre("m::l::v"));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(SdfOddElementsTest, AMoonIsReadWithAWarning) {
  const Scene scene =
      load(world("<spherical_coordinates>\n<surface_model>MOON_SCS</surface_model>"
                 "</spherical_coordinates>" +
                 model("m")));
  EXPECT_THAT(names(scene), ElementsAre("m::l::v"));
  EXPECT_THAT(said, ElementsAre("scene.sdf:3:1: <surface_model> = 'MOON_SCS' is not read: places are in metres"));
}

TEST_F(SdfOddElementsTest, WhatIsInPluginsIsTheirs) {
  const std::string plugin =
      "<plugin name='p' filename='f'><waypoint><pose>1 2 3</pose></waypoint><model name='a'/><model name='a'/>"
      "<include><uri>model://none</uri></include><box><size>big</size></box><pose>here</pose></plugin>";
  const Scene scene = load(world(plugin + model("m", plugin)));
  EXPECT_THAT(names(scene), ElementsAre("m::l::v"));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(SdfOddElementsTest, APoseWithTooFewNumbersIsCompleted) {
  const Scene scene = load(world(model("m", "<pose>1 2 3 0 0</pose>")));
  ASSERT_THAT(names(scene), ElementsAre("m::l::v"));
  EXPECT_THAT(scene.instances[0].world_from_mesh.position, Near3(Vec3(1, 2, 3), kPoseError));
  EXPECT_THAT(said,
              ElementsAre("scene.sdf:2:38: <pose> = '1 2 3 0 0' has 5 of 6 numbers: it is read as '1 2 3 0 0 0'"));

  const Scene turned = load(world(model("m", "<pose rotation_format='quat_xyzw'>1 2</pose>")));
  EXPECT_THAT(turned.instances[0].world_from_mesh.position, Near3(Vec3(1, 2, 0), kPoseError));
  EXPECT_THAT(said, ElementsAre("scene.sdf:2:38: <pose> = '1 2' has 2 of 7 numbers: it is read as '1 2 0 0 0 0 1'"));
}

TEST_F(SdfOddElementsTest, AShapeOrAPlaceThatCannotBeReadIsLeftOut) {
  const std::string left_out = "scene.sdf: 1 part of the world is skipped (an error with strict: true): ";
  const auto link = [](const std::string& inside) {
    return world(model("m") + "<model name='n'><static>true</static><link name='l'>\n" + inside + "</link></model>");
  };
  EXPECT_THAT(names(load(link(box("bad", "1 2") + box("good")))), ElementsAre("m::l::v", "n::l::good"));
  EXPECT_THAT(said, ElementsAre(left_out + "scene.sdf:3:35: <size> = '1 2' must be 3 finite numbers"));

  EXPECT_THAT(names(load(link(box("bad", "1 2 3", "<pose>0 0 high 0 0 0</pose>") + box("good")))),
              ElementsAre("m::l::v", "n::l::good"));
  EXPECT_THAT(said, ElementsAre(left_out + "scene.sdf:3:70: <pose> = '0 0 high 0 0 0' must be 6 finite numbers"));

  EXPECT_THAT(names(load(link(box("bad", "1 2 -3") + box("good")))), ElementsAre("m::l::v", "n::l::good"));
  EXPECT_THAT(said, ElementsAre(left_out + "scene.sdf:3:1: visual 'n::l::bad': <size> = 1 2 -3 m must be greater than "
                                           "0 m in each direction"));
}

// What libsdformat refuses, with the place of its element.
TEST_F(SdfOddElementsTest, AnElementThatLibsdformatRefusesIsLeftOut) {
  const Scene scene = load(world(model("m") +
                                 "<model name='n'><static>true</static>\n"
                                 "<allow_auto_disable>perhaps</allow_auto_disable>\n"
                                 "<link name='l'>" +
                                 box("v", "1 2 3", "<transparency>clear</transparency>") + "</link></model>"));
  EXPECT_THAT(names(scene), ElementsAre("m::l::v", "n::l::v"));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(
      said[0].starts_with("scene.sdf: 1 part of the world is skipped (an error with strict: true): "
                          "scene.sdf:4:"))
      << said[0];
}

// Faults of which libsdformat says names only.
TEST_F(SdfOddElementsTest, WhatRefersToNothingIsLeftOut) {
  EXPECT_THAT(names(load(world(model("m", "<frame name='f' attached_to='nowhere'/>")))), ElementsAre("m::l::v"));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(
      said[0].starts_with("scene.sdf: 1 part of the world is skipped (an error with strict: true): scene.sdf:2:38: "
                          "attached_to name[nowhere] specified by frame with name[f]"))
      << said[0];
  EXPECT_THAT(names(load(world(model("m") +
                               "<model name='n'><static>true</static><link name='k'>"
                               "<pose relative_to='nowhere'>1 0 0 0 0 0</pose>" +
                               box("w") + "</link><link name='l'>" + box("v") + "</link></model>"))),
              ElementsAre("m::l::v", "n::l::v"));
}

// The file is read from a copy, as its spherical coordinates are removed, in which everything is on other lines.
TEST_F(SdfOddElementsTest, WarningsNameTheUsersFileAndLine) {
  (void)load(world("<spherical_coordinates/>\n\n\n<model name='m'><static>true</static>\n<link name='l' colour='red'>" +
                   box("v") + "</link></model>"));
  EXPECT_THAT(said,
              ElementsAre("scene.sdf: [/sdf/world[@name=\"w\"]/model[@name=\"m\"]/link[@name=\"l\"][@colour=\"red\"]:"
                          "scene.sdf:6]: XML Attribute[colour] in element[link] not defined in SDF"));
}

TEST_F(SdfOddElementsTest, APoseInDegreesWithoutSayingSoIsTold) {
  (void)load(world(model("m", "<pose>0 0 0 0 0 80</pose>")));
  EXPECT_THAT(said, ElementsAre("scene.sdf:2:38: <pose> turns by 80 rad; in degrees it needs degrees='true'"));
  (void)load(world(model("m", "<pose degrees='true'>0 0 0 0 0 80</pose>")));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(SdfOddElementsTest, StrictWorldsRefuseThem) {
  EXPECT_EQ(error_of(world(model("m", "<pose>1 2 3 0 0</pose>"))),
            "scene.sdf:2:38: <pose> = '1 2 3 0 0' must be 6 finite numbers");
  EXPECT_EQ(error_of(world(model("m") + "<model name='n'><link name='l'>" + box("v", "1 2") + "</link></model>")),
            "scene.sdf:2:207: <size> = '1 2' must be 3 finite numbers");
}

// ---------------------------------------------------------------------------------------------------------------------

TEST_F(SdfOddElementsTest, DeclaredEncodingsAreRead) {
  const std::string latin1 = "<?xml version='1.0' encoding='ISO-8859-1'?>\n" + world(model("t\xe9"));
  EXPECT_THAT(names(load(latin1)), ElementsAre("t\u00e9::l::v"));
  std::string utf16 = "\xff\xfe";
  for (const char c : world(model("m"))) {
    utf16 += {c, '\0'};
  }
  EXPECT_THAT(names(load(utf16)), ElementsAre("m::l::v"));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(SdfOddElementsTest, BytesThatAreNoTextAreEscaped) {
  EXPECT_THAT(names(load(world(model("t\xe9")))), ElementsAre("t\\xe9::l::v"));
  EXPECT_THAT(names(load("<?xml version='1.0' encoding='utf-8'?>" + world(model("t\xe9")))),
              ElementsAre("t\\xe9::l::v"));
  EXPECT_THAT(names(load("<?xml version='1.0' encoding='UTF-16'?>" + world(model("m")))), ElementsAre("m::l::v"))
      << "text of single bytes is not UTF-16, whatever it declares";
}

// As Gazebo: the rest of any scheme but http is a path in the folders of models.
TEST_F(SdfOddElementsTest, TheRestOfAnySchemeIsAPath) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  write("models/rov/meshes/b.obj", triangle);
  write("elsewhere/rov/meshes/c d.obj", triangle);
  setenv("GZ_SIM_RESOURCE_PATH", (folder / "elsewhere").c_str(), 1);
  for (const std::string uri : {"models://rov/meshes/b.obj", "model://rov/meshes/b.obj", "package://rov/meshes/b.obj",
                                "my_scheme:///rov/meshes/b.obj", "models://rov/meshes/c%20d.obj",
                                "rov/meshes/c%20d.obj", "file://elsewhere/rov/meshes/c%20d.obj"}) {
    const Scene scene = load(sdf_of("<mesh><uri>" + uri + "</uri></mesh>"));
    EXPECT_THAT(names(scene), ElementsAre("ship::hull::plate")) << uri;
    EXPECT_THAT(said, IsEmpty()) << uri;
  }
}

}  // namespace
}  // namespace insonify::sdf_odd_elements_test
