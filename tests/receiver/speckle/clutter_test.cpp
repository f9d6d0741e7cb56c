// clutter_test.cpp -- textures are fixed on the bed, and change over their length.

#include "receiver/speckle/clutter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "echo/grid/echo.h"

namespace insonify {
namespace {

// A row of bins on a level bed 3 m below a sonar, straight ahead.
class ClutterTest : public testing::Test {
 protected:
  static constexpr int kBins = 600;

  static SonarConfig one_beam() {
    SonarConfig sonar;
    sonar.beam_count = 1;
    sonar.azimuth_aperture = 0.004;
    sonar.min_range = 5;
    sonar.max_range = 11;
    sonar.bin_count = kBins;
    return sonar;
  }

  // Place on the bed of a bin's middle, ahead of the sonar [m].
  static double ahead(int bin) { return std::sqrt(std::pow(one_beam().bin_range(bin), 2) - 9); }

  // Texture of the bins as seen from a place; the even bins lie on `material`, the odd ones on `other`.
  static std::vector<float> texture_from(const Vec3& position, std::span<const Material> materials, int material,
                                         int other) {
    const ScattererLattice lattice(one_beam(), 1, 0.002, one_beam().bin_length(), 5);
    const Clutter clutter(materials, one_beam(), lattice, 5);
    const SpeckleView view({.position = position});
    ScattererRow row;
    row.resize(kBins);
    row.bins = {0, kBins};
    row.runs = {{.bins = row.bins, .view = &view}};
    for (int bin = 0; bin < kBins; ++bin) {
      row.surface[bin] = surface_label(0, static_cast<std::uint16_t>(bin % 2 == 0 ? material : other));
      row.elevation[bin] = static_cast<float>(-std::asin(3 / one_beam().bin_range(bin)));
    }
    std::vector<float> energy(kBins, 1.0F);
    clutter.texture(row, 0, energy);
    return energy;
  }
};

TEST_F(ClutterTest, IsOneOnOtherMaterials) {
  Material patchy, even;
  patchy.clutter_shape = 0.5;
  const Material materials[] = {even, patchy};
  const std::vector<float> texture = texture_from({0, 0, 0}, materials, 1, 0);
  for (int bin = 0; bin < kBins; bin += 2) {
    EXPECT_NE(texture[bin], 1);
    EXPECT_EQ(texture[bin + 1], 1);
  }
}

// On the way over the bed, a lattice of edge L that is crossed at the angle t is left by (|cos t| + |sin t|) / L a
// metre; the four lattices, at angles of 22.5 degrees, together by 4 x 4 / pi = 5.1 / L on average over all directions.
TEST_F(ClutterTest, ChangesOverItsLength) {
  for (const double length : {0.25, 0.5, 2.0}) {
    Material patchy;
    patchy.clutter_shape = 2;
    patchy.clutter_length = length;
    double changes = 0, metres = 0;
    for (int place = 0; place < 60; ++place) {
      const std::vector<float> texture = texture_from({place * 7.3, place * -3.1, 0}, {&patchy, 1}, 0, 0);
      for (int bin = 1; bin < kBins; ++bin) {
        changes += texture[bin] != texture[bin - 1] ? 1 : 0;
      }
      metres += ahead(kBins - 1) - ahead(0);
    }
    const double expected = 16 / 3.14159265 / length;
    EXPECT_NEAR(changes / metres, expected, 4 * std::sqrt(expected / metres) + 0.05 * expected) << length;
  }
}

// From 1.7 m further on the same place of the bed has the same texture.
TEST_F(ClutterTest, IsFixedOnTheBed) {
  Material patchy;
  patchy.clutter_shape = 0.5;
  patchy.clutter_length = 0.4;
  const std::vector<float> first = texture_from({0, 0, 0}, {&patchy, 1}, 0, 0);
  const std::vector<float> later = texture_from({1.7, 0, 0}, {&patchy, 1}, 0, 0);
  int same = 0, compared = 0, same_bin = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double range = std::hypot(ahead(bin) - 1.7, 3);
    const int moved = static_cast<int>(std::lround((range - 5) / 0.01 - 0.5));
    if (moved >= 0) {
      compared += 1;
      same += first[bin] == later[moved] ? 1 : 0;
      same_bin += first[bin] == later[bin] ? 1 : 0;
    }
  }
  // The bins differ by up to half a bin of 1 to 1.3 cm, in which 5.1 / 0.4 boundaries a metre lie.
  EXPECT_GT(same, 0.9 * compared);
  EXPECT_LT(same_bin, 0.1 * compared);
}

}  // namespace
}  // namespace insonify
