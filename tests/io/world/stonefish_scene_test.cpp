// stonefish_scene_test.cpp -- bodies of Stonefish scenarios: where they are, what shape and material they have.

#include "insonify/picture.h"
#include "io/stonefish_files.h"

namespace insonify::stonefish_scene_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Vertices are kept in single precision: a few units in the last place of metres.
constexpr double kVertexError = 1e-5;

void expect_near(const Vec3& value, const Vec3& expected, double error = kVertexError) {
  EXPECT_LT((value - expected).norm(), error) << value.transpose() << " is not " << expected.transpose();
}

// A pyramid with its tip at z = -3, which is up in Stonefish, and a base of 2 x 4 m at z = 0.
constexpr const char* kPyramid =
    "usemtl paint\nv -1 -2 0\nv 1 -2 0\nv 1 2 0\nv -1 2 0\nv 0 0 -3\nf 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n";

std::string mesh(const std::string& tag, const std::string& file, const std::string& scale = "1",
                 const std::string& xyz = "0 0 0") {
  return fmt::format("<{0}><mesh filename='{1}' scale='{2}'/><origin xyz='{3}' rpy='0 0 0'/></{0}>", tag, file, scale,
                     xyz);
}

TEST_F(StonefishTest, ZIsDown) {
  const Instance box = only("<static name='Wall' type='box'><dimensions xyz='2 4 6'/>" +
                            transform("world_transform", "1 2 13") + "</static>");
  EXPECT_EQ(box.name, "Wall");
  const Box3 bounds = bounds_of(box);
  expect_near(bounds.low, {0, -4, -16});
  expect_near(bounds.high, {2, 0, -10});
  EXPECT_THAT(said, ElementsAre("pool.scn: z is down there: x stays, y and z change their signs"));
}

// Roll, then pitch, then yaw about fixed axes: the x axis turns to (cos y cos p, sin y cos p, -sin p), here (-0.443044,
// 0.757538, 0.479426) for p = -0.5 and y = 2.1, whatever the roll.
TEST_F(StonefishTest, AnglesAreRollPitchYawAboutFixedAxes) {
  const Instance ball =
      only("<dynamic name='d' type='sphere'><dimensions radius='1'/><origin xyz='10 0 0' rpy='0 0 0'/>" +
           transform("world_transform", "1 2 3", "0.3 -0.5 2.1") + "</dynamic>");
  expect_near(ball.world_from_mesh.position, {1 - 4.43044, -(2 + 7.57538), -(3 + 4.79426)});
}

TEST_F(StonefishTest, SolidsHaveTheirSizes) {
  const auto size = [&](const std::string& type, const std::string& dimensions) {
    const Box3 bounds = bounds_of(only(fmt::format("<static name='s' type='{}'><dimensions {}/>{}</static>", type,
                                                   dimensions, transform("world_transform", "0 0 0"))));
    return Vec3(bounds.high - bounds.low);
  };
  constexpr double kFacets = 2e-3;  // Error of circles cut into facets of 0.05 rad: 1 - cos(0.025), twice, of 3 m.
  expect_near(size("sphere", "radius='1.5'"), {3, 3, 3}, kFacets);
  expect_near(size("cylinder", "radius='0.5' height='3'"), {1, 1, 3}, kFacets);
  expect_near(size("torus", "major_radius='1' minor_radius='0.25'"), {2.5, 0.5, 2.5}, kFacets);
  const std::string plane = "<static name='Bottom' type='plane'>" + transform("world_transform", "0 0 7") + "</static>";
  const Box3 bottom = bounds_of(only(plane));
  expect_near(bottom.low, {-5000, -5000, -7});
  expect_near(bottom.high, {5000, 5000, -7});
}

TEST_F(StonefishTest, ATorusFacesOutwards) {
  Scene scene = load("<static name='t' type='torus'><dimensions major_radius='2' minor_radius='0.5'/>" +
                     transform("world_transform", "0 0 0") + "</static>");
  EXPECT_THAT(scene.solids_around({2, 0.1, 0.1}), ElementsAre(0));
  EXPECT_THAT(scene.solids_around({0, 0, 0}), IsEmpty());
}

