// geographic_test.cpp -- metres of a world on the Earth against the ellipsoid's radii of curvature.

#include "insonify/survey/geographic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/message_of.h"

namespace insonify::geographic_test {
namespace {

// On the equator a degree of longitude has pi a / 180 = 111 319.491 m and one of latitude pi a (1 - e^2) / 180 =
// 110 574.276 m.
TEST(LocalGridTest, DegreesHaveTheMetresOfTheEllipsoid) {
  const LocalGrid grid({0, 10});
  const GeographicPoint place = grid.geographic({111.319491, -110.574276, 5});
  EXPECT_NEAR(place.longitude, 10.001, 1e-11);
  EXPECT_NEAR(place.latitude, -0.001, 1e-11);
  const Vec3 back = grid.local({-0.001, 10.001});
  EXPECT_NEAR(back.x(), 111.319491, 1e-5);
  EXPECT_NEAR(back.y(), -110.574276, 1e-5);
}

// The plane lies 0.3 m above the ellipsoid 2 km from the origin, 5e-8 of the Earth's radius: so much of 2 km is 0.1 mm.
TEST(LocalGridTest, PlacesComeBack) {
  for (const GeographicPoint origin : {GeographicPoint{48.5, -68.8}, {-33, 179.999}, {89, 0}}) {
    const LocalGrid grid(origin);
    const Vec3 point(1200, -1600, 0);
    EXPECT_LT((grid.local(grid.geographic(point)) - point).norm(), 2e-4) << origin.latitude;
  }
}

// At 60 degrees the radii of curvature are N = a / w = 6 394 209 m and M = a (1 - e^2) / w^3 = 6 383 454 m with
// w^2 = 1 - e^2 sin^2: 100 m are 0.0017921146 degrees of longitude (N cos 60) and 0.0008975671 of latitude.
TEST(LocalGridTest, RadiiAreThoseAtTheOrigin) {
  const GeographicPoint place = LocalGrid({60, 0}).geographic({100, 100, 0});
  EXPECT_NEAR(place.longitude, 0.0017921146, 1e-7);
  EXPECT_NEAR(place.latitude - 60, 0.0008975671, 1e-7);
}

TEST(LocalGridTest, PolesAreRefused) {
  EXPECT_EQ(message_of([] { (void)LocalGrid({90, 0}); }), "origin.latitude = 90 deg must be from -89 to 89 deg");
  EXPECT_EQ(message_of([] { (void)LocalGrid({0, 181}); }), "origin.longitude = 181 deg must be from -180 to 180 deg");
}

}  // namespace
}  // namespace insonify::geographic_test
