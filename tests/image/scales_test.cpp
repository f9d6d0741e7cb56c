// scales_test.cpp -- round steps, rings, radials and texts of numbers and bearings.

#include "image/scales.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace insonify::scales_test {
namespace {

TEST(ScalesTest, NiceStepsAreRoundNumbers) {
  EXPECT_DOUBLE_EQ(nice_step(50, 6), 10);
  EXPECT_DOUBLE_EQ(nice_step(1, 5), 0.2);
  EXPECT_DOUBLE_EQ(nice_step(0.7, 6), 0.2);
  EXPECT_DOUBLE_EQ(nice_step(13, 6), 2.5);
  EXPECT_DOUBLE_EQ(nice_step(5200, 6), 1000);
  EXPECT_DOUBLE_EQ(nice_step(60, 5), 20);
}

// The usual ranges have their usual rings.
TEST(ScalesTest, RangeRingsAreWhereOperatorsExpectThem) {
  EXPECT_DOUBLE_EQ(ring_step(2), 0.5);
  EXPECT_DOUBLE_EQ(ring_step(5), 1);
  EXPECT_DOUBLE_EQ(ring_step(10), 2);
  EXPECT_DOUBLE_EQ(ring_step(20), 5);
  EXPECT_DOUBLE_EQ(ring_step(50), 10);
  EXPECT_DOUBLE_EQ(ring_step(100), 20);
  EXPECT_DOUBLE_EQ(ring_step(120), 20);
}

TEST(ScalesTest, AnyRangeHasThreeToSixRings) {
  for (double range = 0.3; range < 5000; range *= 1.013) {
    const double rings = std::floor(range / ring_step(range) * (1 + 1e-9));
    EXPECT_GE(rings, 3) << range;
    EXPECT_LE(rings, 6) << range;
  }
}

TEST(ScalesTest, MultiplesIncludeTheEnds) {
  EXPECT_THAT(multiples_within(-0.3, 0.3, 0.1), testing::SizeIs(7));
  EXPECT_THAT(multiples_within(0, 1, 0.2), testing::SizeIs(6));
  EXPECT_THAT(multiples_within(0.3, 20, 5), testing::ElementsAre(5, 10, 15, 20));
  EXPECT_THAT(multiples_within(1, 2, 5), testing::IsEmpty());
}

TEST(ScalesTest, NumbersAreWrittenAsShortAsTheyAre) {
  EXPECT_EQ(number_text(20), "20");
  EXPECT_EQ(number_text(2.5), "2.5");
  EXPECT_EQ(number_text(-50), "−50");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(0.30000000000000004), "0.3");
  EXPECT_EQ(frequency_text(720e3), "720 kHz");
  EXPECT_EQ(frequency_text(1.2e6), "1.2 MHz");
  EXPECT_EQ(frequency_text(400), "400 Hz");
}

TEST(ScalesTest, BearingsSayWhichSide) {
  EXPECT_EQ(bearing_text(radians_from_degrees(30)), "30° P");
  EXPECT_EQ(bearing_text(radians_from_degrees(-30)), "30° S");
  EXPECT_EQ(bearing_text(radians_from_degrees(22.5)), "22.5° P");
  EXPECT_EQ(bearing_text(0), "0°");
  EXPECT_EQ(bearing_text(radians_from_degrees(-0.01)), "0°");
  EXPECT_EQ(bearing_text(radians_from_degrees(180)), "180°");
  EXPECT_EQ(bearing_text(radians_from_degrees(-180)), "180°");
  EXPECT_EQ(bearing_text(radians_from_degrees(210)), "150° S");
  EXPECT_EQ(bearing_text(radians_from_degrees(30), Mounting::kVertical), "30° up");
  EXPECT_EQ(bearing_text(radians_from_degrees(-30), Mounting::kVertical), "30° down");
  EXPECT_EQ(bearing_text(0, Mounting::kVertical), "front");
  EXPECT_EQ(bearing_text(radians_from_degrees(150), Mounting::kVertical), "30° up");
  EXPECT_EQ(bearing_text(radians_from_degrees(-127.5), Mounting::kVertical), "52.5° down");
  EXPECT_EQ(bearing_text(radians_from_degrees(90), Mounting::kVertical), "up");
  EXPECT_EQ(bearing_text(radians_from_degrees(-90), Mounting::kVertical), "down");
  EXPECT_EQ(bearing_text(radians_from_degrees(180), Mounting::kVertical), "back");
}

TEST(ScalesTest, RadialsAreEveryOneToThirtyDegrees) {
  const auto step = [](double aperture) {
    return std::lround(degrees_from_radians(radial_step(radians_from_degrees(aperture))));
  };
  EXPECT_EQ(step(3), 1);
  EXPECT_EQ(step(10), 2);
  EXPECT_EQ(step(14), 5);
  EXPECT_EQ(step(45), 10);
  EXPECT_EQ(step(120), 20);
  EXPECT_EQ(step(360), 30);
  for (const double aperture : {30, 60, 90, 120, 180, 360}) {
    EXPECT_EQ(90 % std::lround(degrees_from_radians(radial_step(radians_from_degrees(aperture), Mounting::kVertical))),
              0);
  }
}

}  // namespace
}  // namespace insonify::scales_test
