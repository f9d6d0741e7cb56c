// assign_materials_test.cpp -- the rules by which surfaces get their materials, and their messages.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/scene.h"
#include "support/message_of.h"

namespace insonify::assign_materials_test {
namespace {

using testing::ElementsAre;

// An instance whose mesh calls its materials `slots`.
Instance instance(std::string name, std::vector<std::string> slots = {""}) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.material_names = std::move(slots);
  return {.name = std::move(name), .mesh = std::make_shared<Mesh>(std::move(mesh))};
}

Scene scene_with(std::vector<Instance> instances) {
  Scene scene;
  scene.instances = std::move(instances);
  return scene;
}

// Names of the materials of an instance's slots.
std::vector<std::string> names_of(const Scene& scene, std::size_t instance = 0) {
  std::vector<std::string> names;
  for (const std::uint16_t material : scene.instances[instance].materials) {
    names.push_back(scene.materials[material].name);
  }
  return names;
}

std::string fault(Scene scene, const MaterialRules& rules) {
  return message_of([&] { assign_materials(scene, rules); });
}

TEST(AssignMaterialsTest, TheLibrarysMaterialGoesByTheMeshsOwnName) {
  Scene scene = scene_with({instance("ship", {"Steel", "wood"}), instance("rock", {"granite", "steel"})});
  assign_materials(scene, {});
  EXPECT_THAT(names_of(scene, 0), ElementsAre("steel", "wood"));
  EXPECT_THAT(names_of(scene, 1), ElementsAre("granite", "steel"));
  EXPECT_EQ(scene.materials.size(), 3U);
}

TEST(AssignMaterialsTest, AnUnknownNameTakesTheDefault) {
  Scene scene = scene_with({instance("ship", {"paint_7", "steel", ""})});
  assign_materials(scene, {.default_material = "Mud"});
  EXPECT_THAT(names_of(scene), ElementsAre("mud", "steel", "mud"));
}

TEST(AssignMaterialsTest, SurfacesThatTookTheDefaultAreReportedInOneLine) {
  Scene scene = scene_with({instance("ship", {"paint_7", "steel", ""}), instance("rock", {"moss", "paint_7"})});
  std::vector<std::string> told;
  assign_materials(scene, {.default_material = "clay"}, [&](Severity severity, const std::string& line) {
    EXPECT_EQ(severity, Severity::kInfo);
    told.push_back(line);
  });
  EXPECT_THAT(
      told, ElementsAre("took clay for the materials that meshes call moss, paint_7, and for surfaces that name none"));
}

TEST(AssignMaterialsTest, OfManyNamesTwentyAreReported) {
  std::vector<std::string> names;
  for (int i = 100; i < 140; ++i) {
    names.push_back(std::to_string(i));
  }
  Scene scene = scene_with({instance("ship", names)});
  std::vector<std::string> told;
  assign_materials(scene, {}, [&](Severity, const std::string& line) { told.push_back(line); });
  ASSERT_EQ(told.size(), 1U);
  EXPECT_TRUE(told[0].ends_with(", 118, 119 and 20 more")) << told[0];
}

// As those of a height grid or an STL.
TEST(AssignMaterialsTest, SurfacesWithoutANameAreReportedAsSuch) {
  Scene scene = scene_with({instance("seabed", {""})});
  std::vector<std::string> told;
  assign_materials(scene, {}, [&](Severity, const std::string& line) { told.push_back(line); });
  EXPECT_THAT(told, ElementsAre("took sand for surfaces that name no material"));
}

TEST(AssignMaterialsTest, SaysNothingWhenAllAreKnown) {
  Scene scene = scene_with({instance("ship", {"steel"})});
  assign_materials(scene, {}, [](Severity, const std::string& line) { ADD_FAILURE() << line; });
}

TEST(AssignMaterialsTest, AnOverrideChangesTheLibrarysMaterialOfItsName) {
  Scene scene = scene_with({instance("ship", {"steel"})});
  assign_materials(scene, {.overrides = {{"steel", {.reflectivity = 0.4}}}});
  ASSERT_THAT(names_of(scene), ElementsAre("steel"));
  EXPECT_EQ(scene.materials[0].reflectivity, 0.4);
  EXPECT_EQ(scene.materials[0].density, 7850);
  EXPECT_EQ(scene.materials[0].sound_speed, 5900);
  EXPECT_EQ(scene.materials[0].source, "scenario");
}

TEST(AssignMaterialsTest, AnOverrideStartsFromWhatItIsLike) {
  Scene scene = scene_with({instance("ship", {"paint_7"})});
  assign_materials(scene, {.overrides = {{"paint_7", {.like = "aluminum", .density = 2800}}}});
  ASSERT_THAT(names_of(scene), ElementsAre("paint_7"));
  EXPECT_EQ(scene.materials[0].density, 2800);
  EXPECT_EQ(scene.materials[0].sound_speed, 6420);
}

TEST(AssignMaterialsTest, AnOverrideOfAnUnknownNameStartsFromTheDefault) {
  Scene scene = scene_with({instance("ship", {"paint_7"})});
  assign_materials(scene, {.overrides = {{"paint_7", {.reflectivity = 0.9}}}, .default_material = "concrete"});
  EXPECT_EQ(scene.materials[0].name, "paint_7");
  EXPECT_EQ(scene.materials[0].density, 2400);
  EXPECT_EQ(scene.materials[0].reflectivity, 0.9);
}

TEST(AssignMaterialsTest, TheDefaultMayBeAnOverride) {
  Scene scene = scene_with({instance("ship", {"paint_7", "rust"})});
  assign_materials(scene, {.overrides = {{"bottom", {.like = "mud", .density = 1200}}, {"rust", {.reflectivity = 0.5}}},
                           .default_material = "bottom"});
  ASSERT_THAT(names_of(scene), ElementsAre("bottom", "rust"));
  EXPECT_EQ(scene.materials[0].density, 1200);
  EXPECT_EQ(scene.materials[1].density, 1200);
}

TEST(AssignMaterialsTest, AUsersMaterialMayBeAnOverride) {
  Scene scene = scene_with({instance("ship", {"steel", "wood"})});
  scene.instances[0].user_material = "Hull Plate";
  assign_materials(scene, {.overrides = {{"hull_plate", {.like = "steel", .reflectivity = 0.7}}}});
  EXPECT_THAT(names_of(scene), ElementsAre("hull_plate", "hull_plate"));
}

// Each rule is taken away in turn, and the next one decides.
TEST(AssignMaterialsTest, FiveRulesDecideInOrder) {
  Scene scene = scene_with({instance("ship::hull::skin", {"steel"}), instance("rock", {"moss"})});
  Instance& ship = scene.instances[0];
  ship.user_material = "pvc";
  MaterialRules rules{.overrides = {{"ship::hull::skin", {.like = "copper"}},
                                    {"skin", {.like = "lead"}},
                                    {"steel", {.like = "titanium"}}},
                      .default_material = "ice"};
  const auto densities = [&] {
    assign_materials(scene, rules);
    return scene.materials[ship.materials[0]].density;
  };
  EXPECT_EQ(densities(), find_material("copper")->density);  // The visual's whole name.
  rules.overrides.erase("ship::hull::skin");
  EXPECT_EQ(densities(), find_material("lead")->density);  // Its last part.
  rules.overrides.erase("skin");
  EXPECT_EQ(densities(), find_material("pvc")->density);  // The instance's user_material.
  ship.user_material.clear();
  EXPECT_EQ(densities(), find_material("titanium")->density);  // The slot's own name, overridden.
  rules.overrides.erase("steel");
  EXPECT_EQ(densities(), find_material("steel")->density);  // The slot's own name in the library.
  EXPECT_THAT(names_of(scene, 1), ElementsAre("ice"));      // The default.
}

// "wreck" is a model, "hull" one of its links.
TEST(AssignMaterialsTest, ModelsAndLinksAreNamedTheInnermostFirst) {
  Scene scene = scene_with({instance("wreck::hull::plate", {"steel"}), instance("wreck::mast::plate", {"wood"}),
                            instance("reef::wreckage", {"rock"})});
  MaterialRules rules{.overrides = {{"wreck", {.like = "ice"}}}};
  assign_materials(scene, rules);
  EXPECT_THAT(names_of(scene, 0), ElementsAre("wreck"));
  EXPECT_THAT(names_of(scene, 1), ElementsAre("wreck"));
  EXPECT_THAT(names_of(scene, 2), ElementsAre("rock"));
  for (const char* key : {"hull", "wreck::hull"}) {
    rules.overrides[key] = {.like = "lead"};
    assign_materials(scene, rules);
    EXPECT_THAT(names_of(scene, 0), ElementsAre(key));
    EXPECT_THAT(names_of(scene, 1), ElementsAre("wreck"));
  }
  rules.overrides["plate"] = {.like = "copper"};
  assign_materials(scene, rules);
  EXPECT_THAT(names_of(scene, 0), ElementsAre("plate"));
  EXPECT_THAT(names_of(scene, 1), ElementsAre("plate"));
}

// A mesh file wreck.obj with the materials wreck and rust: the second triangle is of rust.
TEST(AssignMaterialsTest, TheMaterialOfAPartIsNotThatOfTheWholeFile) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  mesh.material_names = {"wreck", "rust"};
  mesh.material_slots = {0, 1};
  Scene scene = scene_with({{.name = "wreck", .mesh = std::make_shared<Mesh>(mesh)}});
  std::vector<std::string> told;
  const Log log = [&](Severity severity, const std::string& line) {
    if (severity == Severity::kWarning) {
      told.push_back(line);
    }
  };
  assign_materials(scene, {.overrides = {{"wreck", {.like = "steel"}}}}, log);
  EXPECT_THAT(names_of(scene), ElementsAre("wreck", "sand"));
  EXPECT_THAT(
      told,
      ElementsAre("materials.wreck is for the surfaces of wreck with a material of that name, not for all of it"));

