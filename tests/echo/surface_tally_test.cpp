// surface_tally_test.cpp -- the tally of surfaces in a cell, against an exact count.

#include "echo/grid/surface_tally.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace insonify {
namespace {

constexpr double kRounding = 1e-5;  // Relative tolerance of sums of some hundred floats.

SurfaceEcho echo_of(std::uint32_t surface, float energy, float elevation = 0.1F) {
  return {surface, energy, energy * elevation, energy * elevation * elevation};
}

float energy_of(const SurfaceTally& tally, std::uint32_t surface) {
  for (const SurfaceEcho& echo : tally) {
    if (echo.surface == surface) {
      return echo.energy;
    }
  }
  return 0;
}

TEST(SurfaceTallyTest, IsExactForAsManySurfacesAsItKeeps) {
  SurfaceTally tally;
  for (int i = 0; i < 8; ++i) {
    add_surface(tally, echo_of(i % kSurfacesKept, static_cast<float>(i)));
  }
  // 0 + 4, 1 + 5, 2 + 6, 3 + 7.
  for (std::uint32_t surface = 0; surface < kSurfacesKept; ++surface) {
    EXPECT_EQ(energy_of(tally, surface), static_cast<float>(4 + 2 * surface));
  }
}

// Energies 5, 1, 2, 3 and a fifth surface with 2: all lose 1, the weakest is removed, and the new one takes its place.
TEST(SurfaceTallyTest, OneTooManyReducesEachByTheWeakest) {
  SurfaceTally tally;
  for (const auto& [surface, energy] : {std::pair{10U, 5.0F}, {11U, 1.0F}, {12U, 2.0F}, {13U, 3.0F}, {14U, 2.0F}}) {
    add_surface(tally, echo_of(surface, energy, 0.25F));
  }
  EXPECT_EQ(energy_of(tally, 10), 4);
  EXPECT_EQ(energy_of(tally, 11), 0);
  EXPECT_EQ(energy_of(tally, 12), 1);
  EXPECT_EQ(energy_of(tally, 13), 2);
  EXPECT_EQ(energy_of(tally, 14), 1);
  for (const SurfaceEcho& echo : tally) {
    EXPECT_EQ(echo.elevation_moment, 0.25F * echo.energy);
    EXPECT_EQ(echo.elevation_square, 0.0625F * echo.energy);
  }
}

// Energies are never too large, and too small by at most a fifth of the total.
TEST(SurfaceTallyTest, BoundsHoldForAnySurfaces) {
  std::mt19937 generator(1);
  double worst = 0;
  for (int round = 0; round < 2000; ++round) {
    const int surfaces = 2 + round % 12;
    SurfaceTally tally;
    std::map<std::uint32_t, double> exact;
    double all = 0;
    for (int i = 0; i < 60; ++i) {
      const std::uint32_t surface = std::uniform_int_distribution<>(0, surfaces - 1)(generator);
      const float energy = std::exponential_distribution<float>(1)(generator);
      add_surface(tally, echo_of(surface, energy));
      exact[surface] += energy;
      all += energy;
    }
    for (const auto& [surface, energy] : exact) {
      const double missing = (energy - energy_of(tally, surface)) / all;
      EXPECT_GE(missing, -kRounding);
      EXPECT_LE(missing, surfaces <= kSurfacesKept ? kRounding : 1.0 / (kSurfacesKept + 1) + kRounding);
      worst = std::max(worst, missing);
    }
  }
  EXPECT_GT(worst, 0.1);  // The test reaches the order of the bound.
}

}  // namespace
}  // namespace insonify
