// mesh_read_ahead_test.cpp -- meshes that are read while their world is parsed are those of reading them one by one.

#include "io/mesh/mesh_read_ahead.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "io/loaded_mesh.h"
#include "io/mesh_texts.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::mesh_read_ahead_test {
namespace {

using testing::ElementsAre;

class MeshReadAheadTest : public testing::Test {
 protected:
  const WorkingFolder folder;
};

TEST_F(MeshReadAheadTest, AFileIsTakenOnceWithItsMessages) {
  folder.write("corner.obj", obj_text() + "f 1 1 2\n");
  std::vector<std::string> lines;
  const Log log = [&](Severity, const std::string& line) { lines.push_back(line); };

  MeshReadAhead ahead;
  ASSERT_EQ(MeshReadAhead::current(), &ahead);
  ahead.want("corner.obj", {});
  ahead.want("corner.obj", {});
  ahead.want("corner.obj", {.name = "", .center = true});
  EXPECT_EQ(ahead.take("other.obj", {}, log), std::nullopt);

  const std::optional<Mesh> mesh = ahead.take("corner.obj", {}, log);
  ASSERT_TRUE(mesh);
  expect_bounds(*mesh, {0, 0, 0}, {2, 3, 5});
  EXPECT_THAT(lines, ElementsAre(testing::StartsWith("corner.obj: 1 of 5 triangles dropped")));
  EXPECT_EQ(ahead.take("corner.obj", {}, log), std::nullopt);
  // Another part of the file, by the function that everybody calls.
  expect_bounds(load_mesh_file("corner.obj", {.name = "", .center = true}, {}), {-1, -1.5, -2.5}, {1, 1.5, 2.5});
}

TEST_F(MeshReadAheadTest, AnErrorComesWhereTheFileIsUsed) {
  folder.write("broken.obj", "v 0 0\nf 1 2 3\n");
  const std::string alone = message_of([] { static_cast<void>(load_mesh_file("broken.obj", {}, {})); });
  MeshReadAhead ahead;
  ahead.want("broken.obj", {});
  ahead.want("missing.obj", {});  // Never used.
  EXPECT_EQ(message_of([] { static_cast<void>(load_mesh_file("broken.obj", {}, {})); }), alone);
  EXPECT_THAT(alone, testing::StartsWith("broken.obj"));
}

TEST_F(MeshReadAheadTest, AWorldHasItsMeshesAndMessagesInItsOwnOrder) {
  std::string visuals;
  const std::vector<std::string> files = {"slow", "broken", "thin", "slow", "missing", "corner"};
  for (std::size_t i = 0; i < files.size(); ++i) {
    visuals +=
        fmt::format("<visual name='{}'><geometry><mesh><uri>{}.obj</uri></mesh></geometry></visual>", i, files[i]);
  }
  folder.write("w.sdf", "<sdf version='1.9'><model name='m'><link name='l'>" + visuals + "</link></model></sdf>");
  folder.write("corner.obj", obj_text());
  folder.write("thin.obj", obj_text() + "f 1 1 2\n");
  folder.write("broken.obj", "v 0 0\nf 1 2 3\n");
  std::string many;
  for (int i = 0; i < 20'000; ++i) {
    many += fmt::format("v {0} 0 0\nv {0} 1 0\nv {0} 0 1\nf -1 -2 -3\n", i);
  }
  folder.write("slow.obj", many + "f 1 1 2\n");

  std::vector<std::string> lines;
  const Scene scene = load_scene("w.sdf", {}, [&](Severity, const std::string& line) { lines.push_back(line); });
  std::vector<std::pair<std::string, std::size_t>> triangles;
  for (const Instance& instance : scene.instances) {
    triangles.emplace_back(instance.name, instance.mesh->triangles.size());
  }
  using testing::Pair;
  EXPECT_THAT(triangles,
              ElementsAre(Pair("m::l::0", 20'000), Pair("m::l::2", 4), Pair("m::l::3", 20'000), Pair("m::l::5", 4)));
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
  EXPECT_THAT(lines, ElementsAre(testing::HasSubstr("slow.obj: 1 of 20001 triangles dropped"),
                                 testing::HasSubstr("thin.obj: 1 of 5 triangles dropped"),
                                 testing::AllOf(testing::HasSubstr("broken.obj"), testing::HasSubstr("missing.obj"))));
}

}  // namespace
}  // namespace insonify::mesh_read_ahead_test