  told.clear();
  mesh.material_slots = {0, 0};  // Nothing is of rust.
  scene.instances[0].mesh = std::make_shared<Mesh>(mesh);
  assign_materials(scene, {.overrides = {{"wreck", {.like = "steel"}}}}, log);
  EXPECT_THAT(names_of(scene), ElementsAre("wreck", "wreck"));
  EXPECT_TRUE(told.empty());
}

TEST(AssignMaterialsTest, AnOverrideOfALibrarysNameMayGoUnused) {
  EXPECT_EQ(fault(scene_with({instance("ship", {"steel"})}), {.overrides = {{"Aluminum", {.density = 2750}}}}),
            "no error");
}

TEST(AssignMaterialsTest, AssigningAgainStartsAfresh) {
  Scene scene = scene_with({instance("ship", {"steel"})});
  assign_materials(scene, {});
  assign_materials(scene, {.overrides = {{"ship", {.like = "wood"}}}});
  EXPECT_EQ(scene.materials.size(), 1U);
  EXPECT_THAT(names_of(scene), ElementsAre("ship"));
}

// ---------------------------------------------------------------- Names that nobody knows

TEST(AssignMaterialsMessagesTest, NamesTheNearestVisualOrMaterialOfAKey) {
  const Scene scene = scene_with({instance("ship::hull", {"red_paint"})});
  const std::string kHas = "The scene has ship, hull, ship::hull, red_paint";
  EXPECT_EQ(fault(scene, {.overrides = {{"hul", {.reflectivity = 0.9}}}}),
            "materials.hul matches no object and no material; did you mean hull? " + kHas);
  EXPECT_EQ(fault(scene, {.overrides = {{"ship::hall", {.reflectivity = 0.9}}}}),
            "materials.ship::hall matches no object and no material; did you mean ship::hull? " + kHas);
  EXPECT_EQ(fault(scene, {.overrides = {{"red_pant", {.reflectivity = 0.9}}}}),
            "materials.red_pant matches no object and no material; did you mean red_paint? " + kHas);
  EXPECT_EQ(fault(scene, {.overrides = {{"concret", {.reflectivity = 0.9}}}}),
            "materials.concret matches no object and no material; did you mean concrete? " + kHas);
}

