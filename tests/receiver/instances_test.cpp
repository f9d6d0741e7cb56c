// instances_test.cpp -- instances of a bin are summed and ranked by energy.

#include "receiver/instances.h"

#include <gtest/gtest.h>

namespace insonify::instances_test {
namespace {

SurfaceEcho echo_of(std::uint16_t instance, std::uint16_t material, float energy) {
  return {surface_label(instance, material), energy, 0.1F * energy, 0.01F * energy};
}

TEST(InstancesTest, TheStrongestComeFirst) {
  Instances instances;
  for (const SurfaceEcho& echo : {echo_of(4, 0, 1), echo_of(7, 0, 3), echo_of(2, 0, 2), echo_of(9, 0, 0.5F)}) {
    instances.add(echo);
  }
  const auto strongest = instances.strongest();
  ASSERT_EQ(strongest.size(), static_cast<std::size_t>(kStrongestCount));
  EXPECT_EQ(strongest[0].instance, 7);
  EXPECT_EQ(strongest[1].instance, 2);
  EXPECT_EQ(strongest[2].instance, 4);
}

TEST(InstancesTest, EqualsAreInTheOrderOfTheScene) {
  Instances instances;
  for (const std::uint16_t instance : {5, 3, 8}) {
    instances.add(echo_of(instance, 0, 1));
  }
  const auto strongest = instances.strongest();
  EXPECT_EQ(strongest[0].instance, 3);
  EXPECT_EQ(strongest[1].instance, 5);
  EXPECT_EQ(strongest[2].instance, 8);
}

TEST(InstancesTest, SurfacesOfOneInstanceAddUpAndTheStrongestGivesItsMaterial) {
  Instances instances;
  for (const SurfaceEcho& echo : {echo_of(1, 10, 1), echo_of(2, 20, 3.5F), echo_of(1, 11, 2), echo_of(1, 12, 1.5F)}) {
    instances.add(echo);
  }
  const auto strongest = instances.strongest();
  ASSERT_EQ(strongest.size(), 2U);
  EXPECT_EQ(strongest[0].instance, 1);
  EXPECT_EQ(strongest[0].material, 11);
  EXPECT_FLOAT_EQ(strongest[0].energy, 4.5F);
  EXPECT_NEAR(strongest[0].elevation_moment, 0.45, 1e-6);
  EXPECT_NEAR(strongest[0].elevation_square, 0.045, 1e-7);
}

}  // namespace
}  // namespace insonify::instances_test
