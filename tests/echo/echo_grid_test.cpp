// echo_grid_test.cpp -- filled intervals, clearing and initialisation of the cells of an EchoGrid.

#include "echo/grid/echo_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "echo/grid/echo.h"
#include "echo/grid/surface_label.h"

namespace insonify::echo_grid_test {
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
        cells.energy[i] = cells.weight[i] = cells.surface_energy[i] = cells.elevation_moment[i] = 1;
        cells.elevation_square[i] = 1;
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

constexpr float kMiddleElevation = 0.25F;

// Adds to one cell as a column of samples does: one echo after another, each of one surface.
void add_echo(EchoGrid& grid, std::uint32_t surface, float energy, float elevation) {
  const EchoGrid::Cells cells = grid.to_fill(1, 2, {7, 8});
  const float moment = energy * elevation, beyond = elevation - kMiddleElevation, square = energy * beyond * beyond;
  const auto sum = add_to_strongest(
      StrongestSurface<SurfaceLabel, float>{*cells.surface, *cells.surface_energy, *cells.elevation_moment}, surface,
      energy, moment, 1.0F);
  if (sum.elsewhere != 0) {
    grid.add_further(2, 7, {surface, energy, moment, square});
    return;
  }
  *cells.elevation_square = (*cells.surface == kNoSurface ? 0 : *cells.elevation_square) + square;
  *cells.surface = sum.cell.surface;
  *cells.surface_energy = sum.cell.energy;
  *cells.elevation_moment = sum.cell.moment;
}

// Many surfaces, none with half of the energy. All numbers are such that sums are exact in single precision.
TEST(EchoGridTest, LabelsDoNotDependOnTheOrderOfEchoes) {
  std::mt19937 generator(3);
  for (int round = 0; round < 200; ++round) {
    const int surfaces = 1 + round % 9;
    std::vector<std::tuple<std::uint32_t, float, float>> echoes;
    std::map<std::uint32_t, float> energies, moments;
    for (int i = 0; i < 40; ++i) {
      const std::uint32_t surface = std::uniform_int_distribution<std::uint32_t>(0, surfaces - 1)(generator);
      const auto energy = static_cast<float>(std::uniform_int_distribution<>(0, 15)(generator));
      const float elevation = 0.125F * static_cast<float>(surface);
      echoes.emplace_back(surface, energy, elevation);
      energies[surface] += energy;
      moments[surface] += energy * elevation;
    }
    // The first of the strongest, as maps are sorted by surface.
    const auto strongest = std::ranges::max_element(energies, {}, [](const auto& entry) { return entry.second; });
    for (int order = 0; order < 5; ++order) {
      std::ranges::shuffle(echoes, generator);
      EchoGrid grid(kBeams, kBins, 1, GroundTruth::kFull);
      for (const auto& [surface, energy, elevation] : echoes) {
        add_echo(grid, surface, energy, elevation);
      }
      ASSERT_EQ(grid.label(2, 7).material, strongest->first);
      ASSERT_EQ(grid.label(2, 7).elevation, moments[strongest->first] / strongest->second);
      std::size_t visited = 0;
      grid.for_each_surface(2, 7, [&](const SurfaceEcho& echo) {
        ++visited;
        const float beyond = 0.125F * static_cast<float>(echo.surface) - kMiddleElevation;
        ASSERT_EQ(echo.energy, energies[echo.surface]);
        ASSERT_EQ(echo.elevation_moment, moments[echo.surface]);
        ASSERT_EQ(echo.elevation_square, echo.energy * beyond * beyond);
      });
      ASSERT_EQ(visited, energies.size());
    }
  }
}

// A beam that is used again, or whose cells are copied to another grid, keeps nothing of other cells' surfaces.
TEST(EchoGridTest, CopiesOfCellsHaveAllTheirSurfaces) {
  EchoGrid grid(kBeams, kBins, 1, GroundTruth::kFull), copy = grid;
  for (int ping = 0; ping < 2; ++ping) {
    grid.clear();
    for (const std::uint32_t surface : {4, 9, 4, 2}) {
      add_echo(grid, surface, 3, 0.5F);
    }
    std::vector<std::int32_t> sources(kBins, -1);
    sources[11] = 2 * kBins + 7;
    copy.take_cells(grid, 1, sources);
    std::vector<std::pair<std::uint32_t, float>> found;
    copy.for_each_surface(1, 11, [&](const SurfaceEcho& echo) { found.emplace_back(echo.surface, echo.energy); });
    std::ranges::sort(found);
    EXPECT_EQ(found, (std::vector<std::pair<std::uint32_t, float>>{{2, 3}, {4, 6}, {9, 3}}));
    EXPECT_EQ(copy.label(1, 11).material, 4);
  }
}

TEST(EchoGridTest, RangesOfBinsMeetAndJoin) {
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
}  // namespace insonify::echo_grid_test
