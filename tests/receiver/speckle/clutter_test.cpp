// clutter_test.cpp -- textures are fixed on the bed, and change over their length.

#include "receiver/speckle/clutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "echo/grid/echo.h"

namespace insonify::clutter_test {
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

  static Clutter clutter_of(std::span<const Material> materials) {
    const ScattererLattice lattice(one_beam().bearings(), one_beam(), 1, 0.002, one_beam().bin_length(), 5);
    return {materials, one_beam().bearings(), lattice, 5};
  }

  static Clutter patches(double shape, double length) {
    Material patchy;
    patchy.clutter_shape = shape;
    patchy.clutter_length = length;
    return clutter_of({&patchy, 1});
  }

  // Texture of the bins as seen from a place; the even bins lie on `material`, the odd ones on `other`.
  static std::vector<float> texture_from(const Vec3& position, const Clutter& clutter, int material = 0,
                                         int other = 0) {
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
  const std::vector<float> texture = texture_from({0, 0, 0}, clutter_of(materials), 1, 0);
  for (int bin = 0; bin < kBins; bin += 2) {
    EXPECT_NE(texture[bin], 1);
    EXPECT_EQ(texture[bin + 1], 1);
  }
}

// Along the bed the texture of two bins is as alike as its correlation says, which texture_correlation.h derives: 0.47
// half a length apart, 0.035 a length apart.
TEST_F(ClutterTest, ChangesOverItsLength) {
  for (const double length : {0.25, 0.5, 1.0}) {
    const Clutter clutter = patches(2, length);
    double half = 0, whole = 0, pairs = 0;
    constexpr int kPlaces = 3000;
    for (int place = 0; place < kPlaces; ++place) {
      const std::vector<float> texture = texture_from({place * 7.3, place * -3.1, 0}, clutter);
      int at_half = 0, at_whole = 0;
      while (ahead(at_half) < ahead(0) + 0.5 * length) {
        ++at_half;
      }
      while (ahead(at_whole) < ahead(0) + length) {
        ++at_whole;
      }
      pairs += 1;
      half += (texture[0] - 1) * (texture[at_half] - 1);
      whole += (texture[0] - 1) * (texture[at_whole] - 1);
    }
    EXPECT_NEAR(2 * half / pairs, 0.47, 0.09) << length;
    EXPECT_NEAR(2 * whole / pairs, 0.035, 0.08) << length;
  }
}

// Patches have no edges: from bin to bin, 1 to 1.3 cm, a texture of 2 m changes little, though it varies a hundredfold.
TEST_F(ClutterTest, ChangesSmoothly) {
  const Clutter clutter = patches(0.5, 2);
  float most = 0, least = 1, greatest = 1;
  for (int place = 0; place < 60; ++place) {
    const std::vector<float> texture = texture_from({place * 7.3, place * -3.1, 0}, clutter);
    for (int bin = 1; bin < kBins; ++bin) {
      most = std::max(most, std::abs(texture[bin] - texture[bin - 1]) / std::max(texture[bin], 1.0F));
      least = std::min(least, texture[bin]);
      greatest = std::max(greatest, texture[bin]);
    }
  }
  EXPECT_LT(most, 0.1F);
  EXPECT_LT(least, 0.001F);
  EXPECT_GT(greatest, 4.0F);
}

// From 1.7 m further on the same place of the bed has the same texture, within half a bin of 1 to 1.3 cm.
TEST_F(ClutterTest, IsFixedOnTheBed) {
  const Clutter clutter = patches(0.5, 0.4);
  const std::vector<float> first = texture_from({0, 0, 0}, clutter);
  const std::vector<float> later = texture_from({1.7, 0, 0}, clutter);
  double same = 0, same_bin = 0;
  int compared = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double range = std::hypot(ahead(bin) - 1.7, 3);
    const int moved = static_cast<int>(std::lround((range - 5) / 0.01 - 0.5));
    if (moved >= 0) {
      compared += 1;
      same += std::abs(first[bin] - later[moved]);
      same_bin += std::abs(first[bin] - later[bin]);
    }
  }
  EXPECT_LT(same / compared, 0.05);
  EXPECT_GT(same_bin / compared, 0.3);
}

}  // namespace
}  // namespace insonify::clutter_test
