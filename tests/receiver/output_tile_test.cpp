// output_tile_test.cpp -- the label that a beam takes from several rows of a grid.

#include "receiver/output_tile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "echo/grid/echo.h"

namespace insonify::output_tile_test {
namespace {

constexpr int kBins = 150;                 // More than two tiles.
constexpr TilePlace kPlace{0, 2, 64, 64};  // The middle tile.

// Labels one cell of a grid.
void label(EchoGrid& grid, int row, int bin, std::uint16_t instance, float energy, float elevation) {
  const EchoGrid::Cells cells = grid.to_fill(1, row, {bin, bin + 1});
  *cells.surface = surface_label(instance, 0);
  *cells.surface_energy = energy;
  *cells.elevation_moment = energy * elevation;
}

TEST(OutputTileTest, BinTakesTheLabelOfTheRowWithMostEnergy) {
  EchoGrid grid(6, kBins, kPathOrders);
  // Rows 2, 3 and 4 belong to the beam; 1 and 5 to its neighbours.
  label(grid, 1, 70, 11, 9, 0.9F);
  label(grid, 2, 70, 12, 1, 0.1F);
  label(grid, 3, 70, 13, 3, 0.3F);
  label(grid, 4, 70, 14, 2, 0.2F);
  label(grid, 5, 70, 15, 9, 0.9F);
  // The strongest row is the first one, or the last.
  label(grid, 2, 90, 22, 3, -0.3F);
  label(grid, 3, 90, 23, 2, -0.2F);
  label(grid, 3, 100, 33, 1, -0.1F);
  label(grid, 4, 100, 34, 2, 0.2F);
  // In the next tile.
  label(grid, 3, 130, 43, 5, 0.5F);
  OutputTile tile = {};
  take_labels(grid, 2, 3, kPlace, 1, tile);
  EXPECT_TRUE(tile.has_labels);
  const auto expect_label = [&](int bin, std::uint16_t instance, float elevation) {
    EXPECT_EQ(instance_of(tile.surface[1][bin - kPlace.first_bin]), instance) << bin;
    EXPECT_FLOAT_EQ(tile.elevation[1][bin - kPlace.first_bin], elevation) << bin;
  };
  expect_label(70, 13, 0.3F);
  expect_label(90, 22, -0.3F);
  expect_label(100, 34, 0.2F);
  for (int i = 0; i < kTileBins; ++i) {
    const int bin = kPlace.first_bin + i;
    if (bin != 70 && bin != 90 && bin != 100) {
      EXPECT_EQ(instance_of(tile.surface[1][i]), kNoLabel) << bin;
      EXPECT_TRUE(std::isnan(tile.elevation[1][i])) << bin;
    }
  }
}

TEST(OutputTileTest, EmptyRowsGiveNoLabel) {
  EchoGrid grid(3, kBins, kPathOrders);
  label(grid, 2, 70, 12, 1, 0.1F);   // Another beam's ...
  label(grid, 1, 140, 12, 1, 0.1F);  // ... and beyond the tile.
  OutputTile tile = {};
  take_labels(grid, 0, 2, kPlace, 0, tile);
  EXPECT_FALSE(tile.has_labels);
}

}  // namespace
}  // namespace insonify::output_tile_test
