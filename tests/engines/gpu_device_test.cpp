// gpu_device_test.cpp -- devices of engine `gpu`: which there are, that they come and go, and what is said of a lost
// one.

#include <cstdlib>
#include <filesystem>
#include <span>
#include <thread>
#include <utility>

#include "engines/gpu_test.h"
#include "gpu/device.h"
#include "support/message_of.h"

namespace insonify::gpu_device_test {
namespace {

using namespace testing_scenes;

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

TEST(GpuDeviceFilesTest, ACardIsFoundByTheFilesOfItsDriver) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "dev";
  std::filesystem::remove_all(folder);
  EXPECT_FALSE(gpu::has_device_files(folder));
  std::filesystem::create_directories(folder / "dri" / "card0");
  std::filesystem::create_directories(folder / "nvme0");
  EXPECT_FALSE(gpu::has_device_files(folder));
  std::filesystem::create_directories(folder / "dri" / "renderD128");
  EXPECT_TRUE(gpu::has_device_files(folder));
  std::filesystem::remove_all(folder / "dri");
  std::filesystem::create_directories(folder / "nvidia0");
  EXPECT_TRUE(gpu::has_device_files(folder));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace insonify::gpu_device_test
