// gpu_engine_test.cpp -- what engine `gpu` adds to those on the host: devices, sums that do not depend on order, lists
// that grow. On Mesa's driver for the processor, unless INSONIFY_DEVICE names a card.

#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <map>
#include <span>
#include <thread>
#include <utility>

#include "echo/gpu/gpu_batch.h"
#include "echo/gpu/gpu_plan.h"
#include "echo/gpu/shaders/layout.h"
#include "echo/model/left_out.h"
#include "echo/targets/scene_targets.h"
#include "engines/random_scene.h"
#include "gpu/device.h"
#include "support/message_of.h"

namespace insonify::gpu_engine_test {
namespace {

using namespace testing_scenes;
using testing::ElementsAre;

class GpuEngineTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::ranges::find(usable_engines(), "gpu") == usable_engines().end()) {
      GTEST_SKIP() << "no device of Vulkan here";
    }
  }
};

void expect_same_bytes(const EchoGrid& a, const EchoGrid& b) {
  for (int beam = 0; beam < a.beam_count(); ++beam) {
    for (int order = 1; order <= kPathOrders; ++order) {
      ASSERT_TRUE(std::ranges::equal(a.energy(order, beam), b.energy(order, beam)));
      ASSERT_TRUE(std::ranges::equal(a.weight(order, beam), b.weight(order, beam)));
    }
    for (int bin = 0; bin < a.bin_count(); ++bin) {
      const EchoGrid::Label one = a.label(beam, bin), other = b.label(beam, bin);
      ASSERT_EQ(one.instance, other.instance);
      ASSERT_EQ(one.elevation, other.elevation);
    }
  }
}

TEST_F(GpuEngineTest, UnknownDevicesAreRefusedWithThoseThereAre) {
  Workers workers(1);
  const std::string message = message_of([&] { make_engine("gpu", workers, "abacus"); });
  EXPECT_TRUE(message.starts_with("there is no device \"abacus\"; there are 0 \"")) << message;
  EXPECT_TRUE(
      message_of([&] { make_engine("gpu", workers, "99"); }).starts_with("there is no device \"99\"; there are"));
}

TEST_F(GpuEngineTest, DevicesAreListedByIndexAndName) {
  const std::vector<std::string> texts = device_texts();
  ASSERT_FALSE(texts.empty());
  EXPECT_TRUE(texts[0].starts_with("0: ")) << texts[0];
}

TEST_F(GpuEngineTest, WhatItDoesNotComputeIsRefusedByName) {
  Scenario scenario = quiet_scenario(SonarConfig());
  scenario.engine = "gpu";
  scenario.model = EchoModel::kCalibrated;
  scenario.validate();
  scenario.surface = SeaSurface{.level = 2};
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "engine = gpu computes no sea surface in model = calibrated yet");
}

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

// Bars as thick as the thickest thin parts: rounding decides which of their triangles are thin. Each engine must leave
// out those for which there are pieces.
TEST_F(GpuEngineTest, ThinPartsAreThoseThatCpuFinds) {
  SceneMaker maker;
  for (int i = 0; i < 40; ++i) {
    maker.add("bar" + std::to_string(i), make_box({double{ThinParts::kThickest}, double{ThinParts::kThickest}, 1}),
              {.position = {7.3 + 0.31 * (i % 8), 0.4 * i - 8.2, 0.17 * (i % 5)}});
  }
  const Scene scene = maker.scene();
  Workers workers(2);
  const auto thickness = [&](std::string_view name) {
    const std::unique_ptr<Engine> engine = make_engine(name, workers);
    engine->set_scene(scene);
    const SceneTargets targets = find_targets(scene, {}, {}, *engine, workers);
    std::vector<std::vector<float>> tables;
    for (const auto& table : targets.thin_parts->triangles->thickness) {
      tables.push_back(table ? *table : std::vector<float>());
    }
    return tables;
  };
  const std::vector<std::vector<float>> expected = thickness("cpu");
  EXPECT_TRUE(std::ranges::any_of(expected, [](const auto& table) { return !table.empty(); }));
  EXPECT_EQ(thickness("gpu"), expected);
  EXPECT_EQ(thickness("reference"), expected);
}

