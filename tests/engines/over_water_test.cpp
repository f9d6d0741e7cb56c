// over_water_test.cpp -- echoes out by a mirror and back over the water's surface, on every engine: a wall reflects
// onto a plate, whose echoes by the surface are alone in their range.

#include "base/rotation_between.h"
#include "engines/agreement.h"

namespace insonify::over_water_test {
namespace {

using namespace testing_scenes;

// The wall is at y = 4, the water's surface at z = 0.
const Vec3 kSonar(0, 0, -2), kPlate(6, 1, -4), kNormal = Vec3(-0.6, 0.2, 0.77).normalized();

// From the plate to the images of the sonar in the wall and in the surface.
const Vec3 kByWall = Vec3(0, 8, -2) - kPlate, kByWater = Vec3(0, 0, 2) - kPlate;

Material scattering(double lambert_db, double reflection) {
  Material material;
  material.lambert_db = lambert_db;
  material.reflection = reflection;
  material.rms_slope = 0.02;
  return material;
}

Scene wall_and_plate() {
  Scene scene = SceneMaker()
                    .add("wall", make_plane(-Vec3::UnitY(), 40, 40), {.position = {0, 4, 0}}, 1)
                    .add("plate", make_plane(Vec3::UnitZ(), 0.4, 0.4),
                         {.position = kPlate, .orientation = rotation_between(Vec3::UnitZ(), kNormal)}, 1)
                    .scene();
  scene.materials = {scattering(-200, 0.7), scattering(-12, 0)};
  return scene;
}

FlatPlanSettings settings(SecondaryEchoes secondary) {
  SonarConfig sonar;
  sonar.frequency = 300e3;
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 100 * kDegree;
  // The middle between both ways is at 8.99 m; twice either is at 8.54 m and 9.43 m.
  sonar.min_range = 8.85;
  sonar.max_range = 9.15;
  sonar.bin_count = 15;
  sonar.sampling = {.columns_per_beam = 4, .rows = 300};
  return {.sonar = sonar, .model = EchoModel::kCalibrated, .secondary = secondary, .seed = 3};
}

// @param legs  Rays that were sent back to the sonar.
EchoGrid echoes_under_a_sea(const std::string& engine_name, Scene scene, double wind_speed,
                            SecondaryEchoes secondary = SecondaryEchoes::kAll, std::uint64_t* legs = nullptr) {
  FlatPlanSettings with = settings(secondary);
  add_sea(scene, Vec3::Zero(), wind_speed, with.sonar.frequency);
  with.materials = scene.materials;
  const auto engine = test_engine(engine_name, 2);
  engine->set_scene(scene);
  const EchoGrid echoes = echoes_of(*engine, with, {.position = kSonar});
  if (legs != nullptr) {
    *legs = engine->ray_counts().return_legs;
  }
  return echoes;
}

class OverWaterTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Engines, OverWaterTest, testing::ValuesIn(engines_to_compare()),
                         [](const auto& test) { return test.param; });

// Over a flat surface, and by the coherent share that waves of a third of a millimetre leave.
TEST_P(OverWaterTest, EchoesAreThoseOfTheReference) {
  for (const double wind_speed : {0.0, 0.25}) {
    for (const SecondaryEchoes secondary : {SecondaryEchoes::kAll, SecondaryEchoes::kSelective}) {
      std::uint64_t expected_legs = 0, legs = 0;
      const EchoGrid reference =
          echoes_under_a_sea("reference", wall_and_plate(), wind_speed, secondary, &expected_legs);
      const EchoGrid echoes = echoes_under_a_sea(GetParam(), wall_and_plate(), wind_speed, secondary, &legs);
      EXPECT_NEAR(static_cast<double>(legs) / static_cast<double>(expected_legs), 1, 0.01);
      EXPECT_GT(total(reference, 3), 0);
      EXPECT_LE(difference(reference, echoes, 3), kOrderTolerances[2]);
    }
  }
}

// Waves of half a metre leave nothing coherent; what their facets return of the plate out and back is 6 % of the calm
// surface's echo at these ranges.
TEST_P(OverWaterTest, NothingReturnsOverRoughWaterOrBehindThings) {
  const double calm = total(echoes_under_a_sea(GetParam(), wall_and_plate(), 0), 3);
  EXPECT_LT(total(echoes_under_a_sea(GetParam(), wall_and_plate(), 10), 3), 0.1 * calm);
  // A silent ball between the plate and the surface, or between the surface and the sonar.
  for (const Vec3& in_the_way : {Vec3(kPlate + 0.35 * kByWater), Vec3(0.8, 0.13, -1.2)}) {
    Scene scene = wall_and_plate();
    Scene ball = SceneMaker().add_sphere(in_the_way, 0.7).scene();
    ball.instances[0].materials = {static_cast<std::uint16_t>(scene.materials.size())};
    scene.instances.push_back(ball.instances[0]);
    scene.materials.push_back(scattering(-200, 0));
    EXPECT_LT(total(echoes_under_a_sea(GetParam(), scene, 0), 3), 0.05 * calm);
  }
}

}  // namespace
}  // namespace insonify::over_water_test
