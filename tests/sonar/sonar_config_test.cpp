// sonar_config_test.cpp -- beams, bins, timing, head angles and mounting of a SonarConfig.

#include <gtest/gtest.h>

#include <cmath>

#include "insonify/scenario.h"
#include "sonar/sonars.h"
#include "support/relative.h"

namespace insonify::sonar_config_test {
namespace {

constexpr double kRounding = 1e-14;  // [rad], [m]: a few operations on numbers below 100.

// ---------------------------------------------------------------- Beams

// 256 beams over 120 degrees are 0.46875 degrees wide: the outermost centre is half of that inside the edge.
// By hand from the rule of docs/concepts/beams-and-bins.md, "Samples".
TEST(SamplingByRuleTest, FollowsBeamsBinsAndAperture) {
  const auto rule = [](double azimuth_deg, int beams, double elevation_deg, int bins) {
    SonarConfig sonar;
    sonar.azimuth_aperture = radians_from_degrees(azimuth_deg);
    sonar.beam_count = beams;
    sonar.elevation_aperture = radians_from_degrees(elevation_deg);
    sonar.bin_count = bins;
    const Sampling chosen = sonar.sampling_by_rule();
    return std::pair(*chosen.columns_per_beam, *chosen.rows);
  };
  EXPECT_EQ(rule(120, 256, 20, 1000), std::pair(2, 512));  // 500 rows are 31.25 packets.
  EXPECT_EQ(rule(130, 512, 20, 500), std::pair(2, 256));
  EXPECT_EQ(rule(60, 120, 20, 600), std::pair(2, 304));  // Exactly two columns.
  EXPECT_EQ(rule(61, 120, 20, 600), std::pair(3, 304));
  EXPECT_EQ(rule(3, 1, 35, 100), std::pair(12, 128));
  EXPECT_EQ(rule(40, 1, 35, 9000), std::pair(64, 1024));
  EXPECT_EQ(rule(90, 360, 170, 200), std::pair(2, 816));  // 70 tan 85 degrees = 800.1: 51 packets.
}

TEST(SamplingByRuleTest, LeavesWhatIsSet) {
  SonarConfig sonar;
  sonar.bin_count = 700;
  sonar.sampling.columns_per_beam = 7;
  EXPECT_EQ(*sonar.sampling_by_rule().columns_per_beam, 7);
  EXPECT_EQ(*sonar.sampling_by_rule().rows, 352);
  sonar.sampling = {.rows = 33};
  EXPECT_EQ(*sonar.sampling_by_rule().columns_per_beam, 2);
  EXPECT_EQ(*sonar.sampling_by_rule().rows, 33);
  Scenario scenario;
  EXPECT_EQ(*scenario.filled_in(sonar).sampling.columns_per_beam, 2);
  scenario.model = EchoModel::kPaper;
  EXPECT_FALSE(scenario.filled_in(sonar).sampling.columns_per_beam.has_value());
}

TEST(SonarBeamsTest, AreEvenlySpacedInAngleFromPortToStarboard) {
  const SonarConfig sonar = fan(256, 120);
  EXPECT_THAT(degrees_from_radians(sonar.beam_azimuth(0)), RelativelyNear(59.765625));
  EXPECT_THAT(degrees_from_radians(sonar.beam_azimuth(127)), RelativelyNear(0.234375));
  EXPECT_THAT(degrees_from_radians(sonar.beam_azimuth(128)), RelativelyNear(-0.234375));
  EXPECT_THAT(degrees_from_radians(sonar.beam_azimuth(255)), RelativelyNear(-59.765625));
}

TEST(SonarBeamsTest, EvenBeamsFillTheApertureExactly) {
  const SonarConfig sonar = fan(3, 60);
  const std::vector<double> edges = sonar.bearings().edges();
  ASSERT_EQ(edges.size(), 4U);
  EXPECT_EQ(edges.front(), sonar.azimuth_aperture / 2);
  EXPECT_EQ(edges.back(), -sonar.azimuth_aperture / 2);
  EXPECT_NEAR(edges[1], deg(10), kRounding);
  EXPECT_NEAR(edges[2], deg(-10), kRounding);
}

TEST(SonarBeamsTest, CentresLieMidwayBetweenEdges) {
  const SonarConfig sonar = fan(97, 130);
  const std::vector<double> edges = sonar.bearings().edges();
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const auto b = static_cast<std::size_t>(beam);
    EXPECT_NEAR(sonar.beam_azimuth(beam), (edges[b] + edges[b + 1]) / 2, kRounding);
    EXPECT_GT(edges[b], edges[b + 1]);
  }
}

// Centres at 20, 5, 0 and -20 degrees. Edges midway: 12.5, 2.5, -10; the outermost beams extend as far outwards as
// inwards: 20 + 7.5, -20 - 10.
TEST(SonarBeamsTest, ExplicitCentresAreKeptAndEdgesLieBetween) {
  SonarConfig sonar = fan(4, 60);
  sonar.beam_azimuths = {deg(20), deg(5), deg(0), deg(-20)};
  EXPECT_EQ(sonar.beam_azimuth(1), deg(5));
  const std::vector<double> edges = sonar.bearings().edges();
  ASSERT_EQ(edges.size(), 5U);
  const double expected_deg[] = {27.5, 12.5, 2.5, -10, -30};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_NEAR(degrees_from_radians(edges[i]), expected_deg[i], 100 * kRounding) << "edge " << i;
  }
}

