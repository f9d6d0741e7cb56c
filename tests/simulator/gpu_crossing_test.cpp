// gpu_crossing_test.cpp -- engine `gpu` makes the pings of `cpu` whatever effects meet in them, and a batch of them in
// one submission gives the bytes of pings made alone.

#include "gpu/device.h"
#include "simulator/crossing.h"

namespace insonify::gpu_crossing_test {
namespace {

using namespace testing_scenes;

// Sum of the differences over the sum of the intensities by which both engines may differ. Single precision moves 1e-4
// of the energy to neighbouring bins, and speckle amplifies it: `cpu` differs from `reference`, which computes in
// double precision, by up to 4.4e-3 in these pings, and `gpu` by as much the other way.
constexpr double kApart = 1e-2;

// Share of the cells whose label may differ: those whose two strongest surfaces have nearly the same energy.
constexpr double kOtherLabels = 5e-3;

class GpuCrossingTest : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override {
    if (std::ranges::find(usable_engines(), "gpu") == usable_engines().end()) {
      GTEST_SKIP() << "no device of Vulkan here";
    }
  }
};

// Random walks have no relief: it turns the rounding of one hit into another direction of the next ray.
Scene scene_for_both(unsigned effects) {
  Scene scene = crossing_scene(effects);
  for (Instance& instance : scene.instances) {
    if ((effects & kWalks) != 0) {
      instance.reliefs.clear();
    }
  }
  return scene;
}

template <typename Label>
void expect_same_labels(const std::vector<Label>& gpu, const std::vector<Label>& cpu) {
  ASSERT_EQ(gpu.size(), cpu.size());
  std::size_t others = 0;
  for (std::size_t cell = 0; cell < cpu.size(); ++cell) {
    others += gpu[cell] != cpu[cell] ? 1 : 0;
  }
  EXPECT_LE(static_cast<double>(others), kOtherLabels * static_cast<double>(cpu.size()))
      << others << " of " << cpu.size() << " labels";
}

// With random walks one walk may pass an edge on its other side: labels are not compared, and pings may differ by more.
void expect_alike(const Ping& gpu, const Ping& cpu, bool walks) {
  EXPECT_LE(apart(cpu, gpu), (walks ? 2 : 1) * kApart);
  if (!walks) {
    expect_same_labels(gpu.instance, cpu.instance);
    expect_same_labels(gpu.path_order, cpu.path_order);
  }
}

TEST_P(GpuCrossingTest, GivesThePingsOfCpuAndBatchesTheBytesOfPingsMadeAlone) {
  const unsigned effects = GetParam();
  const Scene scene = scene_for_both(effects);
  Simulator cpu(crossing_scenario(effects, "cpu"), scene, 2, crossing_objects());
  CrossingOrders expected(cpu.scenario(), effects);
  cpu.ping(expected.orders);
  Simulator gpu(crossing_scenario(effects, "gpu"), scene, 2, crossing_objects());
  CrossingOrders alone(gpu.scenario(), effects), batch(gpu.scenario(), effects);
  for (const PingOrder& order : alone.orders) {
    gpu.ping({&order, 1});
  }
  gpu.ping(batch.orders);
  for (std::size_t i = 0; i < batch.pings.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "ping " << i);
    expect_alike(batch.pings[i], expected.pings[i], (effects & kWalks) != 0);
    expect_same(batch.pings[i], alone.pings[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, GpuCrossingTest, testing::ValuesIn(kCrossings));

class GpuSubmissionTest : public GpuCrossingTest {};
INSTANTIATE_TEST_SUITE_P(Models, GpuSubmissionTest, testing::Values(kPaper, 0U),
                         [](const auto& test) { return test.param == kPaper ? "Paper" : "Calibrated"; });

// Three sonars of different sizes, and objects elsewhere from ping to ping. Two submissions: the probe rays that decide
// how many hits reflect, and the pings. In the calibrated model sources of echoes may ask for rays, in one round more.
TEST_P(GpuSubmissionTest, AllSonarsOfAVehicleAreOneSubmission) {
  const unsigned effects = GetParam() | kTwo | kHead | kMoved;
  Simulator simulator(crossing_scenario(effects, "gpu"), scene_for_both(effects), 2, crossing_objects());
  CrossingOrders batch(simulator.scenario(), effects);
  simulator.ping(batch.orders);  // Memory grows to what the pings need.
  const auto submissions_of = [&](std::span<const PingOrder> orders) {
    const std::uint64_t before = gpu::Commands::submissions;
    simulator.ping(orders);
    return gpu::Commands::submissions - before;
  };
  const std::uint64_t expected = GetParam() == kPaper ? 2 : 3;
  EXPECT_EQ(submissions_of(batch.orders), expected);
  for (const PingOrder& order : batch.orders) {
    simulator.ping({&order, 1});
    EXPECT_LE(submissions_of({&order, 1}), expected);
  }
}

}  // namespace
}  // namespace insonify::gpu_crossing_test
