// gpu_sums_test.cpp -- sums of engine `gpu`, which do not depend on the order of additions, in pings and in batches.

#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <map>
#include <span>

#include "echo/gpu/gpu_batch.h"
#include "echo/gpu/gpu_plan.h"
#include "echo/gpu/shaders/layout.h"
#include "engines/gpu_test.h"
#include "gpu/device.h"

namespace insonify::gpu_sums_test {
namespace {

using namespace testing_scenes;
using testing::ElementsAre;

// A card adds in any order.
TEST_F(GpuEngineTest, ARepeatedPingHasTheSameBytes) {
  for (const int seed : {1, 4}) {
    const RandomScene random(seed);
    const FlatPlanSettings settings{.sonar = random.sonar, .secondary = SecondaryEchoes::kAll};
    const auto engine = test_engine("gpu");
    engine->set_scene(random.scene);
    const EchoGrid first = echoes_of(*engine, settings, random.pose);
    for (int i = 0; i < 5; ++i) {
      expect_same_bytes(echoes_of(*engine, settings, random.pose), first);
    }
    expect_same_bytes(echoes_of("gpu", random.scene, settings, random.pose), first);
  }
}

// Four cells of a thousand objects each: far more than there is room for at first.
TEST_F(GpuEngineTest, ListsOfSurfacesGrow) {
  SceneMaker maker;
  constexpr int kSide = 32;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double across = (i % kSide - 0.5 * kSide) * 0.2, up = (i / kSide - 0.5 * kSide) * 0.2;
    maker.add("plate" + std::to_string(i), make_plane(Vec3::UnitX(), 0.15, 0.15), {.position = {10, across, up}});
  }
  SonarConfig sonar;
  sonar.beam_count = 2;
  sonar.bin_count = 2;
  sonar.azimuth_aperture = 40 * kDegree;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 21;
  sonar.sampling = {.columns_per_beam = 128, .rows = 256};
  const FlatPlanSettings settings{.sonar = sonar, .secondary = SecondaryEchoes::kNone};
  const EchoGrid cpu = echoes_of("cpu", maker.scene(), settings);
  const EchoGrid gpu = echoes_of("gpu", maker.scene(), settings);
  for (int beam = 0; beam < 2; ++beam) {
    for (int bin = 0; bin < 2; ++bin) {
      std::map<SurfaceLabel, float> expected;
      cpu.for_each_surface(beam, bin, [&](const SurfaceEcho& echo) { expected[echo.surface] += echo.energy; });
      EXPECT_TRUE(bin == 1 || expected.size() > 300) << expected.size();
      std::size_t found = 0;
      gpu.for_each_surface(beam, bin, [&](const SurfaceEcho& echo) {
        ++found;
        EXPECT_NEAR(echo.energy, expected[echo.surface], 1e-2 * expected[echo.surface]);
      });
      EXPECT_EQ(found, expected.size());
    }
  }
}

// Two invocations that both find a surface missing in a list both add it. The list has 6 twice, together as strong as
// 8: the lower label is the cell's.
TEST_F(GpuEngineTest, SumsOfASurfaceThatIsListedTwiceAreAdded) {
  constexpr auto kOne = static_cast<std::int64_t>(shader::kUnits);
  gpu::Device device(std::getenv("INSONIFY_DEVICE"));
  const gpu::Buffer memory(device, 4096, gpu::Memory::kToHost);
  std::memset(memory.data(), 0, memory.bytes());
  const auto at = [&](std::size_t place) { return memory.address() + place; };
  const auto put = [&](std::size_t place, const auto& value) {
    std::memcpy(memory.data() + place, &value, sizeof(value));
  };
  put(0, shader::PingAt{.plan = at(512),
                        .cells = {.energy = at(1024),
                                  .weight = at(1032),
                                  .first_surface = at(1040),
                                  .surfaces = at(1048),
                                  .counter = at(1280),
                                  .met_before = at(1312),
                                  .most_surfaces = 4,
                                  .labelled = 2},
                        .layers = {.energy = at(2048),
                                   .weight = at(2052),
                                   .surface = at(2056),
                                   .surface_energy = at(2060),
                                   .moment = at(2064),
                                   .square = at(2068),
                                   .further = at(2072),
                                   .used = at(2144),
                                   .met_before = at(2152),
                                   .orders = 1}});
  put(512, shader::PlanTables{.beams = 1, .bins = 1, .bin_scale = at(1320)});
  put(1320, 2.0F);
  put(1024, std::array<std::int64_t, 2>{100 * kOne, 3 * kOne});
  put(1040, 2U);
  put(1048, std::array<shader::SurfaceSum, 4>{
                {{.key = 7, .next = 3, .energy = 10 * kOne, .moment = -4 * kOne, .square = 2 * kOne},
                 {.key = 9, .next = 1, .energy = 40 * kOne, .moment = 8 * kOne, .square = 4 * kOne},
                 {.key = 5, .next = 4, .energy = 20 * kOne, .moment = 6 * kOne, .square = 3 * kOne},
                 {.key = 7, .next = 0, .energy = 30 * kOne, .moment = 1 * kOne, .square = 5 * kOne}}});
  const PingKernels kernels(device);
  gpu::Commands commands(device);
  commands.begin();
  commands.run(kernels.gather, shader::PingJob{at(0), 0, gpu::Commands::most_groups}, 1);
  commands.submit();
  commands.wait();
  const auto* layers = reinterpret_cast<const float*>(memory.data() + 2048);
  EXPECT_EQ(layers[0], 50);  // Energy and weight, of which the weight is not scaled by the bin.
  EXPECT_EQ(layers[1], 3);
  EXPECT_EQ(reinterpret_cast<const std::uint32_t*>(layers)[2], 6U);
  EXPECT_THAT(std::span(layers + 3, 3), ElementsAre(20, -1.5F, 3.5F));
  EXPECT_EQ(reinterpret_cast<const shader::Counters*>(memory.data() + 1280)->further, 2U);
  const auto* further = reinterpret_cast<const shader::FurtherSum*>(memory.data() + 2072);
  EXPECT_EQ(further[0].surface, 4U);
  EXPECT_EQ(further[0].energy, 10);
  EXPECT_EQ(further[1].surface, 8U);
  EXPECT_EQ(further[1].moment, 4);
}

// Over 60 m of water that absorbs 2.6 dB/m each way, echoes fall by 310 dB, which is more than single precision spans.
TEST_F(GpuEngineTest, SumsAreExactWhereNothingIsLeftOfEchoes) {
  constexpr double kRounding = 1e-4;
  const Scene scene = SceneMaker().add_floor(-3).add_wall(20).scene();
  SonarConfig sonar;
  sonar.frequency = 3e6;
  sonar.beam_count = 8;
  sonar.bin_count = 200;
  sonar.max_range = 60;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.sampling = {.columns_per_beam = 2, .rows = 60};
  const FlatPlanSettings settings{.sonar = sonar,
                                  .model = EchoModel::kCalibrated,
                                  .materials = scene.materials,
                                  .secondary = SecondaryEchoes::kNone};
  const std::vector<float> scales = bin_scales(*make_flat_plan(settings));
  EXPECT_TRUE(std::ranges::all_of(scales, [](float scale) { return std::isfinite(scale); }));
  EXPECT_GT(scales.back(), 1e30F);
  const EchoGrid cpu = echoes_of("cpu", scene, settings), gpu = echoes_of("gpu", scene, settings);
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      const float expected = cpu.energy(1, beam)[bin];
      EXPECT_NEAR(gpu.energy(1, beam)[bin], expected, 0.05F * expected) << beam << ' ' << bin;
    }
  }
  EXPECT_LE(difference(cpu, gpu, 1), kRounding);
}

