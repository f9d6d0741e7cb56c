// mesh_parts_test.cpp -- named parts of mesh files in SDF worlds, Stonefish scenarios and worlds that run.

#include "insonify/world_parts.h"
#include "io/sdf_files.h"

namespace insonify::mesh_parts_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class MeshPartsTest : public SdfTest {
 protected:
  MeshPartsTest() {
    write("ship.obj",
          "o hull\nv 0 0 0\nv 2 0 0\nv 0 3 0\nusemtl steel\nf 1 2 3\no mast\nv 1 0 0\nv 1 4 0\nv 1 0 8\n"
          "usemtl wood\nf 4 5 6\n");
  }

  // A world of one model at (10, 20, 30) whose visuals have these geometries.
  static std::string world_of(const std::vector<std::string>& meshes, const std::string& more = "") {
    std::string visuals;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      visuals += fmt::format("<visual name='v{}'><geometry><mesh><uri>ship.obj</uri>{}</mesh></geometry>{}</visual>", i,
                             meshes[i], more);
    }
    return "<sdf version='1.9' xmlns:insonify='https://insonify.org/sdf'><world name='w'><model name='m'>"
           "<pose>10 20 30 0 0 0</pose><link name='l'>" +
           visuals + "</link></model></world></sdf>";
  }
};

TEST_F(MeshPartsTest, AVisualIsAnObjectUnlessPartsAreAskedFor) {
  EXPECT_THAT(names(load(world_of({""}))), ElementsAre("m::l::v0"));
}

TEST_F(MeshPartsTest, PartsOfAVisualAreNamedBehindIt) {
  const Scene scene = load(world_of({"", "<scale>1 1 2</scale>", ""}), WorldOptions{.parts = true});
  EXPECT_THAT(said, IsEmpty());
  EXPECT_THAT(names(scene), ElementsAre("m::l::v0::hull", "m::l::v0::mast", "m::l::v1::hull", "m::l::v1::mast",
                                        "m::l::v2::hull", "m::l::v2::mast"));
  EXPECT_THAT(scene.instances[0].mesh->material_names, ElementsAre("steel"));
  EXPECT_THAT(scene.instances[1].mesh->material_names, ElementsAre("wood"));
  EXPECT_EQ(scene.instances[1].world_from_mesh.position, Vec3(10, 20, 30));
  EXPECT_EQ(scene.instances[1].mesh->vertices[2], Vec3f(1, 0, 8));
  EXPECT_EQ(scene.instances[3].mesh->vertices[2], Vec3f(1, 0, 16));
  EXPECT_EQ(scene.instances[4].mesh, scene.instances[0].mesh);
  EXPECT_EQ(scene.find_instance("m::l::v0::mast"), 1);
}

TEST_F(MeshPartsTest, ASubmeshIsOneObject) {
  const Scene scene = load(world_of({"<submesh><name>mast</name></submesh>"}), WorldOptions{.parts = true});
  EXPECT_THAT(names(scene), ElementsAre("m::l::v0"));
  EXPECT_EQ(scene.triangle_count(), 1U);
}

TEST_F(MeshPartsTest, PatternsIgnoreParts) {
  EXPECT_THAT(names(load(world_of({"", ""}), WorldOptions{.ignore = {"m::l::v0::hull"}, .parts = true})),
              ElementsAre("m::l::v0::mast", "m::l::v1::hull", "m::l::v1::mast"));
  EXPECT_THAT(names(load(world_of({"", ""}), WorldOptions{.ignore = {"mast"}, .parts = true})),
              ElementsAre("m::l::v0::hull", "m::l::v1::hull"));
}

TEST_F(MeshPartsTest, MaterialsGoByPartUnlessTheVisualHasOne) {
  Scene scene = load(world_of({"", ""}), WorldOptions{.parts = true});
  assign_materials(scene, {.overrides = {{"mast", {.like = "rubber"}}}, .default_material = "rock"});
  const auto material = [&](int i) { return scene.materials[scene.instances[i].materials[0]].name; };
  EXPECT_EQ(material(0), "steel");
  EXPECT_EQ(material(1), "mast");
  Scene own = load(world_of({""}, "<insonify:material>concrete</insonify:material>"), WorldOptions{.parts = true});
  assign_materials(own, {});
  EXPECT_EQ(own.materials[own.instances[1].materials[0]].name, "concrete");
}

TEST_F(MeshPartsTest, AFileThatIsMissingIsSkippedAsEver) {
  write("scene.sdf", "");
  std::string broken = world_of({"", ""});
  broken.replace(broken.find("ship.obj"), 8, "gone.obj");
  EXPECT_THAT(names(load(broken, WorldOptions{.parts = true})), ElementsAre("m::l::v1::hull", "m::l::v1::mast"));
  EXPECT_THAT(said, ElementsAre(testing::HasSubstr("visual 'm::l::v0': 'gone.obj'")));
}

TEST_F(MeshPartsTest, BodiesOfStonefishHavePartsToo) {
  const auto path = write("pool.scn",
                          "<scenario><static name='s' type='model'><visual><mesh filename='ship.obj' scale='2'/>"
                          "<origin xyz='0 0 0' rpy='0 0 0'/></visual><material name='Steel'/>"
                          "<world_transform xyz='1 2 3' rpy='0 0 0'/></static></scenario>");
  const Scene scene = load_file(path, {.parts = true});
  EXPECT_THAT(names(scene), ElementsAre("s::hull", "s::mast"));
  EXPECT_THAT(scene.instances[1].mesh->material_names, ElementsAre("Steel"));
  EXPECT_EQ(scene.instances[1].mesh->vertices[2], Vec3f(2, 0, 16));
  EXPECT_THAT(names(load_file(path, {.ignore = {"hull"}, .parts = true})), ElementsAre("s::mast"));
  EXPECT_THAT(names(load_file(path)), ElementsAre("s"));
}

TEST_F(MeshPartsTest, AVisualOfARunningWorldIsOneObject) {
  std::vector<std::string> lines;
  WorldParts maker(scratch.path() / "base.yaml", {.parts = true},
                   [&](Severity, const std::string& line) { lines.push_back(line); });
  const Scene scene =
      maker.scene({{{.name = "a", .shape = {.kind = ShapeKind::kMesh, .uri = "ship.obj"}, .world_from_part = {}}}},
                  "the world tank");
  EXPECT_THAT(names(scene), ElementsAre("a"));
  EXPECT_THAT(lines, ElementsAre("the world tank: parts has no effect: a visual is one object"));
}

}  // namespace
}  // namespace insonify::mesh_parts_test
