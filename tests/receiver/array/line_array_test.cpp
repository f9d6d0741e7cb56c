// line_array_test.cpp -- the array that each beam pattern selects.

#include "receiver/array/line_array.h"

#include <gtest/gtest.h>

#include "insonify/error.h"
#include "support/message_of.h"

namespace insonify::line_array_test {
namespace {

constexpr double kDegree = radians_from_degrees(1);

TEST(LineArrayTest, IsAContinuousLineWithItsWindow) {
  const ArraySettings taylor = line_array(BeamPattern::kTaylor, -28, 20 * kDegree);
  EXPECT_EQ(taylor.window, ArrayWindow::kTaylor);
  EXPECT_EQ(taylor.side_lobe_db, -28);
  EXPECT_EQ(taylor.elements, 0);
  EXPECT_FALSE(taylor.two_way);
  EXPECT_EQ(line_array(BeamPattern::kRectangular, -28, 20 * kDegree).window, ArrayWindow::kRectangular);
}

// Elements of a Dolph-Chebyshev array are half a wavelength apart or slightly closer, so that it has no grating lobes.
TEST(LineArrayTest, DolphChebyshevArrayHasElementsHalfAWavelengthApart) {
  for (const double width : {0.3, 1.0, 5.0, 20.0, 90.0}) {
    const ArraySettings dolph = line_array(BeamPattern::kDolphChebyshev, -35, width * kDegree);
    const double wavelengths = ArrayPattern(dolph).length(1, width * kDegree);
    EXPECT_GE(dolph.elements, 2 * wavelengths) << width;
    EXPECT_LT(dolph.elements, 2 * wavelengths + 2) << width;
    const ArrayPattern pattern(dolph);
    EXPECT_NEAR(pattern.intensity(wavelengths * std::sin(0.5 * width * kDegree)), 0.5, 1e-3) << width;
  }
}

TEST(LineArrayTest, IsRefusedWhereItTakesTooManyElements) {
  EXPECT_EQ(message_of([] { static_cast<void>(line_array(BeamPattern::kDolphChebyshev, -30, 0.05 * kDegree)); }),
            "dolph_chebyshev takes more than 1024 elements for a beam of 0.05 deg");
}

}  // namespace
}  // namespace insonify::line_array_test
