// clutter_test.cpp -- quantiles of the gamma distribution, and textures that are constant within a patch.

#include "receiver/clutter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "echo/grid/echo.h"

namespace insonify {
namespace {

// The gamma distribution of shape 1 is the exponential distribution.
TEST(GammaQuantilesTest, ShapeOneIsExponential) {
  const GammaQuantiles quantiles(1);
  for (const double share : {1e-6, 0.001, 0.03, 0.1, 0.5, 0.9, 0.999, 1 - 1e-6}) {
    const double expected = -std::log1p(-share);
    EXPECT_NEAR(quantiles.at(static_cast<float>(std::log(share / (1 - share)))), expected, 1e-3 * expected + 2e-8)
        << share;
  }
}

TEST(GammaQuantilesTest, MeanIsOneAndVarianceOneOverShape) {
  for (const double shape : {0.1, 0.5, 2.0, 30.0, 1000.0}) {
    const GammaQuantiles quantiles(shape);
    double sum = 0, squares = 0;
    constexpr int kDraws = 1 << 20;
    for (int i = 0; i < kDraws; ++i) {
      const double value = quantiles.at(static_cast<float>(std::log((i + 0.5) / (kDraws - i - 0.5))));
      sum += value / kDraws, squares += value * value / kDraws;
    }
    EXPECT_NEAR(sum, 1, 0.005) << shape;
    EXPECT_NEAR((squares - sum * sum) * shape, 1, 0.02) << shape;
  }
}

// Patches of two cells by three bins: the texture is the same within a patch, differs between neighbouring patches, and
// is 1 on other materials.
TEST(ClutterTest, TextureComesInPatches) {
  Material patchy, even;
  patchy.clutter_shape = 0.5;
  const Material materials[] = {even, patchy};
  const Clutter clutter(materials, 2, 3);
  constexpr int kBins = 12;
  const auto row_of = [&](std::uint32_t bearing, std::uint16_t material) {
    Speckle::Row row;
    row.bins = {0, kBins};
    row.surface.assign(kBins, surface_label(0, material));
    row.bearing = bearing;
    for (std::uint32_t bin = 0; bin < kBins; ++bin) {
      row.range.push_back(300 + bin);
    }
    std::vector<float> energy(kBins, 1.0F);
    Speckle::View view;
    view.key = 7;
    clutter.texture(view, row, energy);
    return energy;
  };
  const std::vector<float> first = row_of(1000, 1);
  for (int bin = 0; bin < kBins; ++bin) {
    EXPECT_EQ(first[bin], first[bin - bin % 3]) << bin;
    EXPECT_NE(first[bin], first[(bin + 3) % kBins]) << bin;
  }
  EXPECT_EQ(row_of(1001, 1), first);
  EXPECT_NE(row_of(1002, 1), first);
  EXPECT_EQ(row_of(1000, 0), std::vector<float>(kBins, 1.0F));
}

}  // namespace
}  // namespace insonify
