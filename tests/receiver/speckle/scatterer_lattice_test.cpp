// scatterer_lattice_test.cpp -- windows of neighbouring bins share no scatterer, and stay where they are in the world.

#include "receiver/speckle/scatterer_lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

namespace insonify::scatterer_lattice_test {
namespace {

constexpr int kBins = 400;

SonarConfig one_cell() {
  SonarConfig cells;
  cells.beam_count = 1;
  cells.azimuth_aperture = 0.004;
  cells.min_range = 9;
  cells.max_range = 19;
  cells.bin_count = kBins;
  return cells;
}

// The row of a surface seen at an elevation that depends on range.
ScattererRow row_of(const std::function<double(double range)>& elevation, const Pose& pose = {}) {
  const SonarConfig cells = one_cell();
  EchoGrid grid(1, kBins, 1, GroundTruth::kLabels, true);
  const EchoGrid::Cells filled = grid.to_fill(1, 0, {0, kBins});
  for (int bin = 0; bin < kBins; ++bin) {
    filled.surface[bin] = surface_label(0, 0);
    filled.surface_energy[bin] = 2;
    filled.elevation_moment[bin] = static_cast<float>(2 * elevation(cells.bin_range(bin)));
  }
  const ScattererLattice lattice(cells.bearings(), cells, 1, 0.002, cells.bin_length(), 1);
  static SpeckleViews views;
  views.set(pose, {});
  ScattererRow row;
  lattice.locate(views, 0, {0, kBins}, grid, row);
  return row;
}

// The row of a grid in which only `bins` are filled, all at one elevation.
ScattererRow row_within(BinRange bins, double elevation, const Pose& pose) {
  EchoGrid grid(1, kBins, 1, GroundTruth::kLabels, true);
  const EchoGrid::Cells filled = grid.to_fill(1, 0, bins);
  for (int bin = 0; bin < bins.last - bins.first; ++bin) {
    filled.surface[bin] = surface_label(0, 0);
    filled.surface_energy[bin] = 2;
    filled.elevation_moment[bin] = static_cast<float>(2 * elevation);
  }
  const SonarConfig cells = one_cell();
  const ScattererLattice lattice(cells.bearings(), cells, 1, 0.002, cells.bin_length(), 1);
  static SpeckleViews views;
  views.set(pose, {});
  ScattererRow row;
  lattice.locate(views, 0, {0, kBins}, grid, row);
  return row;
}

// The scatterers of a bin: patch and index.
using Scatterer = std::pair<std::uint32_t, std::uint32_t>;
std::vector<Scatterer> scatterers_of(const ScattererRow& row, int bin) {
  std::vector<Scatterer> found;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const float place = (static_cast<float>(i) + 0.5F - row.begin[bin]) / std::abs(row.length[bin]);
    if (place >= 0 && place < 1) {
      found.emplace_back(row.patch[bin], row.index[bin] + i);
    }
  }
  return found;
}

double bed(double range) {
  return -std::asin(3.1 / range);
}
double wall(double range) {
  return std::acos(8.7 / range);
}
double slope(double range) {  // Rises by 40 degrees from 5 m ahead.
  const double turn = 40 * std::numbers::pi / 180;
  return turn - std::asin(5 * std::sin(turn) / range);
}
double ceiling(double range) {  // Falls towards the sonar: the level distance grows faster than the range.
  return std::asin(6.2 / range);
}

const Pose kSteep{Vec3(1.3, -2.1, 4.7), Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Vec3::UnitY()))};  // 63 degrees.

