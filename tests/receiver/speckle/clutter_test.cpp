// clutter_test.cpp -- textures are constant within a patch.

#include "receiver/speckle/clutter.h"

#include <gtest/gtest.h>

#include <vector>

#include "echo/grid/echo.h"

namespace insonify {
namespace {

// Patches of three bins: the texture is the same within a patch, differs between neighbouring patches, and
// is 1 on other materials.
TEST(ClutterTest, TextureComesInPatches) {
  Material patchy, even;
  patchy.clutter_shape = 0.5;
  const Material materials[] = {even, patchy};
  const Clutter clutter(materials, 3);
  constexpr int kBins = 12;
  const SpeckleView view;
  const auto row_of = [&](std::uint32_t patch, std::uint16_t material) {
    ScattererRow row;
    row.resize(kBins);
    row.bins = {0, kBins};
    row.runs = {{.bins = row.bins, .view = &view, .key = {7, 8, 9, 10}}};
    row.surface.assign(kBins, surface_label(0, material));
    row.patch.assign(kBins, patch);
    for (std::uint32_t bin = 0; bin < kBins; ++bin) {
      row.index[bin] = 2 * (300 + bin);
    }
    std::vector<float> energy(kBins, 1.0F);
    clutter.texture(row, energy);
    return energy;
  };
  const std::vector<float> first = row_of(1000, 1);
  for (int bin = 0; bin < kBins; ++bin) {
    EXPECT_EQ(first[bin], first[bin - bin % 3]) << bin;
    EXPECT_NE(first[bin], first[(bin + 3) % kBins]) << bin;
  }
  EXPECT_NE(row_of(1002, 1), first);
  EXPECT_EQ(row_of(1000, 0), std::vector<float>(kBins, 1.0F));
}

}  // namespace
}  // namespace insonify
