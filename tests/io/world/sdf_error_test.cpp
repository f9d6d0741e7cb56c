// sdf_error_test.cpp -- errors about SDF files are one line with the position.

#include "io/sdf_files.h"

namespace insonify::sdf_error_test {
namespace {

using SdfErrorTest = SdfTest;

TEST_F(SdfErrorTest, NamesMissingAndUnreadableFiles) {
  EXPECT_EQ(error_of_file((folder / "nothing.sdf").string()), "nothing.sdf: no such file");
  std::filesystem::create_directory(folder / "folder.sdf");
  EXPECT_EQ(error_of_file((folder / "folder.sdf").string()), "folder.sdf: is a folder, not a file");
}

TEST_F(SdfErrorTest, RefusesWhatIsNotSdf) {
  EXPECT_EQ(error_of(""), "scene.sdf: the file is empty");
  EXPECT_EQ(error_of("<sdf version='1.9'>\n<model name='a'>\n</sdf>"),
            "scene.sdf:3:3: not valid XML: an element is not closed, or closed twice");
  EXPECT_EQ(error_of("<?xml version='1.0'?>\n<launch/>"), "scene.sdf:2:1: the root element is <launch>, not <sdf>");
  EXPECT_EQ(error_of("<robot name='r'/>"),
            "scene.sdf:1:1: the root element is <robot>, not <sdf>; 'gz sdf -p' or 'ign sdf -p' turns URDF into SDF");
  EXPECT_EQ(error_of("<sdf/>"), "scene.sdf:1:1: <sdf> has no version, 1.4 to 1.9 are read");
  EXPECT_EQ(error_of("<sdf version='new'/>"),
            "scene.sdf:1:1: SDF version 'new' is not two numbers, 1.4 to 1.9 are read");
  EXPECT_EQ(error_of("<sdf version='1.9b'/>"),
            "scene.sdf:1:1: SDF version '1.9b' is not two numbers, 1.4 to 1.9 are read");
}

TEST_F(SdfErrorTest, NamesIncludesThatAreNotThere) {
  const auto world = [](const std::string& uri) {
    return "<sdf version='1.9'><world name='w'>\n<include>\n<uri>" + uri + "</uri></include></world></sdf>";
  };
  EXPECT_EQ(error_of(world("model://ship")),
            "scene.sdf:3:1: include 'model://ship' not found beside this file, in the folders above it or in those of "
            "INSONIFY_MODEL_PATH, SDF_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, GAZEBO_MODEL_PATH, "
            "GAZEBO_RESOURCE_PATH");
  EXPECT_EQ(error_of(world("/nowhere/ship.sdf")), "scene.sdf:3:1: include '/nowhere/ship.sdf' does not exist");
  EXPECT_EQ(error_of(world("")), "scene.sdf:3:1: include '' names nothing");
  EXPECT_EQ(error_of(world("https://example.org/models/ship")),
            "scene.sdf:3:1: include 'https://example.org/models/ship' is not on this machine: fetch it and "
            "name its folder");
}

TEST_F(SdfErrorTest, NamesModelFoldersWithoutModel) {
  std::filesystem::create_directory(folder / "empty");
  write("gone/model.config", "<model><name>gone</name><sdf version='1.9'>gone.sdf</sdf></model>");
  write("odd/model.config", "<model><name>odd</name><sdf version='odd'>model.sdf</sdf></model>");
  const std::string world = "<sdf version='1.9'><world name='w'><include><uri>model://{}</uri></include></world></sdf>";
  EXPECT_EQ(
      error_of(fmt::format(fmt::runtime(world), "empty")),
      "scene.sdf:1:45: include 'model://empty': empty holds no model.sdf, nor a model.config that names a file in it");
  EXPECT_EQ(
      error_of(fmt::format(fmt::runtime(world), "gone")),
      "scene.sdf:1:45: include 'model://gone': gone holds no model.sdf, nor a model.config that names a file in it");
  EXPECT_EQ(
      error_of(fmt::format(fmt::runtime(world), "odd")),
      "scene.sdf:1:45: include 'model://odd': odd holds no model.sdf, nor a model.config that names a file in it");
}

TEST_F(SdfErrorTest, RefusesEmptyPartsOfAnInclude) {
  EXPECT_EQ(
      error_of("<sdf version='1.9'><world name='w'><include>\n<name> </name><uri>a</uri></include></world></sdf>"),
      "scene.sdf:2:1: <name> of an include is empty");
}

TEST_F(SdfErrorTest, RefusesIncludesThatGoRoundInCircles) {
  const std::string model = "<sdf version='1.9'><model name='m'>\n<include><uri>{}</uri></include></model></sdf>";
  write("b.sdf", fmt::format(fmt::runtime(model), "scene.sdf"));
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(model), "b.sdf")), "b.sdf:2:10: include 'scene.sdf' includes itself");
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(model), "scene.sdf")),
            "scene.sdf:2:10: include 'scene.sdf' includes itself");
}