// The water's scatterers lie at elevation 0: those of bins that nothing fills are the same as of a surface there.
TEST(ScattererLatticeTest, UnfilledBinsAreThoseOfALevelSurface) {
  for (const Pose& pose : {Pose{}, kSteep}) {
    const ScattererRow water = row_within({120, 121}, -0.2, pose);
    const ScattererRow level = row_of([](double) { return 0.0; }, pose);
    for (int bin = 0; bin < kBins; ++bin) {
      if (std::abs(bin - 120) > 1) {
        EXPECT_EQ(water.patch[bin], level.patch[bin]) << bin;
        EXPECT_EQ(water.index[bin], level.index[bin]) << bin;
        EXPECT_EQ(water.begin[bin], level.begin[bin]) << bin;
        EXPECT_EQ(water.length[bin], level.length[bin]) << bin;
      }
    }
  }
}

// Elevations are smoothed along a surface, not beyond its first and last bin into the water.
TEST(ScattererLatticeTest, SurfacesKeepTheirElevationToTheirEnds) {
  for (const BinRange bins : {BinRange{60, 200}, BinRange{0, 90}, BinRange{310, kBins}}) {
    const ScattererRow row = row_within(bins, -0.3, kSteep);
    for (int bin = 0; bin < kBins; ++bin) {
      EXPECT_NEAR(row.elevation[bin], bins.has(bin) ? -0.3 : 0, 1e-6) << bins.first << ", " << bin;
    }
  }
}

TEST(ScattererLatticeTest, EachBinHasOneToThreeScatterersOfItsOwn) {
  for (const auto& surface : {bed, wall, slope, ceiling}) {
    const ScattererRow row = row_of(surface);
    std::set<Scatterer> seen;
    for (int bin = 0; bin < kBins; ++bin) {
      const std::vector<Scatterer> found = scatterers_of(row, bin);
      EXPECT_GE(found.size(), 1U) << bin;
      for (const Scatterer& one : found) {
        EXPECT_TRUE(seen.insert(one).second) << bin;
      }
    }
  }
}

// A sonar that has moved ahead and up meets the scatterers of a bed or a wall again, where they are now.
TEST(ScattererLatticeTest, ScatterersStayInTheWorld) {
  const double ahead = 0.613, up = 0.172;
  const auto range_of = [](const ScattererRow& row, int bin, std::size_t i) {
    const double place =
        (static_cast<double>(scatterers_of(row, bin)[i].second - row.index[bin]) + 0.5 - row.begin[bin]) /
        row.length[bin];
    return one_cell().bin_range(bin) + ((place < 0 ? 1 + place : place) - 0.5) * one_cell().bin_length();
  };
  struct Case {
    std::function<double(double)> before, after;
    std::function<double(double)> moved;  // Range of a scatterer after the motion.
  };
  const Case cases[] = {
      {bed, [&](double r) { return -std::asin((3.1 + up) / r); },
       [&](double r) { return std::hypot(std::sqrt(r * r - 3.1 * 3.1) - ahead, 3.1 + up); }},
      {wall, [&](double r) { return std::acos((8.7 - ahead) / r); },
       [&](double r) { return std::hypot(8.7 - ahead, std::sqrt(r * r - 8.7 * 8.7) - up); }},
  };
  for (const Case& c : cases) {
    const ScattererRow first = row_of(c.before), later = row_of(c.after, {.position = {ahead, 0, up}});
    std::map<Scatterer, double> found;
    for (int bin = 0; bin < kBins; ++bin) {
      for (std::size_t i = 0; i < scatterers_of(later, bin).size(); ++i) {
        found[scatterers_of(later, bin)[i]] = range_of(later, bin, i);
      }
    }
    int again = 0, all = 0;
    for (int bin = 60; bin < kBins - 40; ++bin) {
      for (std::size_t i = 0; i < scatterers_of(first, bin).size(); ++i) {
        const auto place = found.find(scatterers_of(first, bin)[i]);
        ++all;
        if (place != found.end()) {
          ++again;
          EXPECT_NEAR(place->second, c.moved(range_of(first, bin, i)), 0.0005) << bin;
        }
      }
    }
    EXPECT_GT(again, 0.9 * all);  // Where steps change their length, as the wall gets steeper, they are others.
  }
}

}  // namespace
}  // namespace insonify::scatterer_lattice_test