// Two beams of a degree abeam; without widths they would touch and cover 180 degrees each.
TEST(SonarBeamsTest, BeamsWithWidthsLeaveGaps) {
  SonarConfig sonar = fan(2, 60);
  sonar.beam_azimuths = {deg(90), deg(-90)};
  EXPECT_NEAR(sonar.bearings().width(0), deg(180), kRounding);
  sonar.beam_widths = {deg(1)};
  const BearingGrid beams = sonar.bearings();
  EXPECT_TRUE(beams.has_gaps());
  EXPECT_NEAR(beams.port[0], deg(90.5), kRounding);
  EXPECT_NEAR(beams.starboard[0], deg(89.5), kRounding);
  EXPECT_NEAR(beams.port[1], deg(-89.5), kRounding);
  EXPECT_NEAR(beams.covered(), deg(2), kRounding);
  EXPECT_EQ(*sonar.sampling_by_rule().columns_per_beam, 4);  // A quarter of a degree each.
  sonar.beam_widths = {deg(1), deg(3)};
  EXPECT_NEAR(sonar.bearings().starboard[1], deg(-91.5), kRounding);
}

TEST(SonarBeamsTest, WidthsOfTheSpacingLeaveNoGap) {
  SonarConfig sonar = fan(3, 60);
  sonar.beam_widths = {deg(20)};
  EXPECT_FALSE(sonar.bearings().has_gaps());
  EXPECT_EQ(sonar.bearings().edges().size(), 4U);
}

TEST(SonarBeamsTest, ASingleExplicitBeamIsAsWideAsTheAperture) {
  SonarConfig sonar = fan(1, 8);
  sonar.beam_azimuths = {deg(15)};
  const std::vector<double> edges = sonar.bearings().edges();
  EXPECT_NEAR(edges[0], deg(19), kRounding);
  EXPECT_NEAR(edges[1], deg(11), kRounding);
}

// ---------------------------------------------------------------- Bins and time

// (20 - 2) m in 36 bins: half a metre each.
TEST(SonarBinsTest, DivideTheRangeWindowEvenly) {
  SonarConfig sonar;
  sonar.min_range = 2;
  sonar.max_range = 20;
  sonar.bin_count = 36;
  EXPECT_EQ(sonar.bin_length(), 0.5);
  EXPECT_EQ(sonar.bin_range(0), 2.25);
  EXPECT_EQ(sonar.bin_range(35), 19.75);
}

// At 1500 m/s: 75 pings a second to 10 m, 15 to 50 m, 10 to 75 m, 6.25 to 120 m.
TEST(SonarTimeTest, SoundMustComeBackFromTheFarthestBin) {
  SonarConfig sonar;
  const auto rate = [&](double max_range) {
    sonar.max_range = max_range;
    return 1 / sonar.shortest_ping_period(1500);
  };
  EXPECT_THAT(rate(2), RelativelyNear(375.0));
  EXPECT_THAT(rate(10), RelativelyNear(75.0));
  EXPECT_THAT(rate(50), RelativelyNear(15.0));
  EXPECT_THAT(rate(75), RelativelyNear(10.0));
  EXPECT_THAT(rate(120), RelativelyNear(6.25));
}

// Duration of a full turn of 400 pings, one gradian each, at the shortest ping period for 10 m and 50 m.
TEST(SonarTimeTest, AFullTurnTakesAsLongAsItsPings) {
  SonarConfig sonar = scanner(0.9);
  sonar.max_range = 10;
  EXPECT_THAT(400 * sonar.shortest_ping_period(1500), RelativelyNear(5.333333333333334));
  sonar.max_range = 50;
  EXPECT_THAT(400 * sonar.shortest_ping_period(1500), RelativelyNear(26.666666666666668));
}

// ---------------------------------------------------------------- Head

TEST(SonarHeadTest, AForwardLookingSonarHasNone) {
  SonarConfig sonar = scanner(0.9, 360, 45);
  sonar.type = SonarType::kForwardLooking;
  EXPECT_EQ(sonar.head_angle(17), 0);
}