TEST_F(StonefishTest, ModelsAreDrawnAsTheirVisualsSay) {
  write("pyramid.obj", kPyramid);
  write("block.stl",
        "solid b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 5 0 0\nvertex 0 5 0\nendloop\nendfacet\n"
        "endsolid b\n");
  const std::string model = "<static name='m' type='model'>" + mesh("physical", "block.stl") +
                            mesh("visual", "pyramid.obj", "2", "0 0 -1") + transform("world_transform", "10 0 5") +
                            "</static>";
  // The tip is 6 m above the base, which is 4 m below the surface.
  Box3 bounds = bounds_of(only(model));
  expect_near(bounds.low, {8, -4, -4});
  expect_near(bounds.high, {12, 4, 2});
  bounds = bounds_of(only(model, {.collisions = true}));
  expect_near(bounds.low, {10, -5, -5});
  expect_near(bounds.high, {15, 0, -5});
  const std::string bare = "<static name='m' type='model'>" + mesh("physical", "pyramid.obj") +
                           transform("world_transform", "0 0 0") + "</static>";
  EXPECT_NEAR(bounds_of(only(bare)).high.z(), 3, kVertexError);
}

// 3 columns along x, 2 rows along y. Of 8 bits: 51 is the darkest, 255 is 204 levels or 8 m higher.
TEST_F(StonefishTest, TerrainRisesFromItsDarkestPixel) {
  Picture picture;
  picture.width = 3;
  picture.height = 2;
  for (const std::uint8_t level : {51, 51, 51, 51, 51, 255}) {
    picture.rgb.insert(picture.rgb.end(), 3, level);
  }
  write_png(scratch.path() / "terrain.png", picture);
  const Instance terrain = only(
      "<static name='t' type='terrain'><height_map filename='terrain.png'/>"
      "<dimensions scalex='2' scaley='3' height='10'/>" +
      transform("world_transform", "0 0 20") + "</static>");
  const Box3 bounds = bounds_of(terrain);
  expect_near(bounds.low, {-2, -1.5, -20});
  expect_near(bounds.high, {2, 1.5, -12});
  Vec3 top = Vec3::Constant(-1e9);
  for (const Vec3f& vertex : terrain.mesh->vertices) {
    const Vec3 point = terrain.world_from_mesh * vertex.cast<double>();
    top = point.z() > top.z() ? point : top;
  }
  expect_near(top, {2, -1.5, -12});  // The last column is north, the last row is east.
}

TEST_F(StonefishTest, CompoundBodiesAreTheirExternalParts) {
  const std::string parts =
      "<external_part name='hull' type='box'><dimensions xyz='2 2 2'/><origin xyz='0 0 0' rpy='0 0 0'/>" +
      transform("compound_transform", "0 0 -3") +
      "</external_part><external_part name='fin' type='box'><dimensions xyz='2 2 2'/>"
      "<origin xyz='0 0 0' rpy='0 0 0'/>" +
      transform("compound_transform", "4 0 0", "0 0 1") +
      "</external_part><internal_part name='battery' type='box'><dimensions xyz='9 9 9'/>" +
      transform("compound_transform", "0 0 0") + "</internal_part>";
  const Scene scene =
      load("<dynamic name='rov' type='compound'>" + parts + transform("world_transform", "0 0 10") + "</dynamic>");
  EXPECT_THAT(names_of(scene), ElementsAre("rov::hull", "rov::fin"));
  expect_near(scene.instances[0].world_from_mesh.position, {0, 0, -7});
  expect_near(scene.instances[1].world_from_mesh.position, {4, 0, -10});
}

std::string link(const std::string& tag, const std::string& name) {
  return fmt::format(
      "<{0} name='{1}' type='sphere'><dimensions radius='0.1'/><origin xyz='0 0 0' rpy='0 0 0'/></{0}>\n", tag, name);
}
std::string joint(const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& pose) {
  return fmt::format("<joint name='{1}_{2}' type='{0}'><parent name='{1}'/><child name='{2}'/><origin {3}/></joint>\n",
                     type, parent, child, pose);
}