// Gives up at one view, as when a run is interrupted.
class StoppingReceiver final : public EchoReceiver {
 public:
  void receive(std::size_t view, const EchoGrid&, Workers&, int) override {
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
  const std::vector<std::span<const EchoList* const>> no_echoes(kViews);
  StoppingReceiver stopping;
  together->start(views);
  EXPECT_THROW(together->receive(no_echoes, stopping), Error);
  std::ranges::reverse(views);
  together->start(views);
  for (std::size_t i = 0; i < kViews; ++i) {
    alone->start({&views[i], 1});
    expect_same_bytes(together->map(i), alone->map(0));
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

// 200 rows are three blocks of kSelectionRows and one of eight rows, in each of which the sum of probabilities starts
// again.
TEST_F(GpuEngineTest, LongColumnsReflectTheRaysThatCpuReflects) {
  constexpr double kRounding = 1e-3;
  const Scene scene = SceneMaker().add_floor(-3).add_wall(11).add_sphere({8, 0.5, -1}, 1).scene();
  SonarConfig sonar;
  sonar.beam_count = 24;
  sonar.bin_count = 150;
  sonar.max_range = 15;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.sampling = {.columns_per_beam = 2, .rows = 200};
  ASSERT_GT(*sonar.sampling.rows, 3 * kSelectionRows);
  for (const EchoModel model : {EchoModel::kPaper, EchoModel::kCalibrated}) {
    const FlatPlanSettings settings{.sonar = sonar, .model = model, .materials = scene.materials};
    const EchoGrid cpu = echoes_of("cpu", scene, settings), gpu = echoes_of("gpu", scene, settings);
    EXPECT_GT(total(cpu, 2), 0);
    EXPECT_LE(difference(cpu, gpu, 1), kRounding);
    EXPECT_LE(difference(cpu, gpu, 2), kRounding);
  }
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

// Every second triangle loses the coherent share of its glint; every third is thin beyond a fifth of the
// range.
TEST_F(GpuEngineTest, LeavesOutTheThinPartsAndGlintsThatCpuLeavesOut) {
  constexpr double kRounding = 1e-4;
  for (const int seed : {2, 6}) {
    RandomScene random(seed);
    for (Material& material : random.scene.materials) {
      material.rms_height = 1e-4;
    }
    const FlatPlanSettings settings{.sonar = random.sonar,
                                    .model = EchoModel::kCalibrated,
                                    .materials = random.scene.materials,
                                    .secondary = SecondaryEchoes::kNone,
                                    .rough_mirrors = seed == 6};
    const float thin_beyond =
        0.2F * thin_per_metre(*make_flat_plan(settings)) * static_cast<float>(random.sonar.max_range);
    const auto left_out = std::make_shared<LeftOut>();
    for (const Instance& instance : random.scene.instances) {
      std::vector<float> thickness;
      std::vector<std::uint8_t> glinting;
      for (std::size_t triangle = 0; triangle < instance.mesh->triangles.size(); ++triangle) {
        thickness.push_back(triangle % 3 == 0 ? thin_beyond : INFINITY);
        glinting.push_back(triangle % 2);
      }
      left_out->thickness.push_back(std::make_shared<const std::vector<float>>(thickness));
      left_out->glinting.push_back(std::make_shared<const std::vector<std::uint8_t>>(glinting));
    }
    const auto echoes = [&](const char* name, bool leaves_out) {
      const auto engine = test_engine(name);
      engine->set_scene(random.scene);
      (void)echoes_of(*engine, settings, random.pose);  // With all echoes: what follows must not use what this left.
      engine->leave_out(leaves_out ? left_out : nullptr);
      return echoes_of(*engine, settings, random.pose);
    };
    const EchoGrid cpu = echoes("cpu", true);
    EXPECT_GT(difference(cpu, echoes("cpu", false), 1), 0.01);
    EXPECT_LE(difference(cpu, echoes("gpu", true), 1), kRounding) << seed;
  }
}

TEST_F(GpuEngineTest, StepsAreNamedAfterTheirShaders) {
  SonarConfig sonar;
  sonar.beam_count = 8;
  const auto steps_of = [&](EchoModel model) {
    Scenario scenario = quiet_scenario(sonar);
    scenario.engine = "gpu";
    scenario.model = model;
    Simulator simulator(scenario, SceneMaker().add_floor(-3).scene(), 1);
    (void)simulator.ping(0, PingRequest());
    std::vector<std::string_view> names;
    for (const StepTime& step : simulator.step_times()) {
      EXPECT_GE(step.seconds, 0);
      names.push_back(step.step);
    }
    return names;
  };
  EXPECT_EQ(steps_of(EchoModel::kPaper),
            (std::vector<std::string_view>{"clear", "trace_primaries", "evaluate", "select", "deposit", "reflect",
                                           "gather", "copy"}));
  EXPECT_EQ(steps_of(EchoModel::kCalibrated),
            (std::vector<std::string_view>{"clear", "trace_primaries", "turn_up", "evaluate", "select", "deposit",
                                           "mirror", "gather", "copy"}));
}

// As with more samples than the groups of one row have invocations.
TEST_F(GpuEngineTest, LongDispatchesHaveSeveralRowsOfGroups) {
  const RandomScene random(4);
  const FlatPlanSettings settings{.sonar = random.sonar, .secondary = SecondaryEchoes::kAll};
  const EchoGrid expected = echoes_of("gpu", random.scene, settings, random.pose);
  const std::uint32_t before = std::exchange(gpu::Commands::most_groups, 7);
  const EchoGrid in_rows = echoes_of("gpu", random.scene, settings, random.pose);
  gpu::Commands::most_groups = before;
  EXPECT_GT(total(expected, 2), 0);
  expect_same_bytes(in_rows, expected);
}

// Memory that is copied to a device and back, on a new device each time.
TEST_F(GpuEngineTest, DevicesComeAndGo) {
  const std::vector<std::uint32_t> values = {3, 1, 4, 1, 5, 9, 2, 6};
  for (int turn = 0; turn < 20; ++turn) {
    gpu::Device device(std::getenv("INSONIFY_DEVICE"));
    {
      gpu::Buffer there;
      gpu::upload(device, values, there);
      const gpu::Buffer back(device, there.bytes(), gpu::Memory::kToHost);
      gpu::Commands commands(device);
      commands.begin();
      commands.copy(there, 0, back, 0, there.bytes());
      commands.submit();
      commands.wait();
      EXPECT_TRUE(std::ranges::equal(values, std::span(back.data<std::uint32_t>(), values.size())));
      EXPECT_EQ(device.bytes(), there.bytes() + back.bytes());
    }
    EXPECT_EQ(device.bytes(), 0U);
  }
}

TEST_F(GpuEngineTest, EnginesComeAndGoInSeveralThreads) {
  const RandomScene random(6);
  const FlatPlanSettings settings{.sonar = random.sonar};
  const EchoGrid expected = echoes_of("gpu", random.scene, settings, random.pose);
  std::vector<std::thread> threads;
  for (int i = 0; i < 2; ++i) {
    threads.emplace_back([&] {
      for (int turn = 0; turn < 3; ++turn) {
        expect_same_bytes(echoes_of("gpu", random.scene, settings, random.pose), expected);
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
}

// Objects that are added, moved and removed, through the simulator.
TEST_F(GpuEngineTest, ChangedScenesGiveThePingsOfCpu) {
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.bin_count = 100;
  sonar.max_range = 20;
  std::vector<Ping> pings[2];
  for (const int which : {0, 1}) {
    Scenario scenario = quiet_scenario(sonar);
    scenario.engine = which == 0 ? "cpu" : "gpu";
    scenario.secondary = SecondaryEchoes::kSelective;
    Simulator simulator(scenario, SceneMaker().add_floor(-3).add_sphere({8, 0, -1}, 1).scene(), 1);
    const auto ping = [&] { simulator.ping(0, PingRequest(), pings[which].emplace_back()); };
    ping();
    const SceneMaker more = SceneMaker().add("box", make_box({1, 1, 1}), {.position = {12, 3, -2}});
    simulator.add_objects(more.scene());
    ping();
    simulator.remove_object("box");
    ping();
  }
  for (std::size_t i = 0; i < pings[0].size(); ++i) {
    double apart = 0, sum = 0;
    for (std::size_t cell = 0; cell < pings[0][i].intensity.size(); ++cell) {
      apart += std::abs(pings[0][i].intensity[cell] - pings[1][i].intensity[cell]);
      sum += pings[0][i].intensity[cell];
    }
    EXPECT_GT(sum, 0);
    EXPECT_LE(apart, 1e-3 * sum) << i;
  }
  EXPECT_NE(pings[1][0].intensity, pings[1][1].intensity);
  EXPECT_EQ(pings[1][0].intensity, pings[1][2].intensity);
}

// Rays that are not those of a ping, as cameras trace them.
TEST_F(GpuEngineTest, LooseRaysMeetObjectsWhereTheyWerePlaced) {
  Scene scene = SceneMaker().add_sphere({8, 0, 0}, 1).scene();
  scene.instances[0].moving = true;
  const auto engine = test_engine("gpu");
  engine->set_scene(scene);
  const std::vector<Ray> ray = {{.origin = Vec3::Zero(), .direction = Vec3::UnitX()}};
  std::vector<Hit> hit(1);
  engine->engine().trace(ray, hit);
  EXPECT_NEAR(hit[0].distance, 7, 1e-3);
  engine->move_instance(0, {.position = {5, 0, 0}});
  engine->engine().trace(ray, hit);
  EXPECT_NEAR(hit[0].distance, 4, 1e-3);
}

// The driver's answer when a card falls off the bus.
VkResult lose(VkQueue, std::uint32_t, const VkSubmitInfo*, VkFence) {
  return VK_ERROR_DEVICE_LOST;
}

TEST_F(GpuEngineTest, ALostDeviceIsSaid) {
  gpu::Device device(std::getenv("INSONIFY_DEVICE"));
  gpu::Commands commands(device);
  auto& table = const_cast<gpu::Vulkan&>(device.vulkan());
  const auto submit = std::exchange(table.QueueSubmit, lose);
  commands.begin();
  EXPECT_THROW(commands.submit(), gpu::DeviceLost);
  table.QueueSubmit = submit;
  commands.begin();
  table.QueueSubmit = lose;
  EXPECT_EQ(message_of([&] { commands.submit(); }),
            "device \"" + device.info().name + "\" was lost: cannot start a computation");
  table.QueueSubmit = submit;
}

}  // namespace
}  // namespace insonify::gpu_engine_test
