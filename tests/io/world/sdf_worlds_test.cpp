// sdf_worlds_test.cpp -- worlds as Gazebo's users have them: with missing files, lights, water planes, Fuel models.

#include <chrono>

#include "io/sdf_files.h"

namespace insonify::sdf_worlds_test {
namespace {

using SdfWorldsTest = SdfTest;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kPlace =
    " not found beside this file, in the folders above it or in those of INSONIFY_MODEL_PATH, SDF_PATH, "
    "GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH";

std::string part(const std::string& kind, const std::string& name, const std::string& geometry) {
  return fmt::format("<{0} name='{1}'><geometry>{2}</geometry></{0}>", kind, name, geometry);
}
std::string box(const std::string& kind, const std::string& name) {
  return part(kind, name, "<box><size>1 2 3</size></box>");
}
std::string model(const std::string& name, const std::string& parts, const std::string& more = "") {
  return fmt::format("<model name='{}'><static>true</static><link name='l'>{}</link>{}</model>", name, parts, more);
}
std::string world(const std::string& inside) {
  return "<sdf version='1.6'><world name='w'>\n" + inside + "\n</world></sdf>";
}
std::string include(const std::string& uri) {
  return "<include><uri>" + uri + "</uri></include>\n";
}
std::string model_file(const std::string& name) {
  return "<sdf version='1.6'>" + model(name, box("visual", "v")) + "</sdf>";
}

TEST_F(SdfWorldsTest, IncludesOfLightsAndActorsLeaveTheRest) {
  write("models/sun/model.config", "<model><name>Sun</name><sdf version='1.5'>model.sdf</sdf></model>");
  write("models/sun/model.sdf",
        "<?xml version='1.0'?>\n<sdf version='1.5'><!-- noon --><light type='directional' name='sun'/></sdf>");
  write("models/diver/model.sdf", "<sdf version='1.6'>\n<actor name='diver'/></sdf>");
  const Scene scene = load(world(include("model://sun") + include("model://sun") + include("model://diver") +
                                 model("m", box("visual", "v"))));
  EXPECT_THAT(names(scene), ElementsAre("m::l::v"));
  EXPECT_THAT(said, ElementsAre("models/diver/model.sdf:2:1: an actor is skipped"));
  EXPECT_EQ(error_of(world(include("model://sun") + model("m", box("visual", "v")))), "no error");
}

// A model with nothing but an include of a light stays readable though no link is left in it.
TEST_F(SdfWorldsTest, IncludesOfLightsInModelsToo) {
  write("sun.sdf", "<sdf version='1.5'><light type='directional' name='sun'/></sdf>");
  const Scene scene =
      load(world("<model name='lamp'>" + include("sun.sdf") + "</model>" + model("m", box("visual", "v"))));
  EXPECT_THAT(names(scene), ElementsAre("m::l::v"));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(SdfWorldsTest, AFolderOfTheModelsNameDoesNotHideTheModelPath) {
  write("elsewhere/tank/model.sdf", model_file("tank"));
  write("elsewhere/tank/hull.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::filesystem::create_directories(folder / "tank/hull.obj");
  setenv("GAZEBO_RESOURCE_PATH", (folder / "elsewhere").c_str(), 1);
  const std::string mesh = part("visual", "v", "<mesh><uri>model://tank/hull.obj</uri></mesh>");
  const Scene scene = load_file(write("tank/tank.world", world(include("model://tank") + model("m", mesh))));
  EXPECT_THAT(names(scene), testing::UnorderedElementsAre("tank::l::v", "m::l::v"));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(SdfWorldsTest, OneWarningListsWhatIsMissingAndTheRestIsInsonified) {
  write("bad.stl", "no mesh");
  write("broken/model.sdf", "<sdf version='1.6'>\n<model>");
  const std::string text = world(
      include("model://rock") + include("model://broken") +
      model("m", box("visual", "v") + "\n" + part("visual", "w", "<mesh><uri>model://rock/rock.dae</uri></mesh>") +
                     "\n" + part("visual", "x", "<heightmap><uri>sea.tif</uri></heightmap>")));
  write("sea.tif", "II*");
  EXPECT_THAT(names(load(text)), ElementsAre("m::l::v"));
  ASSERT_EQ(said.size(), 1);
  EXPECT_THAT(said[0], testing::StartsWith("scene.sdf: 4 parts of the world are skipped (an error with strict: true): "
                                           "scene.sdf:2:10: include 'model://rock', scene.sdf:5:1: visual 'm::l::w': "
                                           "'model://rock/rock.dae'" +
                                           std::string(kPlace) + "; scene.sdf:3:10: include 'model://broken': "));
  EXPECT_THAT(said[0], HasSubstr("broken/model.sdf:2:"));
  EXPECT_THAT(said[0], HasSubstr("visual 'm::l::x': sea.tif: "));
  EXPECT_THAT(error_of(text), testing::StartsWith("scene.sdf:2:10: include 'model://rock'" + std::string(kPlace)));
}

TEST_F(SdfWorldsTest, NothingLeftIsAnError) {
  EXPECT_EQ(error_of_file(write("scene.sdf", world(include("model://rock"))), {}),
            "scene.sdf: nothing is left to insonify: scene.sdf:2:10: include 'model://rock'" + std::string(kPlace));
  EXPECT_EQ(error_of_file(write("scene.sdf", world(model("m", box("visual", "v")))), {.ignore = {"v"}}),
            "scene.sdf: there is no visual to insonify except what `ignore` removes");
}

TEST_F(SdfWorldsTest, AFaultyJointCostsNoShapes) {
  const std::string joint = "\n<joint name='j' type='fixed'><parent>mast</parent><child>l</child></joint>";
  const std::string text = world(model("m", box("visual", "v"), joint));
  EXPECT_THAT(names(load(text)), ElementsAre("m::l::v"));
  ASSERT_EQ(said.size(), 1);
  EXPECT_THAT(said[0],
              testing::StartsWith("scene.sdf: 1 part of the world is skipped (an error with strict: true): "
                                  "scene.sdf:3:1: parent frame with name[mast] specified by joint with name[j]"));
  EXPECT_THAT(error_of(text), HasSubstr("mast"));
}

TEST_F(SdfWorldsTest, AWorldOfNothingButFaultsIsAnError) {
  const std::string text = world("<model name='m'><link name='l'><pose>1 2 x 0 0 0</pose></link></model>");
  EXPECT_EQ(error_of_file(write("scene.sdf", text), {}),
            "scene.sdf: nothing is left to insonify: scene.sdf:2:32: <pose> = '1 2 x 0 0 0' must be 6 finite numbers");
}

TEST_F(SdfWorldsTest, PatternsLeaveOutModelsLinksAndVisuals) {
  const std::string text = world(model("water_surface_2", box("visual", "v")) + model("box_walls", box("visual", "v")) +
                                 model("m", box("visual", "keel") + box("visual", "deck")));
  const Scene scene = load(text, {.ignore = {"water_surface*", "box_walls", "m::l::d?ck", "mast"}});
  EXPECT_THAT(names(scene), ElementsAre("m::l::keel"));
  EXPECT_THAT(said, ElementsAre("scene.sdf: ignore: 'mast' is the name of nothing in the world"));
}

TEST_F(SdfWorldsTest, AScenarioHasTheSameOptions) {
  write("scene.sdf", world(model("m", box("visual", "v")) + model("wall", box("visual", "v"))));
  const Scenario scenario =
      load_scenario(write("s.yaml", "world: scene.sdf\nstrict: true\nignore: [wa*, other]\nsonars: [{name: fls}]\n"));
  EXPECT_EQ(world_options(scenario), (WorldOptions{.strict = true, .ignore = {"wa*", "other"}}));
  EXPECT_THAT(names(load_scene(scenario)), ElementsAre("m::l::v"));
  EXPECT_THAT(to_yaml(scenario), HasSubstr("wa*"));
  EXPECT_EQ(
      without_folder(message_of([&] {
        static_cast<void>(load_scenario(write("s.yaml", "world: scene.sdf\nignore: wall\nsonars: [{name: fls}]\n")));
      })),
      "s.yaml:2:1: ignore = \"wall\" must be a list of texts");
}

TEST_F(SdfWorldsTest, ModelsWithoutVisualsAreTheirCollisionShapes) {
  const Scene scene =
      load(world(model("post", box("collision", "c")) + model("m", box("visual", "v") + box("collision", "c"))));
  EXPECT_THAT(names(scene), ElementsAre("post::l::c", "m::l::v"));
  EXPECT_THAT(said, ElementsAre("scene.sdf: of models without visuals the collision shapes are insonified (ignore "
                                "removes them): post"));
}

std::string sheet(const std::string& name, const std::string& look, const std::string& size = "60 60 0.1") {
  return fmt::format("<visual name='{}'><geometry><box><size>{}</size></box></geometry>{}</visual>\n", name, size,
                     look);
}
const std::string kOfWater = "<material><script><name>UUVSimulator/StaticWater</name></script></material>";

TEST_F(SdfWorldsTest, WaterIsLeftOutWhicheverWayItIsMarked) {
  const std::string plane =
      "<visual name='v'><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>{}</visual>";
  const std::string ball = model("ball", box("visual", "v"));
  const auto with_look = [&](const std::string& look) {
    return world(ball + model("m", fmt::format(fmt::runtime(plane), look)));
  };
  for (const std::string look : {"<transparency>0.9</transparency>", "<transparency>1</transparency>",
                                 "<material><diffuse>0 0 1 0.3</diffuse></material>", kOfWater.c_str()}) {
    EXPECT_THAT(names(load(with_look(look))), ElementsAre("ball::l::v")) << look;
    EXPECT_THAT(said, ElementsAre("scene.sdf: left out as water (keep_water: true keeps it): m::l::v")) << look;
    EXPECT_THAT(names(load(with_look(look), {.keep_water = true})), ElementsAre("ball::l::v", "m::l::v")) << look;
    EXPECT_THAT(said, IsEmpty()) << look;
  }
  EXPECT_EQ(load(with_look("<material><diffuse>0 0 1 1</diffuse></material>")).instances.size(), 2U);
  for (const std::string name : {"ocean", "sea_surface", "water", "waves", "Ocean_2", "WaterSurface", "sea"}) {
    EXPECT_THAT(names(load(world(ball + model(name, box("visual", "visual"))))), ElementsAre("ball::l::v")) << name;
    EXPECT_THAT(names(load(world(ball + model(name, box("collision", "c"))))), ElementsAre("ball::l::v")) << name;
  }
  EXPECT_EQ(error_of(world(model("ocean", box("visual", "v")))),
            "scene.sdf: there is no visual to insonify except water (keep_water: true keeps it): ocean::l::v");
}

TEST_F(SdfWorldsTest, WhatIsNamedAfterWaterIsNoWater) {
  for (const std::string name :
       {"water_tank", "seabed", "sea_floor", "ocean_explorer", "underwater_rock", "waverider"}) {
    EXPECT_EQ(load(world(model(name, box("visual", "v")))).instances.size(), 1U) << name;
    EXPECT_THAT(said, IsEmpty()) << name;
  }
  EXPECT_THAT(names(load(world(model("ocean", box("visual", "bottom") + box("visual", "surface"))))),
              ElementsAre("ocean::l::bottom"));
  EXPECT_EQ(load(world(model("m", sheet("pane", "<transparency>0.9</transparency>", "2 0.1 2")))).instances.size(), 1U)
      << "a window stands";
}

TEST_F(SdfWorldsTest, WaterAndInvisibleWallsAreTold) {
  const std::string text =
      world(model("sea", sheet("surface", kOfWater) + sheet("wall", "<transparency>1</transparency>", "60 0.1 60") +
                             sheet("bed",
                                   "<transparency>0.5</transparency><material><script><name>Sand</name></script>"
                                   "</material>")));
  EXPECT_THAT(names(load(text)), ElementsAre("sea::l::wall", "sea::l::bed"));
  EXPECT_THAT(said, ElementsAre("scene.sdf: left out as water (keep_water: true keeps it): sea::l::surface",
                                "scene.sdf: what is invisible to cameras echoes as a solid surface (ignore removes "
                                "it): sea::l::wall"));
  EXPECT_THAT(names(load(text, {.ignore = {"surface", "wall"}})), ElementsAre("sea::l::bed"));
  EXPECT_THAT(said, IsEmpty());
}

TEST_F(SdfWorldsTest, FilesOfOtherFormatsComeWithTheCommandThatConvertsThem) {
  write("meshes/hull.osgb", "osg");
  const std::string hull = "<geometry><mesh><uri>meshes/hull.osgb</uri></mesh></geometry>";
  const std::string ship = world(model("ship", "<visual name='plate'>" + hull + "</visual>"));
  const std::string fault =
      "scene.sdf:2:56: visual 'ship::l::plate': meshes/hull.osgb: OpenSceneGraph's files are not read; convert "
      "it: osgconv hull.osgb hull.obj";
  EXPECT_EQ(error_of(ship), fault);

  // The collision of its link stands for it.
  const Scene scene = load(world(model("ship", "<visual name='plate'>" + hull + "</visual>" + box("collision", "c"))));
  EXPECT_THAT(names(scene), ElementsAre("ship::l::c"));
  EXPECT_THAT(said, ElementsAre("scene.sdf: 1 part of the world is skipped (an error with strict: true): " + fault,
                                "scene.sdf: of links whose visuals cannot be read the collision shapes are insonified "
                                "(ignore removes it): ship::l"));

  write("meshes/hull.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(names(load(ship)), ElementsAre("ship::l::plate"));
  EXPECT_THAT(said, ElementsAre("meshes/hull.osgb: OpenSceneGraph's files are not read; hull.obj beside it is"));
}

// libsdformat takes 2.5 MB for each model.
TEST_F(SdfWorldsTest, EqualModelsAreReadOnce) {
  write("buoy/model.sdf", model_file("buoy"));
  const auto placed = [](const std::string& name, int x) {
    return fmt::format(
        "<model name='{}'><static>true</static><pose>{} 0 0 0 0 1</pose><link name='l'>{}</link></model>", name, x,
        box("visual", "v"));
  };
  const auto buoy = [](const std::string& name, int x) {
    return fmt::format("<include><uri>buoy</uri><name>{}</name><pose>{} 0 0 0 0 0</pose></include>", name, x);
  };
  const Scene scene = load(world(placed("a", 1) + buoy("b", 2) + placed("c", 3) + model("d", box("visual", "w")) +
                                 buoy("e", 5) + placed("f", 6)));
  EXPECT_THAT(names(scene), ElementsAre("a::l::v", "b::l::v", "c::l::v", "d::l::w", "e::l::v", "f::l::v"))
      << "in the order of the file";
  EXPECT_THAT(scene.instances[2].world_from_mesh.position, Near3(Vec3(3, 0, 0), kPoseError));
  EXPECT_NEAR(scene.instances[2].world_from_mesh.orientation.angularDistance(orientation_from_rpy(0, 0, 1)), 0, 1e-9);
  EXPECT_THAT(scene.instances[4].world_from_mesh.position, Near3(Vec3(5, 0, 0), kPoseError));
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[5].mesh);

  std::string many;
  for (int i = 0; i < 3000; ++i) {
    many += placed(fmt::format("m{}", i), i);
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(load(world(many)).instances.size(), 3000U);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << "minutes, if each were parsed";
}

TEST_F(SdfWorldsTest, EqualModelsThatAreReferredToKeepTheirPlaces) {
  const std::string relative =
      "<model name='b'><static>true</static><pose relative_to='a'>1 0 0 0 0 0</pose><link name='l'>" +
      box("visual", "v") + "</link></model>";
  const Scene scene = load("<sdf version='1.9'><world name='w'>" +
                           model("a", box("visual", "v"), "<pose>5 0 0 0 0 0</pose>") + relative + "</world></sdf>");
  EXPECT_THAT(scene.instances.at(1).world_from_mesh.position, Near3(Vec3(6, 0, 0), kPoseError));
}

TEST_F(SdfWorldsTest, DroppedTrianglesAreToldWithTheWholePath) {
  write("meshes/hull.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n");
  load(sdf_of("<mesh><uri>meshes/hull.obj</uri></mesh>"));
  EXPECT_THAT(said, ElementsAre("meshes/hull.obj: 1 of 2 triangles dropped (1 of zero area)"));
}

TEST_F(SdfWorldsTest, FuelModelsComeFromTheCachesOfGazebo) {
  write("home/.ignition/fuel/fuel.ignitionrobotics.org/openrobotics/models/big rock/2/model.sdf", model_file("old"));
  write("home/.ignition/fuel/fuel.ignitionrobotics.org/openrobotics/models/big rock/10/model.sdf", model_file("new"));
  const std::string uri = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Big%20Rock";
  EXPECT_THAT(names(load(world(include(uri)))), ElementsAre("new::l::v"));
  EXPECT_THAT(names(load(world(include(uri + "/tip")))), ElementsAre("new::l::v"));
  EXPECT_THAT(names(load(world(include(uri + "/2")))), ElementsAre("old::l::v"));
  write("cache/fuel.gazebosim.org/openrobotics/models/big rock/1/model.sdf", model_file("mine"));
  write("cache/fuel.gazebosim.org/openrobotics/models/big rock/1/r.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  setenv("GZ_FUEL_CACHE_PATH", (folder / "cache").c_str(), 1);
  EXPECT_THAT(names(load(world(include(uri)))), ElementsAre("mine::l::v"));
  EXPECT_THAT(names(load(sdf_of("<mesh><uri>" + uri + "/1/files/r.obj</uri></mesh>"))),
              ElementsAre("ship::hull::plate"));
}

TEST_F(SdfWorldsTest, AbsentFuelModelsAreOneListWithTheCommandThatFetchesThem) {
  const std::string owner = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  const std::string mesh = part("visual", "w", "<mesh><uri>" + owner + "Reef/3/files/meshes/reef.dae</uri></mesh>");
  load(world(include(owner + "Big%20Rock") + include(owner + "Reef/3") + model("m", box("visual", "v") + mesh)));
  EXPECT_THAT(said, ElementsAre("scene.sdf: 3 parts of the world are skipped (an error with strict: true): "
                                "scene.sdf:2:10: include '" +
                                    owner + "Big%20Rock', scene.sdf:3:10: include '" + owner +
                                    "Reef/3', scene.sdf:4:129: visual 'm::l::w': '" + owner +
                                    "Reef/3/files/meshes/reef.dae' is not in the caches of Fuel (home/.gz/fuel, "
                                    "home/.ignition/fuel)",
                                "scene.sdf: to download missing Fuel models: for u in '" + owner + "Big%20Rock' '" +
                                    owner + "Reef/3'; do gz fuel download -u \"$u\"; done"));
}

// A message ends at 2000 bytes: no command may be cut, and no URI may be lost.
TEST_F(SdfWorldsTest, ManyAbsentFuelModelsAreAllInTheCommands) {
  std::string includes;
  for (int i = 100; i < 160; ++i) {
    includes += include(fmt::format("https://fuel.gazebosim.org/1.0/owner/models/Model{}", i));
  }
  load(world(includes + model("m", box("visual", "v"))));
  ASSERT_GT(said.size(), 2);
  EXPECT_THAT(said[0], HasSubstr("60 parts of the world"));
  EXPECT_THAT(said[0], HasSubstr(" more is not in the caches of Fuel"));
  std::string commands;
  for (std::size_t i = 1; i < said.size(); ++i) {
    EXPECT_THAT(said[i], testing::EndsWith("'; do gz fuel download -u \"$u\"; done"));
    commands += said[i];
  }
  for (int i = 100; i < 160; ++i) {
    EXPECT_THAT(commands, HasSubstr(fmt::format("/Model{}'", i)));
  }
}

}  // namespace
}  // namespace insonify::sdf_worlds_test
