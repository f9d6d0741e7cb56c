// ssiv_scene_test.cpp -- ranges, bearings and shadows of the SSIV scene against its geometry.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scenes/mesh_probe.h"
#include "scenes/scene_ping.h"

namespace insonify::ssiv_scene_test {
namespace {

using testing_scenes::Probe;
using testing_scenes::ScenePing;

// Dimensions of the mock-up [m].
constexpr double kLegX = 1.3, kLegY = 1.1, kLegRadius = 0.0842;
constexpr double kRoof = 1.75;  // Axis of the upper ring.

const ScenePing& primary_ping() {
  static const ScenePing ping("ssiv", [](Scenario& scenario) { scenario.secondary = SecondaryEchoes::kNone; });
  return ping;
}

// scenes/ssiv.sdf: 6.4 0.1 0.05, roll 0.5, pitch -0.7, yaw -68 degrees.
Vec3 world_from_ssiv(const Vec3& p) {
  const auto about = [](double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(radians_from_degrees(degrees), axis);
  };
  return Vec3(6.4, 0.1, 0.05) +
         about(-68, Vec3::UnitZ()) * (about(-0.7, Vec3::UnitY()) * (about(0.5, Vec3::UnitX()) * p));
}

struct Leg {
  const char* name;
  double x, y;
  double seen;  // Least fraction of its height at which its echo must be the only one in its cell.
};

class SsivLegTest : public testing::TestWithParam<Leg> {};

// A leg is vertical and round: its echo at each height comes from the generatrix that faces the sonar, one radius
// nearer than the axis in plan. In some cells other members overlay it (a picture has no height); those have another
// elevation.
TEST_P(SsivLegTest, StandsAtItsRangeAndBearing) {
  const ScenePing& ping = primary_ping();
  const Vec3 sonar = ping.world_from_sonar().position;
  const auto [name, x, y, least] = GetParam();
  double levels = 0;
  double seen = 0;
  double beside = 0;
  for (double z = 0.4; z < kRoof - 0.1; z += 0.05) {
    const Vec3 axis = world_from_ssiv({x, y, z});
    const Vec3 out = Vec3(sonar.x() - axis.x(), sonar.y() - axis.y(), 0).normalized();
    const auto front = ping.sighting(axis + kLegRadius * out);
    const int beam = ping.beam_at(front.azimuth);
    const auto is_leg = [&](int bin, int in_beam) {
      constexpr double kTolerance = 0.01;  // 0.6 degrees: 7 cm of the leg's height.
      return ping.visual(bin, in_beam) == "mockup" &&
             std::abs(ping.elevation(bin, in_beam) - front.elevation) < kTolerance;
    };
    // Within two bins of its range, in the beam whose centre is within half a beam of its bearing ...
    const int bin = ping.bin_at(front.range);
    bool here = false;
    for (int near = bin - 2; near <= bin + 2; ++near) {
      here = here || is_leg(near, beam);
    }
    // ... and no wider than the leg: there is no echo a diameter and two beams to the side.
    const double width = 2 * kLegRadius / std::hypot(axis.x() - sonar.x(), axis.y() - sonar.y());
    const double beam_width = radians_from_degrees(120.0 / 256);
    bool aside = false;
    for (const double side : {-1.0, 1.0}) {
      aside = aside || is_leg(bin, ping.beam_at(front.azimuth + side * (width + 2 * beam_width)));
    }
    levels += 1;
    seen += here ? 1 : 0;
    beside += here && aside ? 1 : 0;
  }
  RecordProperty("seen", std::to_string(seen / levels));
  RecordProperty("beside", std::to_string(beside / levels));
  EXPECT_GE(seen / levels, least);
  EXPECT_LE(beside, 0.34 * seen);
}

INSTANTIATE_TEST_SUITE_P(Legs, SsivLegTest,
                         testing::Values(Leg{"front_port", -kLegX, -kLegY, 0.8},
                                         Leg{"front_starboard", kLegX, -kLegY, 0.8},
                                         Leg{"back_port", -kLegX, kLegY, 0.4},
                                         Leg{"back_starboard", kLegX, kLegY, 0.4}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SsivSceneTest, NearestEchoIsTheCapOfTheNearestLeg) {
  // The cap's rim is 0.1 m wide and 0.085 to 0.105 m above the ring's axis.
  const ScenePing& ping = primary_ping();
  const Vec3 sonar = ping.world_from_sonar().position;
  const Vec3 axis = world_from_ssiv({-kLegX, -kLegY, kRoof + 0.105});
  const auto rim = ping.sighting(axis + 0.1 * Vec3(sonar.x() - axis.x(), sonar.y() - axis.y(), 0).normalized());
  int nearest_bin = ping.ping().bin_count;
  int nearest_beam = -1;
  for (int beam = 0; beam < ping.ping().beam_count; ++beam) {
    const int bin = ping.first_bin_of("mockup", beam);
    if (bin >= 0 && bin < nearest_bin) {
      nearest_bin = bin;
      nearest_beam = beam;
    }
  }
  EXPECT_NEAR(ping.sonar().bin_range(nearest_bin), rim.range, 2 * ping.sonar().bin_length());
  EXPECT_NEAR(nearest_beam, ping.beam_at(rim.azimuth), 1);
}

TEST(SsivSceneTest, PipeBesideTheFrameCastsTheShadowOfItsHeight) {
  // The port end of the pipe, 219 mm thick and half a metre up, between its two flanges.
  const ScenePing& ping = primary_ping();
  Probe bed("ssiv_bed");
  constexpr double kRadius = 0.1095;
  const testing_scenes::StraightPipe pipe{world_from_ssiv({-2.25, 0, 0.52}),
                                          world_from_ssiv(Vec3::UnitX()) - world_from_ssiv(Vec3::Zero()), kRadius};
  for (const double x : {-2.15, -2.25, -2.35}) {
    const int beam = ping.beam_at(ping.sighting(world_from_ssiv({x, 0, 0.52})).azimuth);
    const auto shadow = testing_scenes::shadow_of_pipe(ping.world_from_sonar(), ping.sonar().beam_azimuth(beam), pipe,
                                                       [&](double u, double v) { return bed.height(u, v); });
    const double bin = ping.sonar().bin_length();
    const double step = 5 * bin;  // 6 cm: where a tangent reaches ripples 4 cm high, smeared by the beam's width.
    const auto silence = ping.silence_around((shadow.from + shadow.to) / 2, beam);
    EXPECT_NEAR(silence.from, shadow.from, step) << x;
    EXPECT_NEAR(silence.to, shadow.to, step) << x;
    EXPECT_NEAR(silence.to - silence.from, shadow.to - shadow.from, 1.5 * step) << x;
  }
}

TEST(SsivSceneTest, SinkerHidesTheBedAsFarAsItsHeightReaches) {
  // length = height * range / (sonar's height - height), for the ray over its far upper edge to the bed. The sinker's
  // sides are parallel to the sonar's line of sight, 25 degrees to port; its top is 0.54 m square.
  const ScenePing& ping = primary_ping();
  const Vec3 sonar = ping.world_from_sonar().position;
  Probe things("ssiv_surroundings");
  Probe bed("ssiv_bed");
  const double yaw = radians_from_degrees(25);
  const Vec3 along(std::cos(yaw), std::sin(yaw), 0);
  Vec3 edge = Vec3(9.0, 4.3, 0) + 0.26 * along + 0.12 * along.cross(Vec3::UnitZ());  // Away from the eye.
  edge.z() = things.height(edge.x(), edge.y());
  ASSERT_GT(edge.z(), 0.35);
  const double end = testing_scenes::range_on_bed(sonar, (edge - sonar).normalized(),
                                                  [&](double x, double y) { return bed.height(x, y); });
  const double length = edge.z() * end / sonar.z();  // On level ground at height 0, by similar triangles.
  const auto silence = ping.silence_around(end - length / 2, ping.beam_at(ping.sighting(edge).azimuth));
  EXPECT_NEAR(silence.to, end, 0.06);
  EXPECT_NEAR(silence.to - silence.from, length, 0.3 * length);
}

TEST(SsivSceneTest, LoudestEchoComesFromTheMockup) {
  const ScenePing ping("ssiv", [](Scenario& scenario) {
    scenario.paper.sigmoid = Sigmoid::kNone;
    scenario.sonars[0].gain = 1;
  });
  const auto& intensity = ping.ping().intensity;
  const auto loudest = static_cast<std::size_t>(std::ranges::max_element(intensity) - intensity.begin());
  const int beams = ping.ping().beam_count;
  EXPECT_EQ(ping.visual(static_cast<int>(loudest) / beams, static_cast<int>(loudest) % beams), "mockup");
  EXPECT_TRUE(ping.material(loudest).ends_with("steel")) << ping.material(loudest);
}

}  // namespace
}  // namespace insonify::ssiv_scene_test
