// echo_grid_test.cpp -- filled intervals, clearing and initialisation of the cells of an EchoGrid.

#include "insonify/echo_grid.h"

#include <gtest/gtest.h>

#include "echo/grid/echo.h"

namespace insonify {
namespace {

constexpr int kBeams = 4, kBins = 30;

float total(const EchoGrid& grid) {
  float sum = 0;
  for (int order = 1; order <= grid.order_count(); ++order) {
    for (int beam = 0; beam < kBeams; ++beam) {
      for (int bin = 0; bin < kBins; ++bin) {
        sum += grid.energy(order, beam)[bin] + grid.weight(order, beam)[bin];
      }
    }
  }
  return sum;
}

TEST(EchoGridTest, FilledBinsAreThoseAskedFor) {
  EchoGrid grid(kBeams, kBins, 2);
  EXPECT_TRUE(grid.filled(2).empty());
  grid.to_fill(1, 2, {10, 12}).energy[1] = 5;
  EXPECT_EQ(grid.energy(1, 2)[11], 5);
  grid.to_fill(2, 2, {20, 21}).weight[0] = 3;
  EXPECT_EQ(grid.weight(2, 2)[20], 3);
  EXPECT_EQ(grid.filled(2).first, 10);
  EXPECT_EQ(grid.filled(2).last, 21);
  EXPECT_TRUE(grid.filled(1).empty());
  EXPECT_EQ(total(grid), 8);
}

TEST(EchoGridTest, ClearLeavesNothingInAnyLayer) {
  EchoGrid grid(kBeams, kBins, 2, GroundTruth::kFull);
  for (const int beam : {1, 3}) {
    for (const int order : {1, 2}) {
      const EchoGrid::Cells cells = grid.to_fill(order, beam, {5 * beam, 5 * beam + 4});
      for (int i = 0; i < 4; ++i) {
        cells.energy[i] = cells.weight[i] = cells.label_energy[i] = cells.lead[i] = cells.elevation_moment[i] = 1;
        cells.surface[i] = surface_label(2, 1);
      }
    }
    grid.met_before(beam) = 1;
  }
  EXPECT_EQ(grid.label(3, 16).instance, 2);
  grid.clear(0, 2);
  EXPECT_TRUE(grid.filled(1).empty());
  EXPECT_EQ(grid.label(1, 6).instance, kNoLabel);
  EXPECT_EQ(grid.filled(3).first, 15);
  EXPECT_EQ(total(grid), 16);
  grid.clear();
  EXPECT_EQ(total(grid), 0);
  for (const int beam : {1, 3}) {
    EXPECT_EQ(grid.met_before(beam), 0);
    const EchoGrid::Cells cells = grid.to_fill(1, beam, {0, kBins});
    for (int bin = 0; bin < kBins; ++bin) {
      EXPECT_EQ(cells.surface[bin], kNoSurface);
    }
  }
}

// Extending the filled interval initialises the new cells only.
TEST(EchoGridTest, CellsAreSetUpOnce) {
  EchoGrid grid(kBeams, kBins, 1);
  const auto name = [&](int bin, std::uint16_t instance) {
    *grid.to_fill(1, 0, {bin, bin + 1}).surface = surface_label(instance, 0);
  };
  name(10, 4);
  name(14, 5);
  name(8, 6);
  const std::uint32_t* surface = grid.to_fill(1, 0, {7, 16}).surface;
  const SurfaceLabel named[] = {surface_label(6, 0), surface_label(4, 0), surface_label(5, 0)};
  const SurfaceLabel expected[] = {kNoSurface, named[0],   kNoSurface, named[1],  kNoSurface,
                                   kNoSurface, kNoSurface, named[2],   kNoSurface};
  EXPECT_TRUE(std::equal(std::begin(expected), std::end(expected), surface));
}

TEST(EchoGridTest, BinRangesIntersectAndJoin) {
  const BinRange a{2, 8}, b{6, 11}, none;
  EXPECT_EQ((a & b).first, 6);
  EXPECT_EQ((a & b).last, 8);
  EXPECT_TRUE((a & BinRange{8, 9}).empty());
  EXPECT_EQ((a | b).first, 2);
  EXPECT_EQ((a | b).last, 11);
  EXPECT_EQ((a | none).last, 8);
  EXPECT_EQ((none | a).first, 2);
}

}  // namespace
}  // namespace insonify