// The base looks east: its x is the world's y. The arm is 2 m ahead of it, the hand another 1 m to its right (south).
TEST_F(StonefishTest, LinksAreWhereTheirJointsPutThem) {
  const Scene scene = load("<robot name='r' fixed='false'>" + link("link", "hand") + link("base_link", "base") +
                           link("link", "arm") + joint("revolute", "arm", "hand", "xyz='0 1 0' rpy='0 0 0'") +
                           joint("fixed", "base", "arm", "xyz='2 0 0' rpy='0 0 0'") +
                           transform("world_transform", "0 0 5", "0 0 1.5707963267948966") + "</robot>");
  EXPECT_THAT(names_of(scene), ElementsAre("r::base", "r::arm", "r::hand"));
  expect_near(scene.instances[0].world_from_mesh.position, {0, 0, -5});
  expect_near(scene.instances[1].world_from_mesh.position, {0, -2, -5});
  expect_near(scene.instances[2].world_from_mesh.position, {-1, -2, -5});
  EXPECT_THAT(said, Contains("pool.scn: at their zero position: joints that move (1)"));
}

TEST_F(StonefishTest, ALinkWithoutAPlaceIsMissing) {
  const std::string robot = "<robot name='r' fixed='false'>" + link("base_link", "base") + link("link", "lost") +
                            transform("world_transform", "0 0 5") + "</robot>";
  EXPECT_THAT(names_of(load(robot)), ElementsAre("r::base"));
  EXPECT_THAT(said, Contains("pool.scn: 1 part of the world is skipped (an error with strict: true): pool.scn:3:1: "
                             "link 'lost' is joined to no link of its robot"));
  EXPECT_EQ(error_of(robot, {.strict = true}), "pool.scn:3:1: link 'lost' is joined to no link of its robot");
}

TEST_F(StonefishTest, AnimatedBodiesAreWhereTheyBegin) {
  const std::string points = transform("keypoint time='0'", "1 2 3") + transform("keypoint time='9'", "5 5 5");
  const Instance fish = only(
      "<animated name='fish' type='sphere'><dimensions radius='1'/><origin xyz='0 0 0' rpy='0 0 0'/>"
      "<trajectory type='pwl' playback='repeat'>" +
      points + "</trajectory></animated>");
  expect_near(fish.world_from_mesh.position, {1, -2, -3});
  EXPECT_THAT(said, Contains("pool.scn: where their trajectories begin: animated bodies (1)"));
}

TEST_F(StonefishTest, MaterialsAreLookedUpByName) {
  Scene scene = load(ball("a", "0 0 0", "<material name='Steel'/><look name='sand'/>") +
                     ball("b", "5 0 0", "<material name='Neutral'/><look name='Concrete'/>") +
                     ball("c", "9 0 0", "<material name='Neutral'/><look name='yellow'/>"));
  std::vector<std::string> messages;
  assign_materials(scene, {.default_material = "mud"},
                   [&](Severity, const std::string& line) { messages.push_back(line); });
  const auto name = [&](std::size_t i) { return scene.materials.at(scene.instances[i].materials.at(0)).name; };
  EXPECT_EQ(name(0), "steel");
  EXPECT_EQ(name(1), "concrete");
  EXPECT_EQ(name(2), "mud");
  EXPECT_THAT(messages, ElementsAre("took mud for the materials that meshes call Neutral"));
  MaterialRules rules;
  rules.overrides["Neutral"].like = "rubber";
  assign_materials(scene, rules);
  EXPECT_EQ(name(2), "Neutral");
}

// Stonefish does not read the materials of mesh files.
TEST_F(StonefishTest, AMeshHasTheMaterialOfItsBody) {
  write("pyramid.obj", kPyramid);
  const Instance body = only("<static name='m' type='model'>" + mesh("physical", "pyramid.obj") +
                             "<material name='Rock'/>" + transform("world_transform", "0 0 0") + "</static>");
  EXPECT_THAT(body.mesh->material_names, ElementsAre("Rock"));
  EXPECT_THAT(body.mesh->material_slots, IsEmpty());
}