// Gives up at one view, as when a run is interrupted.
class StoppingReceiver final : public EchoReceiver {
 public:
  void receive(std::size_t view, const EchoGrid&, const FormedBeams*, Workers&, int) override {
    if (view == 3) {
      throw Error("stop");
    }
  }
};

// 40 views take three submissions, of which the last ones are under way when the receiver gives up.
TEST_F(GpuEngineTest, PartsOfABatchGiveTheBytesOfPingsAloneAlsoAfterOneWasGivenUp) {
  constexpr std::size_t kViews = 40;
  const RandomScene random(4);
  const FlatPlanSettings settings{.sonar = random.sonar, .secondary = SecondaryEchoes::kAll};
  const std::shared_ptr<const FlatPlan> plan = make_flat_plan(settings);
  Workers workers(2);
  const std::unique_ptr<Engine> engine = make_engine("gpu", workers);
  engine->set_scene(random.scene);
  std::vector<PingView> views(kViews, {.plan = plan.get(), .world_from_sonar = random.pose});
  for (std::size_t i = 0; i < kViews; ++i) {
    views[i].world_from_sonar.position.x() += 0.05 * static_cast<double>(i);
  }
  const std::unique_ptr<EchoBatch> together = engine->make_batch(), alone = engine->make_batch();
  ASSERT_EQ(together->capacity(views), kViews);
  StoppingReceiver stopping;
  together->start(views);
  EXPECT_THROW(together->receive(stopping), Error);
  std::ranges::reverse(views);
  together->start(views);
  std::vector<EchoGrid> grids(kViews);
  for (std::size_t i = kViews; i-- > 0;) {  // The last ones first, which nothing has waited for yet.
    grids[i] = together->map(i);
  }
  for (std::size_t i = 0; i < kViews; ++i) {
    alone->start({&views[i], 1});
    expect_same_bytes(grids[i], alone->map(0));
  }
}

