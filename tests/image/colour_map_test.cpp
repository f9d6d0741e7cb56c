// colour_map_test.cpp -- colour maps: published colours, brightness and names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "insonify/error.h"
#include "insonify/picture.h"

namespace insonify::colour_map_test {
namespace {

constexpr ColourMap kMaps[] = {ColourMap::kInferno, ColourMap::kCopper, ColourMap::kGrey, ColourMap::kBlue};

unsigned packed(Rgb colour) {
  return (colour.red << 16U) | (colour.green << 8U) | colour.blue;
}

// Relative luminance of Rec. 709 from the bytes; the curve of the screen does not change the order for grey, and is
// left out.
double luminance(Rgb colour) {
  return 0.2126 * colour.red + 0.7152 * colour.green + 0.0722 * colour.blue;
}

TEST(ColourMapTest, RunFromNearlyBlackToTheirBrightest) {
  EXPECT_EQ(packed(colour(ColourMap::kInferno, 0)), 0x000004U);  // First and last colour as published.
  EXPECT_EQ(packed(colour(ColourMap::kInferno, 1)), 0xfcffa4U);
  EXPECT_EQ(packed(colour(ColourMap::kCopper, 0)), 0x000000U);
  EXPECT_EQ(packed(colour(ColourMap::kCopper, 1)), 0xffc77fU);
  EXPECT_EQ(packed(colour(ColourMap::kGrey, 0)), 0x000000U);
  EXPECT_EQ(packed(colour(ColourMap::kGrey, 1)), 0xffffffU);
  EXPECT_EQ(packed(colour(ColourMap::kBlue, 0)), 0x00030cU);
  EXPECT_EQ(packed(colour(ColourMap::kBlue, 1)), 0xf2fbffU);
}

TEST(ColourMapTest, AStrongerEchoIsNeverDarker) {
  for (const ColourMap map : kMaps) {
    for (int i = 0; i < 64; ++i) {
      EXPECT_GT(luminance(colour(map, (i + 1) / 64.0)), luminance(colour(map, i / 64.0))) << i;
    }
    for (int i = 0; i < 1000; ++i) {
      // Each byte is rounded by itself, which may take half a step off the one and add half a step to the other.
      EXPECT_GT(luminance(colour(map, (i + 1) / 1000.0)), luminance(colour(map, i / 1000.0)) - 1) << i;
    }
    EXPECT_GT(luminance(colour(map, 1)), luminance(colour(map, 0)) + 150);
  }
}

// Colours 63, 127 and 191 of the 256 of matplotlib's inferno, in bytes.
TEST(ColourMapTest, InfernoIsThePublishedOne) {
  const auto expect_near = [](Rgb found, int red, int green, int blue) {
    EXPECT_NEAR(found.red, red, 2);
    EXPECT_NEAR(found.green, green, 2);
    EXPECT_NEAR(found.blue, blue, 2);
  };
  expect_near(colour(ColourMap::kInferno, 63 / 255.0), 85, 15, 109);
  expect_near(colour(ColourMap::kInferno, 127 / 255.0), 186, 54, 85);
  expect_near(colour(ColourMap::kInferno, 191 / 255.0), 248, 139, 10);
}

// Copper: red reaches its top at 0.8, green is 0.7812 v and blue 0.4975 v.
TEST(ColourMapTest, CopperFollowsItsFormula) {
  const Rgb middle = colour(ColourMap::kCopper, 0.5);
  EXPECT_NEAR(middle.red, 0.625 * 255, 1);
  EXPECT_NEAR(middle.green, 0.3906 * 255, 1);
  EXPECT_NEAR(middle.blue, 0.24875 * 255, 1);
}

TEST(ColourMapTest, ValuesOutsideAreDrawnAsTheNearestEnd) {
  for (const ColourMap map : kMaps) {
    EXPECT_EQ(packed(colour(map, -3)), packed(colour(map, 0)));
    EXPECT_EQ(packed(colour(map, 7)), packed(colour(map, 1)));
    EXPECT_EQ(packed(colour(map, std::numeric_limits<double>::infinity())), packed(colour(map, 1)));
    EXPECT_EQ(packed(colour(map, std::numeric_limits<double>::quiet_NaN())), packed(colour(map, 0)));
  }
}

TEST(ColourMapTest, AreFoundByName) {
  EXPECT_EQ(colour_map_from_name("inferno"), ColourMap::kInferno);
  EXPECT_EQ(colour_map_from_name("copper"), ColourMap::kCopper);
  EXPECT_EQ(colour_map_from_name("grey"), ColourMap::kGrey);
  EXPECT_EQ(colour_map_from_name("blue"), ColourMap::kBlue);
  EXPECT_THAT([] { (void)colour_map_from_name("viridis"); },
              testing::ThrowsMessage<Error>("colour map \"viridis\" must be one of inferno, copper, grey, blue"));
}

}  // namespace
}  // namespace insonify::colour_map_test
