// sdf_uri_test.cpp -- which file a URI means, and in which order folders are tried.

#include "io/world/sdf_uri.h"

#include "io/file/scene_folders.h"
#include "io/sdf_files.h"

namespace insonify::sdf_uri_test {
namespace {

class SdfUriTest : public SdfTest {
 protected:
  [[nodiscard]] std::string find(const std::string& uri, const std::string& base) const {
    const SceneFolders scene(folder / "world.sdf");
    const auto found = find_sdf_uri(uri, folder / base);
    return found ? without_folder(found->string()) : "nothing";
  }
};

TEST_F(SdfUriTest, FindsRelativePathsBesideTheFileBeforeFoldersAbove) {
  write("ship/hull.obj", "");
  write("hull.obj", "");
  write("common/plate.obj", "");
  EXPECT_EQ(find("hull.obj", "ship/model.sdf"), "ship/hull.obj");
  EXPECT_EQ(find("../hull.obj", "ship/model.sdf"), "hull.obj");
  EXPECT_EQ(find("common/plate.obj", "ship/deep/model.sdf"), "common/plate.obj");
}

TEST_F(SdfUriTest, FindsModelsBesideTheirOwnFolderAndInFoldersCalledModels) {
  write("fleet/ship/model.config", "");
  write("fleet/ship/meshes/hull.obj", "");
  write("models/buoy/model.sdf", "");
  EXPECT_EQ(find("model://ship/meshes/hull.obj", "fleet/ship/model.sdf"), "fleet/ship/meshes/hull.obj");
  EXPECT_EQ(find("package://ship/meshes/hull.obj", "fleet/ship/model.sdf"), "fleet/ship/meshes/hull.obj");
  EXPECT_EQ(find("model://buoy", "worlds/harbour.world"), "models/buoy");
  EXPECT_EQ(find("buoy", "worlds/harbour.world"), "nothing");
}

TEST_F(SdfUriTest, TakesNothingAfterAModelSchemeForAbsolute) {
  write("ship/hull.obj", "");
  EXPECT_EQ(find("model:///ship/hull.obj", "world.sdf"), "ship/hull.obj");
}

TEST_F(SdfUriTest, TakesFileUrisForPaths) {
  const std::string path = write("ship/hull.obj", "");
  EXPECT_EQ(find("file://" + path, "other/model.sdf"), "ship/hull.obj");
  EXPECT_EQ(find(path, "other/model.sdf"), "ship/hull.obj");
  EXPECT_EQ(find("file://ship/hull.obj", "world.sdf"), "ship/hull.obj");
}

TEST_F(SdfUriTest, SearchesThePathListsInOrder) {
  const std::vector<const char*> lists = {"GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "IGN_GAZEBO_RESOURCE_PATH",
                                          "GZ_SIM_RESOURCE_PATH", "SDF_PATH",          "INSONIFY_MODEL_PATH"};
  EXPECT_EQ(find("model://ship", "world.sdf"), "nothing");
  for (const char* list : lists) {  // each is tried before those set so far
    write(fmt::format("{}/ship/model.sdf", list), "");
    setenv(list, fmt::format("/nowhere::{}", (folder / list).string()).c_str(), 1);
    EXPECT_EQ(find("model://ship", "world.sdf"), fmt::format("{}/ship", list));
  }
  write("ship/model.sdf", "");
  EXPECT_EQ(find("model://ship", "world.sdf"), "ship");
}

TEST_F(SdfUriTest, SaysWhyNothingWasFound) {
  EXPECT_EQ(find("https://fuel.gazebosim.org/ship", "world.sdf"), "nothing");
  EXPECT_EQ(sdf_uri_not_found("https://fuel.gazebosim.org/ship", folder / "world.sdf"),
            "is not on this machine: fetch it and name its folder");
  EXPECT_EQ(sdf_uri_not_found("model://", folder / "world.sdf"), "names nothing");
  EXPECT_EQ(sdf_uri_not_found("/no/such/file", folder / "world.sdf"), "does not exist");
  EXPECT_EQ(sdf_uri_not_found("model://ship", folder / "world.sdf"),
            "not found beside this file, in the folders above it or in those of INSONIFY_MODEL_PATH, SDF_PATH, "
            "GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH");
}

TEST_F(SdfUriTest, NamesTheCommandThatMakesTheMeshesOfTheShippedScenes) {
  write("make/CMakeLists.txt", "");
  EXPECT_EQ(sdf_uri_not_found("meshes/ferry.obj", folder / "world.sdf"),
            "not made yet; this makes it: cmake --build build/release --target scene_meshes");
  EXPECT_THAT(sdf_uri_not_found("ferry.obj", folder / "world.sdf"), testing::StartsWith("not found beside this file"));
}

}  // namespace
}  // namespace insonify::sdf_uri_test
