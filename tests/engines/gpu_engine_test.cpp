// gpu_engine_test.cpp -- what engine `gpu` adds to those on the host: devices, sums that do not depend on order, lists
// that grow. On Mesa's driver for the processor, unless INSONIFY_DEVICE names a card.

#include <map>
#include <thread>
#include <utility>

#include "engines/random_scene.h"
#include "gpu/device.h"
#include "support/message_of.h"

namespace insonify::gpu_engine_test {
namespace {

using namespace testing_scenes;

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

  Scene scene = SceneMaker().add_wall(8).scene();
  const auto refused = [&] {
    return message_of(
        [&] { (void)echoes_of("gpu", scene, {.model = EchoModel::kCalibrated, .materials = scene.materials}); });
  };
  EXPECT_EQ(refused(), "no error");
  scene.instances[0].reliefs = {std::make_shared<const Relief>(Relief{.slopes = {1, 1, {Eigen::Vector2f(0.1F, 0)}}})};
  EXPECT_EQ(refused(), "engine gpu computes no relief of materials yet; engine cpu does");
  EXPECT_EQ(message_of([&] { (void)echoes_of("gpu", scene, {}); }),
            "engine gpu computes no relief of materials yet; engine cpu does");
  scene.instances[0].reliefs.clear();
  scene.materials[0].open_share = 0.5;
  EXPECT_EQ(refused(),
            "engine gpu computes no materials that let sound through yet (open_share, thickness); engine cpu does");
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