TEST_F(StonefishTest, EqualShapesShareAMesh) {
  const Scene scene = load(ball("a", "0 0 0") + ball("b", "5 0 0") + ball("c", "9 0 0", "<material name='Steel'/>"));
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh);
  EXPECT_NE(scene.instances[0].mesh, scene.instances[2].mesh);
}

TEST_F(StonefishTest, EqualNamesAreTold) {
  EXPECT_THAT(names_of(load(ball("a", "0 0 0") + ball("a", "5 0 0") + ball("a", "9 0 0"))),
              ElementsAre("a", "a_2", "a_3"));
}

TEST_F(StonefishTest, WhatIsIgnoredIsLeftOut) {
  const std::string all = ball("floor", "0 0 9") + ball("box_1", "5 0 0") + "<robot name='rov' fixed='false'>" +
                          link("base_link", "base") + transform("world_transform", "0 0 5") + "</robot>";
  EXPECT_THAT(names_of(load(all, {.ignore = {"box_?", "rov"}})), ElementsAre("floor"));
  EXPECT_THAT(names_of(load(all, {.ignore = {"rov::*", "whale"}})), ElementsAre("floor", "box_1"));
  EXPECT_THAT(said, Contains("pool.scn: ignore: 'whale' is the name of nothing in the world"));
  EXPECT_EQ(error_of(all, {.ignore = {"*"}}), "pool.scn: there is no body to insonify except what `ignore` removes");
}

TEST_F(StonefishTest, WhatIsNotReadIsTold) {
  load(
      "<environment><ocean><current type='uniform'/><current type='jet'/></ocean></environment><materials/><looks/>"
      "<light name='l'/><comm name='c' type='usbl'/><sensor name='cam' type='camera'/>" +
      ball("a", "0 0 0") + "<robot name='r' fixed='false'><actuator name='t' type='thruster'/><ros_publisher/>" +
      link("base_link", "base") + transform("world_transform", "0 0 5") + "</robot>");
  EXPECT_THAT(said,
              ElementsAre("pool.scn: z is down there: x stays, y and z change their signs",
                          "pool.scn: not read: actuator (1), comm (1), current (2), light (1), sensor of type "
                          "camera (1)",
                          "pool.scn: the ocean's surface is not read: it is where `surface` of a scenario of insonify "
                          "says"));
}

TEST_F(StonefishTest, WingsAreLeftOut) {
  const std::string wing = "<static name='w' type='wing'>" + transform("world_transform", "0 0 0") + "</static>";
  EXPECT_THAT(names_of(load(ball("a", "0 0 0") + wing)), ElementsAre("a"));
  EXPECT_THAT(said, Contains("pool.scn:3:1: static 'w' is skipped: insonify has no shape of type 'wing'"));
}

// ---------------------------------------------------------------------------------------------------- Files

TEST_F(StonefishTest, IncludesReplaceTheirArguments) {
  write("buoy.scn", scenario("<static name='$(arg name)_buoy' type='sphere'><dimensions radius='1'/>"
                             "<world_transform xyz='$(arg x) 0 $(arg z)' rpy='0 0 0'/></static>"));
  const auto include = [](const std::string& name, const std::string& x) {
    return fmt::format(
        "<include file='buoy.scn'><arg name='name' value='{}'/><arg name='x' value='{}'/>"
        "<arg name='z' value='4'/></include>",
        name, x);
  };
  const Scene scene = load(include("left", "1") + include("right", "7") + ball("a", "0 0 0"));
  EXPECT_THAT(names_of(scene), ElementsAre("a", "left_buoy", "right_buoy"));
  expect_near(scene.instances[2].world_from_mesh.position, {7, 0, -4});
}

