// sdf_portions_test.cpp -- worlds of so many models that libsdformat reads them in portions.

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "io/sdf_files.h"
#include "support/working_folder.h"

namespace insonify::sdf_portions_test {
namespace {

using SdfPortionsTest = SdfTest;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kMany = 120;  // Models of four elements each: several portions of 150.

std::string box(double side) {
  return fmt::format("<box><size>{0} {0} 1</size></box>", side);
}

// Line 2 + i.
std::string model(int i, const std::string& geometry, const std::string& more = "") {
  return fmt::format(
      "<model name='m{0}'><pose>0 0 {0} 0 0 0</pose><link name='l'><collision "
      "name='c'><geometry>{1}</geometry></collision>"
      "<visual name='v'><geometry>{1}</geometry></visual>{2}</link></model>\n",
      i, geometry, more);
}

// A world of unequal boxes, one of them replaced.
std::string world_of_boxes(int replaced = -1, const std::string& by = "", const std::string& more = "") {
  std::string text = "<sdf version='1.6' xmlns:insonify='https://insonify.org/sdf'><world name='w'>\n";
  for (int i = 0; i < kMany; ++i) {
    text += i == replaced ? by : model(i, box(1 + 0.01 * i));
  }
  return text + more + "</world></sdf>";
}

TEST_F(SdfPortionsTest, ModelsComeInTheOrderOfTheFile) {
  const Scene scene = load(world_of_boxes());
  ASSERT_EQ(scene.instances.size(), std::size_t{kMany});
  for (int i = 0; i < kMany; ++i) {
    const Instance& instance = scene.instances[i];
    EXPECT_EQ(instance.name, fmt::format("m{}::l::v", i));
    EXPECT_NEAR(instance.world_from_mesh.position.z(), i, 1e-12);
    EXPECT_FLOAT_EQ(instance.mesh->vertices[0].cwiseAbs().x(), static_cast<float>((1 + 0.01 * i) / 2));
  }
  EXPECT_TRUE(said.empty());
}

TEST_F(SdfPortionsTest, EqualModelsAreAmongThem) {
  std::string text = "<sdf version='1.6'><world name='w'>\n";
  for (int i = 0; i < kMany; ++i) {
    text += model(i, box(1 + (i % 60)));
  }
  const Scene scene = load(text + "</world></sdf>");
  ASSERT_EQ(scene.instances.size(), std::size_t{kMany});
  for (int i = 0; i < kMany; ++i) {
    EXPECT_EQ(scene.instances[i].name, fmt::format("m{}::l::v", i));
    EXPECT_EQ(scene.instances[i].mesh, scene.instances[i % 60].mesh);
  }
}

TEST_F(SdfPortionsTest, AFaultIsToldWithItsLineAndCostsOneElement) {
  const Scene scene = load(world_of_boxes(110, model(110, "<box><size>1 2</size></box>")));
  EXPECT_EQ(scene.instances.size(), std::size_t{kMany - 1});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said[0], HasSubstr("scene.sdf:112:"));
}

TEST_F(SdfPortionsTest, ANameThatIsThereAlreadyIsAFault) {
  const Scene scene = load(world_of_boxes(110, model(3, box(9))));
  EXPECT_EQ(scene.instances.size(), std::size_t{kMany - 1});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said[0], HasSubstr("scene.sdf:112:"));
  EXPECT_THAT(said[0], HasSubstr("model 'm3' has the name of the one of line 5"));
}

TEST_F(SdfPortionsTest, SavedPosesAndIncludesHold) {
  write("big/model.sdf", "<sdf version='1.6'>" + model(500, box(7)) + "</sdf>");
  const Scene scene =
      load(world_of_boxes(110, "<include><uri>big</uri><name>big</name><pose>1 2 3 0 0 0</pose></include>\n",
                          "<state world_name='w'><model name='m115'><pose>5 6 7 0 0 0</pose></model></state>"));
  ASSERT_EQ(scene.instances.size(), std::size_t{kMany});
  EXPECT_EQ(scene.instances[110].name, "big::l::v");
  EXPECT_LT((scene.instances[110].world_from_mesh.position - Vec3(1, 2, 3)).norm(), 1e-9);
  EXPECT_LT((scene.instances[115].world_from_mesh.position - Vec3(5, 6, 7)).norm(), 1e-9);
}

TEST_F(SdfPortionsTest, AModelRelativeToAnotherIsReadWithIt) {
  const Scene scene =
      load("<sdf version='1.9'>" +
           world_of_boxes(110,
                          "<model name='m110'><pose relative_to='m3'>0 0 1 0 0 0</pose><link name='l'><visual "
                          "name='v'><geometry><box><size>1 1 1</size></box></geometry></visual></link></model>\n")
               .substr(std::string("<sdf version='1.6' xmlns:insonify='https://insonify.org/sdf'>").size()));
  ASSERT_EQ(scene.instances.size(), std::size_t{kMany});
  EXPECT_NEAR(scene.instances[110].world_from_mesh.position.z(), 4, 1e-9);
}

TEST(SdfPortionsSonarsTest, StandWhereTheFileHasThem) {
  const WorkingFolder folder;
  folder.write("w.sdf", world_of_boxes(117, model(117, box(1), "<insonify:sonar name='fls'/>")));
  const Scenario scenario = load_scenario("w.sdf");
  ASSERT_EQ(scenario.sonars.size(), 1U);
  EXPECT_EQ(scenario.sonars[0].name, "fls");
  EXPECT_NEAR(scenario.trajectory.at(0).position.z(), 117, 1e-9);
}

// libsdformat takes 2.5 MB for each of these models; all at once they took 600 MB.
TEST_F(SdfPortionsTest, MemoryDoesNotGrowWithTheModels) {
  const auto peak_mb = [] {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_maxrss) / 1e3;
  };
  std::string text = "<sdf version='1.6'><world name='w'>\n";
  for (int i = 0; i < 2 * kMany; ++i) {
    text += model(i, box(1 + 0.01 * i));
  }
  const double before = peak_mb();
  EXPECT_EQ(load(text + "</world></sdf>").instances.size(), std::size_t{2 * kMany});
  constexpr double kMost = 250;
  EXPECT_LT(peak_mb() - before, kMost);
}

}  // namespace
}  // namespace insonify::sdf_portions_test
