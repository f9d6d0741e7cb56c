// flat_plan_test.cpp -- which directions a planned sonar receives.

#include "echo/model/flat_plan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insonify::flat_plan_test {
namespace {

constexpr double kDegree = radians_from_degrees(1);

// A sphere of the radius r at the distance d is above or below the fan where its middle is more than asin(r / d) beyond
// an edge. Fans that look down and up, and edges on either side of level.
TEST(FlatPlanTest, SpheresBesideTheFanAreThoseThatReachNoDirectionInIt) {
  for (const double middle : {-35.0, 0.0, 22.0}) {
    SonarConfig sonar;
    sonar.elevation_aperture = 24 * kDegree;
    sonar.elevation_center = middle * kDegree;
    const auto plan = make_flat_plan({.sonar = sonar});
    for (const double radius : {0.1, 0.9}) {
      const double half = std::asin(radius / 4) / kDegree;
      for (double elevation = -85; elevation < 85; elevation += 0.7) {
        const double beyond = std::abs(elevation - middle) - 12;  // [deg]
        const Vec3f place(4 * static_cast<float>(std::cos(elevation * kDegree) * std::cos(0.3)),
                          4 * static_cast<float>(std::cos(elevation * kDegree) * std::sin(0.3)),
                          4 * static_cast<float>(std::sin(elevation * kDegree)));
        if (std::abs(beyond - half) > 0.01) {
          EXPECT_EQ(plan->receives_nothing_of(place, static_cast<float>(radius)), beyond > half)
              << middle << ", " << radius << ", " << elevation;
        }
      }
    }
  }
}

TEST(FlatPlanTest, BeamsMeetAtTheirEdges) {
  SonarConfig sonar;
  sonar.beam_count = 5;
  sonar.azimuth_aperture = 50 * kDegree;
  const auto plan = make_flat_plan({.sonar = sonar});
  for (int beam = 0; beam < 5; ++beam) {
    EXPECT_NEAR(plan->port_edges[beam] / kDegree, 25 - 10 * beam, 1e-5);
    EXPECT_EQ(plan->beam_of(plan->port_edges[beam]), beam);
    EXPECT_EQ(plan->beam_of(plan->port_edges[beam] - 1e-4F), beam);
  }
  EXPECT_NEAR(plan->starboard_edges[4] / kDegree, -25, 1e-5);
  EXPECT_EQ(plan->beam_of(plan->starboard_edges[4]), -1);
}

}  // namespace
}  // namespace insonify::flat_plan_test
