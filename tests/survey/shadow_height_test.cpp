// shadow_height_test.cpp -- heights of posts by rays over their tops.

#include "insonify/survey/shadow_height.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/message_of.h"

namespace insonify::shadow_height_test {
namespace {

constexpr double kRounding = 1e-12;

// Altitude 6 m, a post of 2 m at 8 m: the ray over its top falls 4 m on 8 m, so it meets the bed at 12 m. Slant ranges:
// foot sqrt(64 + 36) = 10 m, top sqrt(64 + 16) = 8.944 m, end sqrt(144 + 36) = 13.416 m.
TEST(ShadowHeightTest, ByHand) {
  EXPECT_NEAR(height_from_shadow(6, 10, std::sqrt(180.0)), 2, kRounding);
  EXPECT_NEAR(height_from_highlight(6, std::sqrt(80.0), std::sqrt(180.0)), 2, kRounding);
  EXPECT_NEAR(shadow_length(6, 2, 8), 4, kRounding);
}

// Rays over the tops of posts of many heights and distances, from three altitudes.
TEST(ShadowHeightTest, InvertsTheGeometry) {
  for (const double altitude : {1.5, 10.0, 60.0}) {
    for (const double share : {0.01, 0.2, 0.7, 0.95}) {
      for (const double ground : {0.5, 20.0, 300.0}) {
        const double height = share * altitude, end = ground + shadow_length(altitude, height, ground);
        const double foot = std::hypot(ground, altitude), top = std::hypot(ground, altitude - height);
        const double far = std::hypot(end, altitude);
        EXPECT_NEAR(height_from_shadow(altitude, foot, far), height, 1e-9 * altitude);
        EXPECT_NEAR(height_from_highlight(altitude, top, far), height, 1e-9 * altitude);
      }
    }
  }
}

TEST(ShadowHeightTest, NoShadowIsNoHeight) {
  EXPECT_EQ(height_from_shadow(5, 13, 13), 0);
  EXPECT_EQ(height_from_highlight(5, 13, 13), 0);
}

TEST(ShadowHeightTest, BadInputIsRefused) {
  EXPECT_EQ(message_of([] { (void)height_from_shadow(0, 5, 6); }), "altitude = 0 m must be greater than 0 m");
  EXPECT_EQ(
      message_of([] { (void)height_from_shadow(5, 5, 6); }),
      "a shadow from 5 m to 6 m of slant range must begin beyond the altitude, 5 m, and end behind its beginning");
  EXPECT_EQ(
      message_of([] { (void)height_from_shadow(5, 8, 7); }),
      "a shadow from 8 m to 7 m of slant range must begin beyond the altitude, 5 m, and end behind its beginning");
  EXPECT_EQ(message_of([] { (void)height_from_highlight(5, 8, 7); }),
            "a highlight at 8 m and a shadow that ends at 7 m: the end must lie behind the highlight and beyond the "
            "altitude, 5 m");
  EXPECT_EQ(message_of([] { (void)shadow_length(5, 5, 7); }),
            "height = 5 m must be at least 0 m and less than the altitude, 5 m");
  EXPECT_EQ(message_of([] { (void)shadow_length(5, 2, 0); }), "ground_range = 0 m must be greater than 0 m");
}

}  // namespace
}  // namespace insonify::shadow_height_test
