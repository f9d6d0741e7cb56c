// long_paths_test.cpp -- laws of paths over three surfaces: over the water's surface, and over a rough mirror both
// ways.

#include <gtest/gtest.h>

#include <cmath>

#include "echo/model/precise_echoes.h"

namespace insonify::long_paths_test {
namespace {

// From a point 3 m deep to a sonar 1 m deep, 3 m aside: (3, 0, 4), of which three quarters lie before the surface.
TEST(WaterLegTest, LeadsToTheSonarsImage) {
  const precise::WaterLeg leg = precise::water_leg(10, {5, 2, 9}, {2, 2, 7});
  EXPECT_NEAR(leg.first, 3.75, 1e-12);
  EXPECT_NEAR(leg.second, 1.25, 1e-12);
  EXPECT_NEAR(leg.cosine, 0.8, 1e-12);
  EXPECT_NEAR(leg.rising.x, 0.6, 1e-12);
  EXPECT_NEAR(leg.rising.y, 0, 1e-12);
  EXPECT_NEAR(leg.rising.z, 0.8, 1e-12);
}

// 1 mm / 0.8; and 1 mm / 0.02 = 50 mm where the way grazes the surface: 0.1 m deep on either end, 100 m apart.
TEST(WaterLegTest, RaysAreClearLongerWhereTheyGrazeTheSurface) {
  EXPECT_NEAR(precise::water_clearance(precise::water_leg(10, {5, 2, 9}, {2, 2, 7})), 1.25e-3, 1e-9);
  EXPECT_NEAR(precise::water_clearance(precise::water_leg(0, {100, 0, -0.1}, {0, 0, -0.1})), 0.05, 1e-9);
}

TEST(DoublePassageTest, ErrorFunctionKeepsSixDigits) {
  for (double x = -6; x < 6; x += 0.013) {
    EXPECT_NEAR(precise::error_function(x), std::erf(x), 1.6e-7) << x;
  }
}

// Straight onto a mirror 3 m away and 1 m back, as sound that is turned by nothing: the image lies 4 m ahead. Bearings
// change by one radian with the direction's y, along which the normal has nothing: lever 2/3, variance (2/3)^2 0.09.
TEST(DoublePassageTest, FacetsLieAboutTheImage) {
  const precise::RoughPath path = {{1, 0, 0}, {-1, 0, 0}, {-1, 0, 0}, 3, 1, {1, 0.09, 0.5}};
  for (const bool cone : {false, true}) {
    const precise::OtherFacets others = precise::other_facets(path, cone);
    EXPECT_NEAR(others.image.x, 1, 1e-12);
    EXPECT_NEAR(others.variance, 0.04, 1e-12);
  }
}

// At 60 degrees upwards, a wedge's bearings change by 1 / cos 60 = 2 radians with y, a cone's by one.
TEST(DoublePassageTest, BearingsOfWedgesTurnFasterAtHighElevations) {
  const double high = std::sqrt(0.75);
  const precise::RoughPath path = {{0.5, 0, high}, {-0.5, 0, -high}, {-0.5, 0, -high}, 3, 1, {1, 0.09, 0.5}};
  EXPECT_NEAR(precise::other_facets(path, false).variance, 0.16, 1e-12);
  EXPECT_NEAR(precise::other_facets(path, true).variance, 0.04, 1e-12);
}

// A cell of one standard deviation on either side has 68.27 % of the facets; of what they reflect, 1 - 0.5^2 is not
// coherent: 1 + 0.75 x 0.6827.
TEST(DoublePassageTest, GainsWhereBothWaysAreInOneCell) {
  EXPECT_NEAR(precise::double_passage(0.5, 0.04, -0.2, 0.2), 1.51202, 1e-5);
  EXPECT_NEAR(precise::double_passage(0.5, 0.04, 2, 3), 1, 1e-6);
  EXPECT_NEAR(precise::double_passage(1, 0.04, -0.2, 0.2), 1, 1e-12);
}

}  // namespace
}  // namespace insonify::long_paths_test
