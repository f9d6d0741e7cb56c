// gpu_failure_test.cpp -- `engine: auto` goes on with `cpu` where a driver of Vulkan fails in the middle of a ping.

#include <gmock/gmock.h>

#include <utility>

#include "engines/card_engine.h"
#include "gpu/device.h"

namespace insonify::gpu_failure_test {
namespace {

using namespace testing_scenes;
using testing::ElementsAre;
using testing::HasSubstr;

// The driver's answers when a card falls off the bus, or has no memory left.
int submits = 0;
VkResult answer = VK_SUCCESS;
PFN_vkGetDeviceProcAddr find_function = nullptr;
PFN_vkQueueSubmit submit = nullptr;

VkResult submit_or_fail(VkQueue queue, std::uint32_t count, const VkSubmitInfo* work, VkFence done) {
  return submits-- > 0 ? submit(queue, count, work, done) : answer;
}

PFN_vkVoidFunction find_or_replace(VkDevice device, const char* name) {
  const PFN_vkVoidFunction found = find_function(device, name);
  if (std::string_view(name) != "vkQueueSubmit") {
    return found;
  }
  submit = reinterpret_cast<PFN_vkQueueSubmit>(found);
  return reinterpret_cast<PFN_vkVoidFunction>(submit_or_fail);
}

class GpuFailureTest : public AutoEngineTest {};

TEST_F(GpuFailureTest, ARealDeviceThatFailsIsReplaced) {
  if (std::ranges::find(usable_engines(), "gpu") == usable_engines().end()) {
    GTEST_SKIP() << "no device of Vulkan here";
  }
  auto& functions = const_cast<gpu::Vulkan&>(gpu::Instance::only().vulkan());
  find_function = std::exchange(functions.GetDeviceProcAddr, find_or_replace);
  card.inner = "gpu";
  for (const auto& [result, meant] : {std::pair(VK_ERROR_DEVICE_LOST, "\" was lost: cannot start a computation"),
                                      std::pair(VK_ERROR_OUT_OF_DEVICE_MEMORY, "\" has no memory left (")}) {
    answer = result;
    submits = 1'000'000;
    lines.clear();
    Simulator simulator(scenario("auto"), world_with_rod(), 2, movable,
                        [this](Severity, const std::string& text) { lines.push_back(text); });
    Simulator host(scenario("cpu"), world_with_rod(), 2, movable);
    (void)simulator.ping(0, {});
    EXPECT_EQ(simulator.scenario().engine, "card");
    submits = 2;  // In the middle of a ping, which has its samples from one engine and rays of sources from the other.
    constexpr double kBetweenEngines = 1e-3;
    EXPECT_LE(apart(simulator.ping(0, {.number = 1}), host.ping(0, {.number = 1})), kBetweenEngines);
    expect_same(simulator.ping(0, {.number = 2}), host.ping(0, {.number = 2}));
    EXPECT_EQ(simulator.scenario().engine, "cpu");
    EXPECT_THAT(lines, ElementsAre(HasSubstr(meant)));
  }
  functions.GetDeviceProcAddr = find_function;
}

}  // namespace
}  // namespace insonify::gpu_failure_test
