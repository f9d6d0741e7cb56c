// raster_agreement_test.cpp -- primary echoes rasterised and traced, and which of both is chosen.

#include "echo/rays/primary_choice.h"
#include "engines/agreement.h"

namespace insonify::raster_agreement_test {
namespace {

using namespace testing_scenes;

TEST(RasterAgreementTest, RasterAndRaysGiveTheSameEchoes) {
  for (int seed = 0; seed < kScenes; ++seed) {
    const RandomScene random(seed);
    FlatPlanSettings settings{.sonar = random.sonar, .secondary = SecondaryEchoes::kNone};
    if (seed % 4 == 3) {
      settings.sonar.azimuth_aperture = radians_from_degrees(360);  // Triangles behind the sonar and around it.
    }
    const auto engine = test_engine("cpu", 2);
    engine->set_scene(random.scene);
    random.move_all([&](int instance, const Pose& pose) { engine->move_instance(instance, pose); });
    settings.primary = PrimaryEchoes::kRays;
    const EchoGrid rays = echoes_of(*engine, settings, random.pose);
    EXPECT_GT(engine->ray_counts().primary, 0U);
    settings.primary = PrimaryEchoes::kRaster;
    const EchoGrid raster = echoes_of(*engine, settings, random.pose);
    EXPECT_EQ(engine->ray_counts().primary, 0U);
    EXPECT_LE(difference(rays, raster, 1), kEnergyTolerance) << "seed " << seed;
  }
}

// Includes vertical walls, whose normals have zeros of either sign.
TEST(RasterAgreementTest, RoughMirrorsAreTheSameRasterisedOrTraced) {
  SceneMaker maker;
  maker.add_floor(-2).add_wall(8).add_sphere({5, 0.3, -1}, 0.6, 0.8, 0.2);
  Scene scene = maker.scene();
  for (Material& material : scene.materials) {
    material.rms_slope = 0.1;
    material.rms_height = 0.2e-3;
  }
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.azimuth_aperture = radians_from_degrees(90);
  sonar.elevation_aperture = radians_from_degrees(40);
  sonar.bin_count = 200;
  sonar.max_range = 12;
  FlatPlanSettings settings{.sonar = sonar,
                            .model = EchoModel::kCalibrated,
                            .materials = scene.materials,
                            .primary = PrimaryEchoes::kRays,
                            .secondary = SecondaryEchoes::kAll,
                            .rough_mirrors = true};
  for (const bool rough : {true, false}) {  // In the second round coherent reflection has a share of 0.23 or more.
    settings.rough_mirrors = rough;
    settings.primary = PrimaryEchoes::kRays;
    const EchoGrid rays = echoes_of("cpu", scene, settings), reference = echoes_of("reference", scene, settings);
    settings.primary = PrimaryEchoes::kRaster;
    const EchoGrid raster = echoes_of("cpu", scene, settings);
    ASSERT_GT(total(rays, 2), 0);
    expect_agreement(rays, raster, 0);
    expect_agreement(reference, rays, 0);
  }
}

TEST(RasterAgreementTest, AutoRasterisesFewTrianglesAndTracesMany) {
  const auto chosen = [](SonarConfig sonar, double azimuth_deg, int beams, std::size_t triangles) {
    sonar.azimuth_aperture = azimuth_deg * kDegree;
    sonar.beam_count = beams;
    sonar.sampling = {4, 200};
    return primary_echoes(PrimaryEchoes::kAuto, sonar, triangles, true);
  };
  const SonarConfig sonar;
  EXPECT_EQ(chosen(sonar, 120, 256, 1'000), PrimaryEchoes::kRaster);
  EXPECT_EQ(chosen(sonar, 120, 256, 20'000), PrimaryEchoes::kRaster);
  EXPECT_EQ(chosen(sonar, 120, 256, 100'000), PrimaryEchoes::kRays);
  EXPECT_EQ(chosen(sonar, 120, 16, 20'000), PrimaryEchoes::kRays);  // Fewer samples.
  EXPECT_EQ(chosen(sonar, 3, 1, 1'000),
            PrimaryEchoes::kRaster);  // Nearly everything is outside a narrow beam and is culled.
  EXPECT_EQ(chosen(sonar, 120, 1, 1'000), PrimaryEchoes::kRays);
  EXPECT_EQ(primary_echoes(PrimaryEchoes::kAuto, sonar, 10, false), PrimaryEchoes::kRays);
  EXPECT_EQ(primary_echoes(PrimaryEchoes::kRaster, sonar, 100'000'000, true), PrimaryEchoes::kRaster);
  EXPECT_EQ(primary_echoes(PrimaryEchoes::kRays, sonar, 10, true), PrimaryEchoes::kRays);
}

TEST(RasterAgreementTest, TheEngineUsesTheChosenMethod) {
  const RandomScene random(1);
  const auto engine = test_engine("cpu", 2);
  engine->set_scene(random.scene);
  for (const int rows : {2, 400}) {
    FlatPlanSettings settings{.sonar = random.sonar};
    settings.sonar.sampling = {1, rows};
    static_cast<void>(echoes_of(*engine, settings, random.pose));
    const bool drawn = primary_echoes(PrimaryEchoes::kAuto, settings.sonar, random.scene.triangle_count(), true) ==
                       PrimaryEchoes::kRaster;
    EXPECT_EQ(engine->ray_counts().primary == 0, drawn) << rows;
    EXPECT_EQ(drawn, rows == 400);
  }
}

}  // namespace
}  // namespace insonify::raster_agreement_test