TEST_F(SdfErrorTest, TellsFaultsInsideIncludedFilesWithTheirOwnLine) {
  write("bell.sdf",
        "<sdf version='1.9'><model name='bell'>\n<link name='l'>\n<pose>1 2 x 0 0 0</pose></link></model></sdf>");
  write("ship.sdf", "<sdf version='1.9'><model name='ship'>\n<include><uri>bell.sdf</uri></include></model></sdf>");
  EXPECT_EQ(error_of("<sdf version='1.9'><world name='w'><include><uri>ship.sdf</uri></include></world></sdf>"),
            "bell.sdf:3:1: <pose> = '1 2 x 0 0 0' must be 6 finite numbers");
  // ship.sdf is read from a copy with bell.sdf's path written out and its inertia left out; messages name the file
  // itself and lines stay where they are.
  write("bell.sdf", "<sdf version='1.9'><model name='bell'><static>true</static></model></sdf>");
  write(
      "ship.sdf",
      "<sdf version='1.9'><model name='ship'>\n<include><uri>\nbell.sdf\n</uri></include><link name='l'>\n<inertial>\n"
      "</inertial></link>\n<link/></model></sdf>");
  EXPECT_EQ(error_of("<sdf version='1.9'><world name='w'><include><uri>ship.sdf</uri></include></world></sdf>"),
            "ship.sdf:7:1: Required attribute[name] in element[link] is not specified in SDF");
}

TEST_F(SdfErrorTest, RefusesNumbersThatAreNone) {
  EXPECT_EQ(error_of("<sdf version='1.9'><model name='m'>\n<pose>nan 0 0 0 0 0</pose><link name='l'/></model></sdf>"),
            "scene.sdf:2:1: <pose> = 'nan 0 0 0 0 0' must be 6 finite numbers");
  EXPECT_EQ(error_of("<sdf version='1.9'><model name='m'>\n <pose rotation_format='quat_xyzw'>1 2 3 0 0 0</pose>"
                     "<link name='l'/></model></sdf>"),
            "scene.sdf:2:2: <pose> = '1 2 3 0 0 0' must be 7 finite numbers");
  EXPECT_EQ(error_of(sdf_of("<box><size>1 two 3</size></box>")),
            "scene.sdf:4:37: <size> = '1 two 3' must be 3 finite numbers");
  EXPECT_EQ(error_of(sdf_of("<box><size>1 1</size></box>")), "scene.sdf:4:37: <size> = '1 1' must be 3 finite numbers");
  EXPECT_EQ(error_of(sdf_of("<sphere><radius>-inf</radius></sphere>")),
            "scene.sdf:4:40: <radius> = '-inf' must be a finite number");
}

TEST_F(SdfErrorTest, RefusesNestingWithoutEnd) {
  std::string text = "<sdf version='1.9'>\n";
  for (int i = 0; i < 300; ++i) {
    text += "<a>";
  }
  for (int i = 0; i < 300; ++i) {
    text += "</a>";
  }
  text += "</sdf>";
  // One open element in the first line, 199 in the second: 3 x 199 + 1.
  EXPECT_EQ(error_of(text), "scene.sdf:2:598: <a> is nested too deeply: more than 200 elements are open");
}

