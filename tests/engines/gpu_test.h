// gpu_test.h -- what tests of engine `gpu` have in common. They run on Mesa's driver for the processor, unless
// INSONIFY_DEVICE names a card.

#pragma once

#include <algorithm>

#include "engines/random_scene.h"

namespace insonify::testing_scenes {

class GpuEngineTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::ranges::find(usable_engines(), "gpu") == usable_engines().end()) {
      GTEST_SKIP() << "no device of Vulkan here";
    }
  }
};

inline void expect_same_bytes(const EchoGrid& a, const EchoGrid& b) {
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

}  // namespace insonify::testing_scenes