TEST_F(StonefishTest, FilesAreInDataFoldersAndPackages) {
  write("src/pool_sim/package.xml", "<package format='3'><name>pool_simulation</name></package>");
  write("src/pool_sim/data/objects/pyramid.obj", kPyramid);
  write("src/pool_sim/objects/a.scn",
        scenario("<static name='m' type='model'>" + mesh("physical", "objects/pyramid.obj") +
                 transform("world_transform", "0 0 0") + "</static>"));
  const std::string main =
      write("src/pool_sim/scenarios/main.scn", scenario("<include file='$(find pool_simulation)/objects/a.scn'/>"));
  EXPECT_THAT(names_of(load_file(main)), ElementsAre("m"));
  write("prefix/share/buoys/b.scn", scenario(ball("buoy", "0 0 0")));
  setenv("AMENT_PREFIX_PATH", ("/nowhere:" + (scratch.path() / "prefix").string()).c_str(), 1);
  EXPECT_THAT(names_of(load("<include file='$(find buoys)/b.scn'/>")), ElementsAre("buoy"));
}

TEST_F(StonefishTest, FilesOutsideTheSceneAreLeftOut) {
  write("out/buoy.scn", scenario(ball("buoy", "0 0 0")));
  write("out/pyramid.obj", kPyramid);
  std::filesystem::create_directories(scratch.path() / "in");
  std::filesystem::create_symlink("../out/buoy.scn", scratch.path() / "in/link.scn");
  const std::string outside = " lies outside of the scene's folder and of those that INSONIFY_MODEL_PATH names";
  const std::string whole = (scratch.path() / "out/buoy.scn").string();
  for (const std::string& name : {std::string("../out/buoy.scn"), std::string("out/buoy.scn"), std::string("link.scn"),
                                  std::string("$(find out)/buoy.scn"), whole}) {
    const std::string file = write("in/w.scn", scenario("<include file='" + name + "'/>" + ball("a", "0 0 0")));
    EXPECT_THAT(names_of(load_file(file)), ElementsAre("a")) << name;
    EXPECT_THAT(said[0], HasSubstr(".scn'" + outside)) << name;
  }
  const std::string model =
      write("in/m.scn", scenario("<static name='m' type='model'>" + mesh("physical", "../out/pyramid.obj") +
                                 transform("world_transform", "0 0 0") + "</static>" + ball("a", "0 0 0")));
  EXPECT_THAT(names_of(load_file(model)), ElementsAre("a"));
  EXPECT_THAT(said[0], HasSubstr("static 'm': '../out/pyramid.obj'" + outside));
  setenv("INSONIFY_MODEL_PATH", (scratch.path() / "out").c_str(), 1);
  EXPECT_THAT(names_of(load_file(model)), ElementsAre("m", "a"));
}

TEST_F(StonefishTest, WhatIsMissingIsLeftOut) {
  const std::string broken =
      "<include file='$(find nowhere)/robot.scn'/>\n<include file='gone.scn'/>\n<static name='m' type='model'>" +
      mesh("physical", "gone.obj") + transform("world_transform", "0 0 0") +
      "</static>\n<static name='p' type='sphere'><dimensions radius='1'/>"
      "<world_transform xyz='$(param position)' rpy='0 0 0'/></static>\n" +
      "<static name='q' type='sphere'><dimensions radius='${2*0.5}'/>" + transform("world_transform", "0 0 0") +
      "</static>\n";
  EXPECT_THAT(names_of(load(broken + ball("a", "0 0 0"))), ElementsAre("a"));
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(
      said[0],
      "pool.scn: 5 parts of the world are skipped (an error with strict: true): pool.scn:2:1: <include>: file = "
      "'$(find nowhere)/robot.scn': no such package above the scenario or in AMENT_PREFIX_PATH or "
      "ROS_PACKAGE_PATH; pool.scn:3:1: <include> 'gone.scn', pool.scn:4:1: static 'm': 'gone.obj' not found in the "
      "scenario's folder, those above it, their folders data, Data and resources, or those of "
      "INSONIFY_MODEL_PATH; pool.scn:5:1: static 'p': <world_transform> xyz = '$(param position)': has no value "
      "here; --set arguments.position=... gives it one; pool.scn:6:1: static 'q': <dimensions> radius = '${2*0.5}': "
      "formulas are not "
      "worked out, write the number");
  EXPECT_THAT(error_of(broken), HasSubstr("pool.scn: nothing is left to insonify: pool.scn:2:1: "));
}

