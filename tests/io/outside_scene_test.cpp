// outside_scene_test.cpp -- a scene names files beside and below it and in named folders of models, and no others.

#include <stdlib.h>

#include "io/file/scene_folders.h"
#include "io/mesh_texts.h"
#include "io/sdf_files.h"

namespace insonify::outside_scene_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kOutside = " lies outside of the scene's folder and of those that INSONIFY_MODEL_PATH names";

// What a stranger's scene, in the folder in/, must not read: out/.
class OutsideSceneTest : public SdfTest {
 protected:
  OutsideSceneTest() {
    write("out/x.obj", kTriangle);
    write("out/ship/model.sdf", sdf_of("<box><size>1 1 1</size></box>"));
    write("out/bed.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 1\n2 3\n");
    std::filesystem::create_directories(folder / "in/models");
    std::filesystem::create_symlink("../../out/x.obj", folder / "in/models/link.obj");
    std::filesystem::create_directory_symlink("../out", folder / "in/linked");
    std::filesystem::create_directories(folder / "in/..%2fout");  // Its name needs no decoding.
  }

  std::string error_with(const std::string& geometry) { return error_of_file(write("in/scene.sdf", sdf_of(geometry))); }
  std::vector<std::string> names_with(const std::string& geometry) {
    return names(load_file(write("in/scene.sdf", sdf_of(geometry)), {.strict = true}));
  }
};

TEST_F(OutsideSceneTest, UrisOfSdfFilesDoNotLeadThere) {
  for (const std::string uri :
       {"../out/x.obj", "file://../out/x.obj", "%2e%2e/out/x.obj", "..%2Fout%2Fx.obj", "model://../out/x.obj",
        "model://models/../../out/x.obj", "package://out/x.obj", "my_scheme://out/x.obj", "out/x.obj",
        "models/link.obj", "model://link.obj", "linked/x.obj", "file://linked/x.obj"}) {
    EXPECT_EQ(error_with("<mesh><uri>" + uri + "</uri></mesh>"),
              "in/scene.sdf:4:1: visual 'ship::hull::plate': '" + uri + "'" + kOutside)
        << uri;
  }
  for (const std::string& uri : {(folder / "out/x.obj").string(), "file://" + (folder / "out/x.obj").string()}) {
    EXPECT_THAT(error_with("<mesh><uri>" + uri + "</uri></mesh>"), HasSubstr("x.obj'" + kOutside)) << uri;
  }
  EXPECT_THAT(error_with("<heightmap><uri>../out/bed.asc</uri></heightmap>"), HasSubstr("'../out/bed.asc'" + kOutside));
  const std::string include = "<sdf version='1.9'><world name='w'><include><uri>{}</uri></include></world></sdf>";
  for (const std::string uri : {"../out/ship", "../out/ship/model.sdf", "file:///etc/passwd"}) {
    EXPECT_THAT(error_of_file(write("in/w.sdf", fmt::format(fmt::runtime(include), uri))),
                HasSubstr(uri + "'" + kOutside))
        << uri;
  }
}

TEST_F(OutsideSceneTest, WhatIsWrittenThereIsNotQuoted) {
  write("out/secret.sdf", "<sdf version='1.9'><password>of the user</password>");
  const std::string include =
      "<sdf version='1.9'><world name='w'><include><uri>../out/secret.sdf</uri></include></world></sdf>";
  EXPECT_THAT(error_of_file(write("in/w.sdf", include)), testing::Not(HasSubstr("of the user")));
}

TEST_F(OutsideSceneTest, FoldersThatTheUserNamesAreRead) {
  for (const char* list : {"INSONIFY_MODEL_PATH", "SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH",
                           "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH", "AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH"}) {
    for (const std::string end : {"", "/"}) {
      setenv(list, ("/nowhere:" + (folder / "out").string() + end).c_str(), 1);
      EXPECT_THAT(names_with("<mesh><uri>../out/x.obj</uri></mesh>"), ElementsAre("ship::hull::plate")) << list;
      unsetenv(list);
    }
  }
  // There links lead wherever they lead, as colcon installs them.
  setenv("GZ_SIM_RESOURCE_PATH", (folder / "in/linked").c_str(), 1);
  EXPECT_THAT(names_with("<mesh><uri>model://x.obj</uri></mesh>"), ElementsAre("ship::hull::plate"));
  unsetenv("GZ_SIM_RESOURCE_PATH");
  EXPECT_THAT(error_with("<mesh><uri>../out/x.obj</uri></mesh>"), HasSubstr(kOutside));
}