// Steps of 4, 8, 16 and 32 sixteenths of a gradian: 0.225, 0.45, 0.9 and 1.8 degrees.
TEST(SonarHeadTest, TurnsByItsStepEachPing) {
  EXPECT_THAT(degrees_from_radians(scanner(0.225).head_angle(100)), RelativelyNear(22.5));
  EXPECT_THAT(degrees_from_radians(scanner(0.45).head_angle(100)), RelativelyNear(45.0));
  EXPECT_THAT(degrees_from_radians(scanner(0.9).head_angle(114)), RelativelyNear(102.6));
  EXPECT_THAT(degrees_from_radians(scanner(0.9).head_angle(269)), RelativelyNear(242.1));
  EXPECT_THAT(degrees_from_radians(scanner(-1.8).head_angle(100)), RelativelyNear(-180.0));
}

TEST(SonarHeadTest, AFullCircleStartsAtItsMiddleAndGoesOn) {
  const SonarConfig sonar = scanner(0.9, 360, -30);
  EXPECT_EQ(sonar.head_angle(0), deg(-30));
  EXPECT_THAT(degrees_from_radians(sonar.head_angle(1000)), RelativelyNear(870.0));
}

// 40 degrees about 10 in steps of 15: two whole steps fit, from -10 to 20.
TEST(SonarHeadTest, ASectorIsSweptToAndFro) {
  const SonarConfig sonar = scanner(15, 40, 10);
  const double expected_deg[] = {-10, 5, 20, 5, -10, 5, 20};
  for (std::uint64_t ping = 0; ping < std::size(expected_deg); ++ping) {
    EXPECT_NEAR(degrees_from_radians(sonar.head_angle(ping)), expected_deg[ping], 100 * kRounding) << "ping " << ping;
  }
}

TEST(SonarHeadTest, ANegativeStepLeadsAwayFromTheOtherEdge) {
  const SonarConfig sonar = scanner(-15, 40, 10);
  const double expected_deg[] = {30, 15, 0, 15, 30, 15, 0};
  for (std::uint64_t ping = 0; ping < std::size(expected_deg); ++ping) {
    EXPECT_NEAR(degrees_from_radians(sonar.head_angle(ping)), expected_deg[ping], 100 * kRounding) << "ping " << ping;
  }
}

// 90 / 0.9 is 100 steps, in spite of rounding: ping 100 is at the far edge, ping 200 back at the near one.
TEST(SonarHeadTest, AWholeNumberOfStepsReachesTheFarEdge) {
  const SonarConfig sonar = scanner(0.9, 90);
  EXPECT_NEAR(degrees_from_radians(sonar.head_angle(0)), -45, 100 * kRounding);
  EXPECT_NEAR(degrees_from_radians(sonar.head_angle(100)), 45, 100 * kRounding);
  EXPECT_NEAR(degrees_from_radians(sonar.head_angle(200)), -45, 100 * kRounding);
}

// ---------------------------------------------------------------- Mounting

TEST(SonarMountingTest, IsPlacedAndTurnedOnTheVehicle) {
  SonarConfig sonar;
  sonar.position = {1, 2, 3};
  sonar.orientation = {0, deg(30), deg(90)};
  const Pose pose = sonar.vehicle_from_sonar();
  // Pitched 30 degrees down, then turned to port.
  EXPECT_LE((pose * Vec3(2, 0, 0) - Vec3(1, 2 + 2 * std::cos(deg(30)), 3 - 2 * 0.5)).norm(), kRounding);
}

// Rolled by +90 degrees: the housing's y is the vehicle's z, so a head turned to "port" looks up.
TEST(SonarMountingTest, AVerticalHeadTurnsUpwards) {
  SonarConfig sonar = scanner(0.9);
  sonar.head.mounting = Mounting::kVertical;
  const Pose pose = sonar.vehicle_from_sonar();
  EXPECT_LE((pose.orientation * Vec3::UnitX() - Vec3::UnitX()).norm(), kRounding);
  EXPECT_LE((pose.orientation * Vec3::UnitY() - Vec3::UnitZ()).norm(), kRounding);
  EXPECT_LE((pose.orientation * Vec3::UnitZ() + Vec3::UnitY()).norm(), kRounding);
}

TEST(SonarMountingTest, RollComesBeforeTheMountingsOwnAngles) {
  SonarConfig sonar = scanner(0.9);
  sonar.head.mounting = Mounting::kVertical;
  sonar.orientation = {0, 0, deg(90)};
  const Pose pose = sonar.vehicle_from_sonar();
  EXPECT_LE((pose.orientation * Vec3::UnitX() - Vec3::UnitY()).norm(), kRounding);
  EXPECT_LE((pose.orientation * Vec3::UnitY() - Vec3::UnitZ()).norm(), kRounding);
}

}  // namespace
}  // namespace insonify::sonar_config_test