// ---------------------------------------------------------------------------------------------------------------------

TEST_F(StonefishTest, ArgumentsOfTheUserReplaceThoseOfLaunchFiles) {
  const std::string balls =
      "<static name='b' type='sphere'><dimensions radius='1'/>"
      "<world_transform xyz='$(arg px) $(param /rov/py) 3' rpy='0 0 0'/></static>\n";
  write("inner.scn", scenario(balls));
  const std::string outer = "<include file='inner.scn'><arg name='py' value='7'/></include>" + ball("a", "0 0 0");
  const Scene scene = load(balls + outer, {.arguments = {"px=8", "py=9"}});
  ASSERT_THAT(names_of(scene), ElementsAre("b", "a", "b_2"));
  EXPECT_THAT(scene.instances[0].world_from_mesh.position, testing::Eq(Vec3(8, -9, -3)));
  EXPECT_THAT(scene.instances[2].world_from_mesh.position, testing::Eq(Vec3(8, -7, -3)));

  EXPECT_EQ(error_of(balls),
            "pool.scn: nothing is left to insonify: pool.scn:2:1: static 'b': <world_transform> xyz = '$(arg px) "
            "$(param /rov/py) 3': has no value here; --set arguments.px=... gives it one");
}

TEST_F(StonefishTest, ArgumentsAreAMapOfAScenario) {
  write("pool.scn", scenario(ball("a", "0 0 0")));
  const std::string yaml = "world: pool.scn\nsonars: [{}]\narguments: {px: 8, name: rov}\n";
  EXPECT_THAT(parse(yaml).arguments, ElementsAre("px=8", "name=rov"));
  EXPECT_THAT(parse(yaml, {"arguments.px=9", "arguments.z=1.5"}).arguments, ElementsAre("px=9", "name=rov", "z=1.5"));
  EXPECT_THAT(parse("world: pool.scn\nsonars: [{}]\n", {"arguments.px=9"}).arguments, ElementsAre("px=9"));
  const auto error = [&](const std::string& arguments) {
    return without_folder(message_of([&] { (void)parse("world: pool.scn\narguments: " + arguments + "\n"); }));
  };
  EXPECT_EQ(error("[px]"), "scenario:2:13: arguments[0] = \"px\" must be name=value");
  EXPECT_EQ(error("{px: [1, 2]}"), "scenario:2:13: arguments.px = [1, 2] must be a text or a number");
}

// The sensor's place follows from an argument too.
TEST_F(StonefishTest, SonarsHaveTheSameArguments) {
  write("pool.scn", scenario("<sensor name='fls' type='fls'><specs beams='$(arg beams)' bins='100' horizontal_fov='90' "
                             "vertical_fov='20'/><world_transform xyz='0 0 0' rpy='0 0 0'/></sensor>" +
                             ball("a", "5 0 0")));
  EXPECT_EQ(parse("world: pool.scn\narguments: {beams: 64}\n").sonars.at(0).beam_count, 64);
  EXPECT_EQ(parse("world: pool.scn\n", {"arguments.beams=32"}).sonars.at(0).beam_count, 32);
}

TEST_F(StonefishTest, ThePhysicalMeshStandsForAVisualThatCannotBeRead) {
  write("solid.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene = load("<static name='m' type='model'>" + mesh("visual", "gone.obj") +
                           mesh("physical", "solid.obj") + transform("world_transform", "0 0 0") + "</static>");
  EXPECT_EQ(scene.instances.at(0).mesh->triangles.size(), 1U);
  EXPECT_EQ(said.at(0),
            "pool.scn:2:1: static 'm': 'gone.obj' not found in the scenario's folder, those above it, their folders "
            "data, Data and resources, or those of INSONIFY_MODEL_PATH: the mesh of <physical> is taken");
}

}  // namespace
}  // namespace insonify::stonefish_scene_test
