// vector_math_test.cpp -- the fast elementary functions against the C library in double precision, over their ranges.

#include "base/vector_math.h"

#include <gtest/gtest.h>

#include <numbers>

namespace insonify::vector_math_test {
namespace {

TEST(VectorMathTest, ExponentialKeepsSixDigits) {
  for (double x = -86.9; x < 87.9; x += 0.00137) {
    const double exact = std::exp(static_cast<double>(static_cast<float>(x)));
    EXPECT_NEAR(fast_exp(static_cast<float>(x)) / exact, 1, 2e-7) << x;
  }
  EXPECT_EQ(fast_exp(0), 1.0F);
  EXPECT_LT(fast_exp(-1000), 1e-37F);
}

TEST(VectorMathTest, LogarithmKeepsSixDigits) {
  for (double x = 1e-7; x < 1; x *= 1.0007) {
    const auto stored = static_cast<float>(x);
    const double exact = std::log(static_cast<double>(stored));
    EXPECT_NEAR(fast_log(stored), exact, 3e-7 * std::max(1.0, -exact)) << x;
  }
}

TEST(VectorMathTest, SineAndCosineKeepSixDigitsThroughEveryQuadrant) {
  for (int i = 0; i < 100000; ++i) {
    const float turns = static_cast<float>(i) / 100000;
    const double angle = 2 * std::numbers::pi * turns;
    const SineCosine found = fast_sine_cosine(turns);
    EXPECT_NEAR(found.sine, std::sin(angle), 3e-7) << turns;
    EXPECT_NEAR(found.cosine, std::cos(angle), 3e-7) << turns;
  }
}

TEST(VectorMathTest, NumbersAreHeldInTheUnitInterval) {
  for (const float inside : {0.0F, 1e-38F, 0.25F, 0.99999994F, 1.0F}) {
    EXPECT_EQ(held_in_unit(inside), inside);
  }
  for (const float below : {-0.0F, -1e-38F, -0.5F, -1.0F, -1e30F}) {
    EXPECT_EQ(held_in_unit(below), 0.0F);
  }
  for (const float above : {1.0000001F, 2.0F, 1e30F}) {
    EXPECT_EQ(held_in_unit(above), 1.0F);
  }
}

}  // namespace
}  // namespace insonify::vector_math_test
