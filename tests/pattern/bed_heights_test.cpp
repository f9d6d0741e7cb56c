// bed_heights_test.cpp -- rasters of heights of the bed.

#include "insonify/bed_heights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pattern/pattern_scenes.h"
#include "support/message_of.h"

namespace insonify::bed_heights_test {
namespace {

using testing::ElementsAre;
using testing::FloatNear;
using testing::IsNan;
using testing_surveys::bed_scene;

// Middles at x = -1, 1 and y = 2, 0, -2.
TEST(BedHeightsTest, RowsBeginAtTheGreatestY) {
  const Scene scene = bed_scene(40, [](double x, double y) { return 0.25 * x + y; });
  EXPECT_THAT(bed_heights(scene, {{-2, -3}, {2, 3}, 2, 3}),
              ElementsAre(FloatNear(1.75, 1e-5), FloatNear(2.25, 1e-5), FloatNear(-0.25, 1e-5), FloatNear(0.25, 1e-5),
                          FloatNear(-2.25, 1e-5), FloatNear(-1.75, 1e-5)));
}

// Rays at x = -2/3, 0, 2/3 of a slope of 3: the mean is that of the middle, the highest 2 more.
TEST(BedHeightsTest, SeveralRaysGiveAMeanOrTheHighest) {
  const Scene scene = bed_scene(40, [](double x, double) { return 3 * x; });
  const PlanCells cell{{-1, -1}, {1, 1}, 1, 1};
  EXPECT_THAT(bed_heights(scene, cell, {.rays = 3}), ElementsAre(FloatNear(0, 1e-5)));
  EXPECT_THAT(bed_heights(scene, cell, {.rays = 3, .highest = true}), ElementsAre(FloatNear(2, 1e-5)));
}

TEST(BedHeightsTest, CellsWithoutABedHaveNone) {
  const Scene scene = bed_scene(40, [](double x, double) { return x > 10 ? std::nan("") : -5.0; });
  for (const bool highest : {false, true}) {
    EXPECT_THAT(bed_heights(scene, {{0, 0}, {30, 1}, 3, 1}, {.rays = 2, .highest = highest}),
                ElementsAre(-5, IsNan(), IsNan()));
  }
  EXPECT_THAT(bed_heights(scene, {{0, 0}, {5, 1}, 1, 1}, {.ceiling = -6}), ElementsAre(IsNan()));
}

// The middle of the cell from x = 2 to 4 is at 3; the highest ray goes through 3.667.
TEST(BedHeightsTest, ATruthHasTheCellsOfItsGrid) {
  const Scene scene = bed_scene(40, [](double x, double y) { return x - 10 * y; });
  SoundingGrid grid{.west = 2, .north = 1, .cell = 2, .columns = 1, .rows = 1};
  EXPECT_THAT(true_heights(grid, scene), ElementsAre(FloatNear(3, 1e-5)));
  grid.method = GridMethod::kShoal;
  EXPECT_THAT(true_heights(grid, scene), ElementsAre(FloatNear(3 + 2.0 / 3 + 20.0 / 3, 1e-4)));
  EXPECT_THAT(true_heights(grid, scene, -100), ElementsAre(IsNan()));
}

TEST(BedHeightsTest, RaysAreLimited) {
  EXPECT_EQ(message_of([] { (void)bed_heights({}, {}, {.rays = 17}); }), "rays = 17 must be from 1 to 16");
}

}  // namespace
}  // namespace insonify::bed_heights_test