TEST(AssignMaterialsMessagesTest, ListsWhatThereIsWhereNoNameIsNear) {
  EXPECT_EQ(fault(scene_with({instance("ship::hull::skin", {"red_paint", ""}), instance("ship::mast::skin", {"wood"})}),
                  {.overrides = {{"submarine", {.reflectivity = 0.9}}}}),
            "materials.submarine matches no object and no material; the scene has ship, hull, ship::hull, skin, "
            "ship::hull::skin, red_paint, mast, ship::mast, ship::mast::skin, wood");
  EXPECT_EQ(fault({}, {.overrides = {{"submarine", {.reflectivity = 0.9}}}}),
            "materials.submarine matches no object and no material");
}

TEST(AssignMaterialsMessagesTest, NamesTheNearestMaterialToBeLike) {
  EXPECT_EQ(fault(scene_with({instance("hull")}), {.overrides = {{"hull", {.like = "steal"}}}}),
            "materials.hull.like = steal is not a known material; did you mean steel?");
}

TEST(AssignMaterialsMessagesTest, NamesTheNearestMaterialToAUsers) {
  Scene scene = scene_with({instance("ship::hull", {"steel"})});
  scene.instances[0].user_material = "titanum";
  scene.places["ship::hull"] = {"ship.sdf", 12};
  EXPECT_EQ(fault(scene, {.overrides = {{"steel", {.density = 7700}}, {"ship::hull", {.density = 7700}}}}), "no error");
  EXPECT_EQ(fault(scene, {}),
            "ship.sdf:12: ship::hull: material = titanum is not a known material; did you mean titanium?");
}

