// shared_mesh_test.cpp -- many objects of one mesh share its triangles in the engine, and echo as copies do.

#include <fmt/format.h>

#include "insonify/simulator.h"
#include "simulator/small_world.h"

namespace insonify::shared_mesh_test {
namespace {

using namespace testing_scenes;

// 90 balls of 25 000 triangles each on a lattice before the sonar, each with a mesh of its own or all with one.
Scene balls(bool shared) {
  const auto mesh = std::make_shared<const Mesh>(make_sphere(0.2));
  Scene scene = small_world();
  const Instance ball = scene.instances[kBall];
  for (int i = 0; i < 90; ++i) {
    Instance more = ball;
    more.name = fmt::format("more{}", i);
    more.mesh = shared ? mesh : std::make_shared<const Mesh>(*mesh);
    more.materials.assign(mesh->material_names.size(), ball.materials[0]);
    more.world_from_mesh.position = {4.0 + i / 10, -3.0 + 0.6 * (i % 10), -1.5};
    more.world_from_mesh.orientation = orientation_from_rpy(0.1 * i, 0, 0.05 * i);
    scene.instances.push_back(more);
  }
  return scene;
}

class SharedMeshTest : public testing::TestWithParam<EchoModel> {};
INSTANTIATE_TEST_SUITE_P(Models, SharedMeshTest, testing::Values(EchoModel::kPaper, EchoModel::kCalibrated));

TEST_P(SharedMeshTest, TakesTheMemoryOfOneAndEchoesAsCopies) {
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.model = GetParam();
  scenario.primary = PrimaryEchoes::kRays;
  Simulator shared(scenario, balls(true), 2);
  const Ping one = shared.ping(0, {});
  Simulator copies(scenario, balls(false), 2);
  constexpr double kRounding = 1e-3;  // Rays are turned instead of triangles, so hits differ by rounding.
  EXPECT_LT(apart(copies.ping(0, {}), one), kRounding);
  EXPECT_GT(copies.engine_memory().library + copies.engine_memory().own, 150e6);
  EXPECT_LT(shared.engine_memory().library + shared.engine_memory().own, 30e6);
  shared.remove_object("more7");
  copies.remove_object("more7");
  EXPECT_LT(apart(copies.ping(0, {}), shared.ping(0, {})), kRounding);
}

}  // namespace
}  // namespace insonify::shared_mesh_test