// A sonar before nets, within a box of them, and one that looks away, in one batch.
TEST_F(GpuEngineTest, BatchesSeeThroughNetsAsSinglePingsDo) {
  SceneMaker maker;
  for (int i = 0; i < 10; ++i) {
    maker.add("net" + std::to_string(i), make_plane(Vec3::UnitX(), 20, 20), {.position = {2.0 + 0.3 * i, 0, 0}});
  }
  Scene scene = maker.add_wall(8).scene();
  for (std::size_t i = 0; i + 1 < scene.materials.size(); ++i) {
    scene.materials[i].open_share = 0.9;
  }
  FlatPlanSettings settings{
      .model = EchoModel::kCalibrated, .materials = scene.materials, .primary = PrimaryEchoes::kRays};
  settings.sonar.beam_count = 16;
  settings.sonar.max_range = 10;
  settings.sonar.sampling = {2, 40};
  const auto engine = test_engine("gpu"), cpu = test_engine("cpu");
  engine->set_scene(scene);
  cpu->set_scene(scene);
  const std::vector<Pose> poses = {
      {}, {{3.1, 0, 0}, orientation_from_rpy(0, 0, 0.2)}, {{0, 0, 0}, orientation_from_rpy(0, 0, 3)}};
  const FlatPlan plan = *make_flat_plan(settings);
  std::vector<EchoGrid> grids(poses.size(), EchoGrid(settings.sonar.beam_count, settings.sonar.bin_count, kPathOrders));
  engine->insonify_all(plan, poses, grids);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    expect_same_bytes(echoes_of(*engine, settings, poses[i]), grids[i]);
    EXPECT_LE(difference(echoes_of(*cpu, settings, poses[i]), grids[i], 1), 1e-4) << i;
    EXPECT_EQ(engine->ray_counts().primary, cpu->ray_counts().primary) << i;
  }
}

}  // namespace
}  // namespace insonify::gpu_sums_test
