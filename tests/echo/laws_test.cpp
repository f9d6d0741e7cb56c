// laws_test.cpp -- the laws of single hits against values worked out by hand, in both number types.

#include "echo/laws/laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace insonify::laws_test {
namespace {

constexpr double kRounding = 2e-7;  // Of single precision, relative.

TEST(AbsorptionLawTest, EchoesSpreadAndAreAbsorbedBothWays) {
  // e^(-4 x 0.02 x 10) / 100 = 0.449329 / 100.
  EXPECT_NEAR(precise::two_way_loss(0.02, 10), 0.00449328964, 1e-11);
  EXPECT_NEAR(two_way_loss(0.02F, 10), 0.00449328964, 0.0045 * kRounding);
  EXPECT_NEAR(precise::paper_strength(-0.5, 0.8, 0.02, 20), 0.4 * std::exp(-0.4), 1e-15);
}

TEST(AbsorptionLawTest, SigmoidIsHalfAtItsMidpointAndNeverNegative) {
  EXPECT_EQ(precise::logistic({12, 0.3, 1, 0}, 0.3), 0.5);
  EXPECT_EQ(logistic({12, 0.3F, 1, 0}, 0.3F), 0.5F);
  EXPECT_EQ(logistic({12, 0.3F, 1, -0.9F}, 0.3F), 0);
}

// Half reaches the surface, which lets through 0.4 of it there and 0.4 back; -50 dB end the way.
TEST(AbsorptionLawTest, WhatIsPassedOnEndsAtFiftyDecibels) {
  EXPECT_DOUBLE_EQ(precise::passed_on(0.5, 0.4), 0.08);
  EXPECT_GT(passed_on(1.0F, 0.0032F), 0);
  EXPECT_EQ(passed_on(1.0F, 0.0031F), 0);
}

// Slopes of 3/4 and 4/3 have normals of (0.6, 0.8) and (0.8, 0.6). Sound from above is turned by twice their tilts of
// 36.9 and 53.1 degrees: to 73.7 degrees from the vertical, and to 106.3, which is below the surface.
TEST(HitLawTest, ReliefTiltsTheNormalAndShadowsItself) {
  const BentSurface mild = bent_surface({0, 0, -1}, {0, 0, 1}, {0.75F, 0, 0}, -1);
  EXPECT_NEAR(mild.normal.x, -0.6, kRounding);
  EXPECT_NEAR(mild.normal.z, 0.8, kRounding);
  EXPECT_NEAR(mild.facing, -0.8, kRounding);
  EXPECT_EQ(mild.escapes, 1);
  const BentSurface steep = bent_surface({0, 0, -1}, {0, 0, 1}, {4.0F / 3, 0, 0}, -1);
  EXPECT_NEAR(steep.facing, -0.6, kRounding);
  EXPECT_EQ(steep.escapes, 0);
  EXPECT_EQ(bent_surface({0.8F, 0, -0.6F}, {0, 0, 1}, {-4.0F / 3, 0, 0}, -0.6F).facing, 0);  // Faces away.
}

// A floor 3 m below: the range at the depression t is 3 / sin t, the cosine of incidence -sin t.
TEST(HitLawTest, NeighboursOnAPlaneAreJoined) {
  const double a = 0.3, b = 0.31, bin = 0.01;
  const double range_a = 3 / std::sin(a), range_b = 3 / std::sin(b);
  const auto joined = [&](double moved) {
    return precise::unbroken(range_a, -std::sin(a), -std::sin(b), range_b + moved, -std::sin(b), -std::sin(a), bin);
  };
  EXPECT_GT(range_a - range_b, 30 * bin);
  EXPECT_TRUE(joined(0));
  EXPECT_TRUE(joined(0.05));
  EXPECT_FALSE(joined(0.5));
  EXPECT_TRUE(joined(range_a - range_b + 0.9 * bin));  // Within a bin of each other.
}

// From 10 to 12 bins with half widths of 0.5 and 0.3, powers 2 and 4: spread over 9.6..12.4, with the mean power 3.
TEST(HitLawTest, SegmentsKeepWeightAndMeanPower) {
  for (const bool swapped : {false, true}) {
    const precise::SegmentEnd near = {10, 0.5, 2}, far = {12, 0.3, 4};
    const precise::FootprintSegment segment =
        precise::segment_between(swapped ? far : near, swapped ? near : far, 0.07, 100, 0.2);
    EXPECT_NEAR(segment.low, 9.6, 1e-4);
    EXPECT_NEAR(segment.high, 12.4, 1e-4);
    EXPECT_NEAR(segment.density * (segment.high - segment.low), 0.07, 1e-12);
    EXPECT_NEAR(segment.power + segment.half_rise * (segment.low + segment.high), 3, 1e-12);
    EXPECT_GT(segment.half_rise, 0);
    EXPECT_EQ(segment.elevation, 0.2);
  }
  EXPECT_EQ(segment_between({-5, 0, 1}, {3, 0, 1}, 1, 2, 0).low, 0);
  EXPECT_EQ(segment_between({-5, 0, 1}, {3, 0, 1}, 1, 2, 0).high, 2);
}

// A net that keeps a quarter has a quarter of the weight, with four times the power: the energy stays as it is.
TEST(HitLawTest, PowerIsPerKeptWeight) {
  EXPECT_EQ(precise::per_kept(0.25), 4);
  EXPECT_EQ(per_kept(0.25F) * 0.25F, 1);
  EXPECT_EQ(per_kept(0.0F), 0);
}

// A normal of (0.6, 0.8, 0): the fourth powers of its components are 0.1296, 0.4096 and 0, of the sum 0.5392; the mean
// of 1 and 0.5 is (0.1296 + 0.2048) / 0.5392.
TEST(HitLawTest, ProjectionsAreBlendedByFourthPowers) {
  const precise::Triple shares = precise::projection_shares({0.6, 0.8, 0});
  EXPECT_EQ(shares.z, 0);
  EXPECT_NEAR(precise::mean_of_projections({1, 0.5, 7}, shares), 0.3344 / 0.5392, 1e-12);
  EXPECT_EQ(mean_of_projections({0, 0, 0.7F}, projection_shares({0, 0, 1})), 0.7F);
}

// d(range)/d(azimuth) = range |sideways| / |facing|, the divisor plus 0.1: 20 x 0.3 / 0.5 = 12 per radian.
TEST(HitLawTest, ReachIsTheChangeOfRangeAcrossTheColumn) {
  EXPECT_DOUBLE_EQ(precise::footprint_reach(0.01, 20, 0.3, -0.4), 0.15);
  EXPECT_DOUBLE_EQ(precise::footprint_reach(0.01, 20, 0.3, 0.02), 0.6);  // As at a cosine of 0.1.
  EXPECT_DOUBLE_EQ(precise::sideways_in_wedge(-0.5, 0.8), 0.4);
  EXPECT_NEAR(precise::sideways_on_cone(0.5, 0.3, 1, 0.6), 0, 1e-15);
  EXPECT_DOUBLE_EQ(precise::sideways_on_cone(0.5, 0.3, 1, 0), 1);  // As at a cosine of 0.2.
}

// The tangent plane is followed to at most 1.5 times the 4 bins that the neighbour is away.
TEST(HitLawTest, SegmentsExtendBeyondASurfaceByItsLastInterval) {
  EXPECT_EQ(extended_to(20, 16, 23), 23);
  EXPECT_EQ(extended_to(20, 16, 27), 26);
  EXPECT_EQ(extended_to(20, 16, 15), 15);
  EXPECT_EQ(extended_to(20, 24, 13), 14);
  EXPECT_EQ(extended_to(20, 24, -INFINITY), 14);
  EXPECT_EQ(extended_to(20, 24, NAN), 14);
}

// The golden section of a turn is (sqrt 5 - 1)/2.
TEST(SelectionLawTest, ColumnsStartAGoldenSectionApart) {
  EXPECT_EQ(selection_start(0, 7), 7U);
  EXPECT_NEAR(selection_start(1, 0) / 4294967296.0, 0.6180339887, 1e-9);
  EXPECT_EQ(selection_start(2, 7), 2 * kGoldenTurn + 7);  // Modulo 2^32.
}

// A mirror that reflects all of 0.2 sr, where the greatest solid angle is 0.1 sr: sqrt(1 x 0.2 x 5) = 1.
TEST(SelectionLawTest, TwiceTheGreatestSolidAngleIsFull) {
  EXPECT_EQ(full_energy_scale(0.1F), 5);
  EXPECT_EQ(full_energy_scale(0), 0);
}

// A quarter of a turn is 2^30 of 2^32.
TEST(SelectionLawTest, HitsCountByTheInverseOfTheirShare) {
  EXPECT_EQ(share_in_turns(0.25F), 1U << 30);
  EXPECT_EQ(selected_weight(0.25F, (1U << 30) - 1), 4);
  EXPECT_EQ(selected_weight(0.25F, 1U << 30), 0);
  EXPECT_EQ(paper_share(1, 1), kMostSelected);
  EXPECT_EQ(paper_share(0, 1), kLeastSelected);
  EXPECT_NEAR(paper_share(-0.33F, 0.16F), 0.4, kRounding);
  EXPECT_NEAR(calibrated_share(0.5F, 0.02F, 9), 0.3, kRounding);
  EXPECT_EQ(calibrated_share(1e-4F, 1, 1), 0);
}

// Normals that turn by 0.1 on either side, or on one that is joined; by nothing on the other side of a crease.
TEST(NormalLawTest, TurnIsTheMeanOfBothSides) {
  EXPECT_NEAR(mean_turn({0.1F, 0, 0}, 1, {0.1F, 0, 0}, 1).x, 0.1, kRounding);
  EXPECT_NEAR(mean_turn({0.1F, 0, 0}, 1, {0, 0, 0}, 0).x, 0.1, kRounding);
  EXPECT_EQ(mean_turn({0.1F, 0, 0}, 1, {0, 0, 0}, 1).x, 0);
}

TEST(NormalLawTest, NeighboursAreJoinedUpTo53And30Degrees) {
  const auto joined = [](double turn_deg, double off_deg) {
    const double turn = turn_deg * std::numbers::pi / 180, off = off_deg * std::numbers::pi / 180;
    return precise::normal_change(true, {std::sin(turn), 0, std::cos(turn) - 1}, {0, 0, 1},
                                  {std::cos(off), 0, std::sin(off)})
        .joined;
  };
  EXPECT_EQ(joined(53, 0), 1);
  EXPECT_EQ(joined(54, 0), 0);
  EXPECT_EQ(joined(0, 29.9), 1);
  EXPECT_EQ(joined(0, -30.1), 0);
}

}  // namespace
}  // namespace insonify::laws_test