TEST_F(SdfErrorTest, FilesOfShapesAreToldWithThePlaceThatNamesThem) {
  write("hull.obj", "o deck\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("empty.obj", "# nothing but this comment\n");
  write("hole.asc", "ncols 2\nnrows 2\ncellsize 1\nNODATA_value 7\n7 7\n7 7\n");
  const std::string where = "scene.sdf:4:1: visual 'ship::hull::plate': ";
  EXPECT_EQ(error_of(sdf_of("<mesh><uri>empty.obj</uri></mesh>")), where + "empty.obj: no triangles");
  EXPECT_THAT(error_of(sdf_of("<mesh><uri>hull.obj</uri><submesh><name>mast</name></submesh></mesh>")),
              testing::AllOf(testing::StartsWith(where + "hull.obj: "), testing::HasSubstr("mast")));
  EXPECT_EQ(error_of(sdf_of("<heightmap><uri>hole.asc</uri></heightmap>")),
            where + "hole.asc: no triangles, as no three neighbouring points have data");
}

// Parts in one line differ in their column: 17 + 50 + 9 + 1 characters precede the second.
TEST_F(SdfErrorTest, ColumnsAreThoseOfTheElementAtFault) {
  const std::string box = "<geometry><box><size>1 1 {}</size></box></geometry>";
  EXPECT_EQ(error_of("<sdf version='1.9'><model name='m'><link name='l'>\n<visual name='a'>" +
                     fmt::format(fmt::runtime(box), 1) + "</visual> <visual name='b'>" +
                     fmt::format(fmt::runtime(box), 0) + "</visual></link></model></sdf>"),
            "scene.sdf:2:78: visual 'm::l::b': <size> = 1 1 0 m must be greater than 0 m in each direction");
}

TEST_F(SdfErrorTest, RefusesPlacesBeyondTheWorld) {
  EXPECT_EQ(error_of("<sdf version='1.9'>\n<model name='m'><pose>0 1e18 0 0 0 0</pose><link name='l'/></model></sdf>"),
            "scene.sdf:2:1: model 'm': <pose> = 0 1e+18 0 m must be from -10000000 to 10000000 m in each direction");
  EXPECT_EQ(error_of(sdf_of("<box><size>1 4e7 3</size></box>")),
            "scene.sdf:4:1: visual 'ship::hull::plate' reaches y = -20000000 m, must be from -10000000 to 10000000 m");
}

TEST_F(SdfErrorTest, GivesTheFirstOfSeveralFaultsAndCountsTheRest) {
  EXPECT_EQ(
      error_of("<sdf version='1.9'><model name='m'><link name='l'>\n<pose relative_to='mast'/></link></model></sdf>"),
      "scene.sdf:2:1: relative_to name[mast] specified by link with name[l] does not match a nested model, link, "
      "joint, "
      "or frame name in model with name[m] (and 2 more errors)");
  EXPECT_EQ(
      error_of("<sdf version='1.9'><model name='m'><frame name='f'><pose relative_to='g'/></frame><frame name='g'>"
               "<pose relative_to='f'/></frame><link name='l'/></model></sdf>"),
      "scene.sdf:1:36: PoseRelativeToGraph cycle detected, already visited vertex [m::f] (and 1 more error)");
  EXPECT_EQ(error_of("<sdf version='1.9'><model name='m'><link name='l'/><link name='l'/></model></sdf>"),
            "scene.sdf:1:52: link 'l' has the name of the one of line 1");
  EXPECT_EQ(error_of("<sdf version='1.9'><world name='w'><model name='m'/></world></sdf>"),
            "scene.sdf:1:36: model 'm' must have a link, or be static");
  EXPECT_EQ(error_of("<sdf version='1.9'><world name='w'>\n<model name='m'><link name='l'/></model>\n  <model "
                     "name='m'><link name='l'/></model></world></sdf>"),
            "scene.sdf:3:3: model 'm' has the name of the one of line 2");
}

TEST_F(SdfErrorTest, SaysWhenThereIsNothingToInsonify) {
  const std::string shell = "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision>";
  const std::string plate = "<visual name='v'><geometry><box><size>1 2 3</size></box></geometry></visual>";
  const std::string image = "<visual name='i'><geometry><image><uri>a.png</uri></image></geometry></visual>";
  const auto model = [](const std::string& parts) {
    return "<sdf version='1.9'><model name='m'><link name='l'>" + parts + "</link></model></sdf>";
  };
  EXPECT_EQ(error_of(model(shell)),
            "no error");  // Its collision shape is insonified.
  EXPECT_EQ(error_of(model(plate + image), true),
            "scene.sdf: there is no collision shape to insonify, but 2 visuals (collisions: false)");
  EXPECT_EQ(error_of(model("")), "scene.sdf: there is no visual to insonify, and no collision shape");
  EXPECT_EQ(error_of(model(image)), "scene.sdf: there is no visual to insonify, 1 left out, and no collision shape");
  EXPECT_EQ(error_of(model(image + shell)),
            "scene.sdf: there is no visual to insonify, 1 left out, but 1 collision shape (collisions: true)");
  EXPECT_EQ(error_of("<sdf version='1.9'/>"), "scene.sdf: there is no visual to insonify, and no collision shape");
}

TEST_F(SdfErrorTest, RefusesTwoPartsOfOneName) {
  const std::string world =
      "<world name='{}'><model name='m'><link name='l'>\n<visual name='v'><geometry><box>"
      "<size>1 2 3</size></box></geometry></visual></link></model></world>";
  EXPECT_EQ(error_of("<sdf version='1.9'>" + fmt::format(fmt::runtime(world), "one") +
                     fmt::format(fmt::runtime(world), "two") + "</sdf>"),
            "scene.sdf:3:1: visual 'm::l::v' has the name of another one");
}

}  // namespace
}  // namespace insonify::sdf_error_test
