// bearing_grid_test.cpp -- slices of bearing that touch, and such with gaps.

#include "insonify/bearing_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "insonify/sonar_config.h"

namespace insonify::bearing_grid_test {
namespace {

using testing::ElementsAre;

TEST(BearingGridTest, EvenSlicesTouchAndFillTheirExtent) {
  const BearingGrid grid = BearingGrid::even(1, 4, 4);
  EXPECT_THAT(grid.centres, ElementsAre(2.5, 1.5, 0.5, -0.5));
  EXPECT_THAT(grid.edges(), ElementsAre(3, 2, 1, 0, -1));
  EXPECT_EQ(grid.extent(), 4);
  EXPECT_EQ(grid.covered(), 4);
  EXPECT_FALSE(grid.has_gaps());
  EXPECT_THAT(grid.sines(), ElementsAre(std::sin(2.5), std::sin(1.5), std::sin(0.5), std::sin(-0.5)));
}

// Midway between 5, 3, 0: 4 and 1.5; outwards 5 + 1 and 0 - 1.5.
TEST(BearingGridTest, TouchingSlicesMeetMidwayBetweenCentres) {
  const BearingGrid grid = BearingGrid::touching({5, 3, 0});
  EXPECT_THAT(grid.port, ElementsAre(6, 4, 1.5));
  EXPECT_THAT(grid.starboard, ElementsAre(4, 1.5, -1.5));
  EXPECT_EQ(grid.width(1), 2.5);
}

TEST(BearingGridTest, GroupsOfSlicesHaveAGapBetween) {
  BearingGrid grid = BearingGrid::even(4, 4, 2);
  grid.add(BearingGrid::even(-4, 4, 2));
  EXPECT_THAT(grid.edges(), ElementsAre(6, 4, 4, 2, -2, -4, -4, -6));
  EXPECT_TRUE(grid.gap_after(1));
  EXPECT_EQ(grid.covered(), 8);
  SonarConfig sonar;
  sonar.set_bearings(grid);
  EXPECT_EQ(sonar.bearings().edges(), grid.edges());
  EXPECT_EQ(sonar.beam_count, 4);
  EXPECT_EQ(sonar.azimuth_aperture, 12) << "gaps included";
}

TEST(BearingGridTest, SlicesWithAGapHaveTheirOwnEdges) {
  BearingGrid grid;
  grid.add(2, 2.5, 1.5);
  grid.add(1, 1.5, 0.5);
  grid.add(-3, -2.5, -4);
  EXPECT_TRUE(grid.has_gaps());
  EXPECT_FALSE(grid.gap_after(0));
  EXPECT_TRUE(grid.gap_after(1));
  EXPECT_FALSE(grid.gap_after(2));
  EXPECT_THAT(grid.edges(), ElementsAre(2.5, 1.5, 1.5, 0.5, -2.5, -4));
  EXPECT_EQ(std::string_view(grid.edges_text()), "Beam b covers edges 2 b to 2 b + 1.");
  EXPECT_EQ(grid.extent(), 6.5);
  EXPECT_EQ(grid.covered(), 3.5);
}

TEST(BearingGridTest, SearchFindsTheSliceOfABearingFromAnyGuess) {
  BearingGrid grid;
  grid.add(2, 2.5, 1.5);
  grid.add(1, 1.5, 0.5);
  grid.add(-3, -2.5, -4);
  for (int guess = 0; guess < 3; ++guess) {
    EXPECT_EQ(grid.last_before(3, guess), 0);  // Beside the grid.
    EXPECT_EQ(grid.last_before(2.5, guess), 0);
    EXPECT_EQ(grid.last_before(1.5, guess), 1);  // A port edge belongs to its slice.
    EXPECT_EQ(grid.last_before(-1, guess), 1);   // In the gap.
    EXPECT_EQ(grid.last_before(-5, guess), 2);
  }
  EXPECT_TRUE(grid.has(1, 1.5));
  EXPECT_FALSE(grid.has(1, 0.5));
  EXPECT_FALSE(grid.has(1, -1));
  EXPECT_FALSE(grid.has(0, 3));
  EXPECT_FALSE(grid.has(2, -4));
}

}  // namespace
}  // namespace insonify::bearing_grid_test