TEST(AssignMaterialsMessagesTest, NamesTheNearestMaterialToAMeshsWhereTheUserWroteIt) {
  Scene scene = scene_with({instance("hull", {"", "steel", "titanum"})});
  scene.instances[0].names_resolve = true;
  EXPECT_EQ(fault(scene, {}), "hull: material = titanum is not a known material; did you mean titanium?");
  EXPECT_EQ(fault(scene, {.overrides = {{"Titanum", {.like = "pvc"}}}}), "no error");
  EXPECT_EQ(fault(scene, {.overrides = {{"hull", {.like = "pvc"}}}}), "no error");
}

TEST(AssignMaterialsMessagesTest, NamesTheNearestMaterialToTheDefault) {
  const Scene scene = scene_with({instance("hull", {"steel"})});
  EXPECT_EQ(fault(scene, {.default_material = "snad"}),
            "default_material = snad is not a known material; did you mean sand?");
  EXPECT_EQ(fault(scene, {.overrides = {{"hull", {.like = "pvc"}}}, .default_material = "hul"}),
            "default_material = hul is not a known material; did you mean hull?");
}

// It would have to start from itself.
TEST(AssignMaterialsMessagesTest, RefusesADefaultThatStartsFromNothing) {
  EXPECT_EQ(fault(scene_with({instance("hull")}),
                  {.overrides = {{"bottom", {.density = 1300}}}, .default_material = "bottom"}),
            "default_material = bottom starts from no known material: materials.bottom.like is missing");
}

TEST(AssignMaterialsMessagesTest, RefusesTwoOverridesThatMeanTheSame) {
  EXPECT_EQ(fault(scene_with({instance("hull")}),
                  {.overrides = {{"aluminium", {.density = 2600}}, {"aluminum", {.density = 2800}}}}),
            "materials.aluminum means the same as materials.aluminium");
}

TEST(AssignMaterialsMessagesTest, NamesThePropertyOutOfItsLimits) {
  const Scene scene = scene_with({instance("hull")});
  EXPECT_EQ(fault(scene, {.overrides = {{"hull", {.density = 0}}}}),
            "materials.hull.density = 0 kg/m^3 must be greater than 0, at most 30000 kg/m^3");
  EXPECT_EQ(fault(scene, {.overrides = {{"hull", {.sound_speed = -3}}}}),
            "materials.hull.sound_speed = -3 m/s must be greater than 0, at most 20000 m/s");
  EXPECT_EQ(fault(scene, {.overrides = {{"hull", {.reflectivity = 1.01}}}}),
            "materials.hull.reflectivity = 1.01 must be from 0 to 1");
}