TEST_F(OutsideSceneTest, ModelsAndPackagesAreWhole) {
  // The package that the scene is in.
  write("rov/package.xml", "<package/>");
  write("rov/meshes/b.obj", kTriangle);
  const std::string beside = write("rov/worlds/w.sdf", sdf_of("<mesh><uri>../meshes/b.obj</uri></mesh>"));
  EXPECT_THAT(names(load_file(beside)), ElementsAre("ship::hull::plate"));
  // A model by its name, and no further than its folder.
  write("fleet/ship/model.config", "<model/>");
  write("fleet/ship/meshes/b.obj", kTriangle);
  write("fleet/secret.obj", kTriangle);
  for (const std::string uri : {"model://ship/meshes/b.obj", "model://ship/../secret.obj"}) {
    const std::string file = write("fleet/worlds/w.sdf", sdf_of("<mesh><uri>" + uri + "</uri></mesh>"));
    EXPECT_EQ(error_of_file(file).find(kOutside) == std::string::npos, uri == "model://ship/meshes/b.obj") << uri;
  }
  // A scene that is a link belongs to what it links to as well.
  std::filesystem::create_directories(folder / "install/share/rov/worlds");
  std::filesystem::create_symlink(folder / "rov/worlds/w.sdf", folder / "install/share/rov/worlds/w.sdf");
  std::filesystem::create_directories(folder / "install/share/rov/meshes");
  std::filesystem::create_symlink(folder / "rov/meshes/b.obj", folder / "install/share/rov/meshes/b.obj");
  EXPECT_THAT(names(load_file((folder / "install/share/rov/worlds/w.sdf").string())), ElementsAre("ship::hull::plate"));
}

TEST_F(OutsideSceneTest, ModelsOfASceneMayNameEachOther) {
  write("in/meshes/hull.obj", kTriangle);
  write("in/ships/ship/model.sdf", sdf_of("<mesh><uri>../../meshes/hull.obj</uri></mesh>"));
  const std::string world =
      write("in/w.sdf", "<sdf version='1.9'><world name='w'><include><uri>ships/ship</uri></include></world></sdf>");
  EXPECT_THAT(names(load_file(world, {.strict = true})), ElementsAre("ship::hull::plate"));
  EXPECT_THAT(message_of([&] { (void)load_scene(folder / "in/ships/ship/model.sdf", {.strict = true}); }),
              HasSubstr("'../../meshes/hull.obj'" + kOutside));
  // What lies beside or below the scenario is the scene's too.
  const Scenario scenario =
      load_scenario(write("in/s.yaml", "world: ships/ship/model.sdf\nstrict: true\nsonars: [{max_range: 8}]\n"));
  EXPECT_EQ(load_scene(scenario).instances.size(), 1U);
}

TEST_F(OutsideSceneTest, BuffersOfGltfDoNotLieThere) {
  const std::string buffer = gltf_buffer();
  write("out/x.bin", buffer);
  std::filesystem::create_symlink("../out/x.bin", folder / "in/link.bin");
  for (const std::string& uri :
       {std::string("../out/x.bin"), std::string("%2e%2e/out/x.bin"), std::string("..%2Fout%2Fx.bin"),
        std::string("link.bin"), std::string("linked/x.bin"), (folder / "out/x.bin").string()}) {
    const std::string file = write("in/a.gltf", gltf_text(uri));
    EXPECT_THAT(without_folder(message_of([&] { (void)load_mesh(file); })),
                testing::MatchesRegex("in/a\\.gltf: '[^']*(x|link)\\.bin'" + kOutside))
        << uri;
  }
  // Within a scene it may be above the mesh.
  write("in/textures/x.bin", buffer);
  write("in/meshes/a.gltf", gltf_text("../textures/x.bin"));
  EXPECT_THAT(names_with("<mesh><uri>meshes/a.gltf</uri></mesh>"), ElementsAre("ship::hull::plate"));
  EXPECT_THAT(message_of([&] { (void)load_mesh(folder / "in/meshes/a.gltf"); }), HasSubstr(kOutside));
}

TEST_F(OutsideSceneTest, LibrariesOfObjFilesDoNotLieThere) {
  write("out/x.mtl", "newmtl steel\n");
  const std::string file = write("in/a.obj", "mtllib ../out/x.mtl\nusemtl steel\n" + kTriangle);
  std::vector<std::string> warnings;
  const Mesh mesh =
      load_mesh(file, [&](Severity, const std::string& line) { warnings.push_back(without_folder(line)); });
  EXPECT_EQ(mesh.triangles.size(), 1U);
  EXPECT_THAT(warnings, ElementsAre(testing::MatchesRegex("in/a\\.obj: '.*out/x\\.mtl'" + kOutside)));
}

}  // namespace
}  // namespace insonify::outside_scene_test