// pi 10^-1 + 0.9^2 = 0.31416 + 0.81 = 1.12416; what is left for |R| is sqrt(1 - 0.31416) = 0.82816.
TEST(AssignMaterialsMessagesTest, RefusesASurfaceThatGivesMoreThanItGets) {
  const Scene scene = scene_with({instance("hull")});
  EXPECT_EQ(
      fault(scene, {.overrides = {{"hull", {.lambert_db = -10, .reflection = 0.9}}}}),
      "materials.hull.reflection = 0.9 must be at most 0.828: with lambert_db = -10 dB the surface would send back "
      "1.124 times the sound that falls on it");
  // 0.31416 + 0.88^2 = 1.08856: a tenth more is limited; 0.89^2 makes it 1.10626.
  EXPECT_THAT(fault(scene, {.overrides = {{"hull", {.lambert_db = -10, .reflection = 0.89}}}}),
              testing::HasSubstr("1.106 times"));
  Scene allowed = scene;
  std::vector<std::string> lines;
  const Log log = [&](Severity, const std::string& line) { lines.push_back(line); };
  assign_materials(allowed, {.overrides = {{"hull", {.lambert_db = -10, .reflection = 0.88}}}}, log);
  EXPECT_NEAR(allowed.materials[0].reflection.value(), 0.82816, 1e-5);
  EXPECT_THAT(lines, testing::ElementsAre("materials.hull.reflection = 0.88 is limited to 0.828: with lambert_db = -10 "
                                          "dB the surface would send back 1.089 times the sound that falls on it"));
  assign_materials(allowed, {.overrides = {{"hull", {.lambert_db = -10, .reflection = 0.828}}}}, log);
  EXPECT_EQ(allowed.materials[0].reflection, 0.828);
  EXPECT_EQ(lines.size(), 1U);
  assign_materials(allowed, {.overrides = {{"hull", {.like = "steel", .lambert_db = -5}}}});
  EXPECT_LT(allowed.materials[0].reflection_at(720e3), 0.1);
}

// 0.8^2 + 0.5^2 + pi 10^-1 = 0.64 + 0.25 + 0.31416; what is left for |T| is sqrt(1 - 0.56416) = 0.66018. Of a solid
// acrylic |R| = 0.36020.
TEST(AssignMaterialsMessagesTest, RefusesASurfaceThatLetsThroughMoreThanItGets) {
  const Scene scene = scene_with({instance("hull")});
  EXPECT_EQ(
      fault(scene, {.overrides = {{"hull", {.lambert_db = -10, .reflection = 0.5, .transmission = 0.8}}}}),
      "materials.hull.transmission = 0.8 must be at most 0.660: with lambert_db = -10 dB and a reflection of 0.500 "
      "the surface would give 1.20 times the sound that falls on it");
  EXPECT_EQ(
      fault(scene, {.overrides = {{"hull", {.like = "acrylic", .transmission = 0.95}}}}),
      "materials.hull.transmission = 0.95 must be at most 0.932: with lambert_db = -35 dB and a reflection of 0.360 "
      "the surface would give 1.03 times the sound that falls on it");
  EXPECT_EQ(fault(scene, {.overrides = {{"hull", {.transmission = 1.2}}}}),
            "materials.hull.transmission = 1.2 must be from 0 to 1");
  EXPECT_EQ(fault(scene, {.overrides = {{"hull", {.open_share = -0.1}}}}),
            "materials.hull.open_share = -0.1 must be from 0 to 1");
  Scene allowed = scene;
  assign_materials(allowed, {.overrides = {{"hull", {.like = "acrylic", .transmission = 0.93}}}});
  EXPECT_EQ(allowed.materials[0].transmission, 0.93);
  // With a thickness, the reflection depends on the frequency: what passes is limited there.
  assign_materials(allowed, {.overrides = {{"hull", {.like = "acrylic", .thickness = 3e-3, .transmission = 0.99}}}});
  EXPECT_NEAR(allowed.materials[0].transmission_at(720e3), 0.777, 2e-3);
}

// Shear waves are slower than sqrt(3)/2 of the others in any solid. Another sound speed makes a fluid.
TEST(AssignMaterialsTest, ShearIsSlowerThanSound) {
  Scene scene = scene_with({instance("hull")});
  assign_materials(scene, {.overrides = {{"hull", {.like = "steel", .sound_speed = 2000}}}});
  EXPECT_FALSE(scene.materials[0].shear_speed.has_value());
  EXPECT_EQ(fault(scene, {.overrides = {{"hull", {.like = "steel", .shear_speed = 5500}}}}),
            "materials.hull.shear_speed = 5500 m/s must be at most 0.86 of sound_speed = 5900 m/s");
}

}  // namespace
}  // namespace insonify::assign_materials_test
