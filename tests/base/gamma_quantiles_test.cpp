// gamma_quantiles_test.cpp -- quantiles against the exponential distribution; moments.

#include "base/gamma_quantiles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insonify::gamma_quantiles_test {
namespace {

// The gamma distribution of shape 1 is the exponential distribution.
TEST(GammaQuantilesTest, ShapeOneIsExponential) {
  const GammaQuantiles quantiles(1);
  for (const double share : {1e-6, 0.001, 0.03, 0.1, 0.5, 0.9, 0.999, 1 - 1e-6}) {
    const double expected = -std::log1p(-share);
    EXPECT_NEAR(quantiles.at(static_cast<float>(std::log(share / (1 - share)))), expected, 1e-3 * expected + 2e-8)
        << share;
  }
}

TEST(GammaQuantilesTest, MeanIsOneAndVarianceOneOverShape) {
  for (const double shape : {0.1, 0.5, 2.0, 30.0, 1000.0}) {
    const GammaQuantiles quantiles(shape);
    double sum = 0, squares = 0;
    constexpr int kDraws = 1 << 20;
    for (int i = 0; i < kDraws; ++i) {
      const double value = quantiles.at(static_cast<float>(std::log((i + 0.5) / (kDraws - i - 0.5))));
      sum += value / kDraws, squares += value * value / kDraws;
    }
    EXPECT_NEAR(sum, 1, 0.005) << shape;
    EXPECT_NEAR((squares - sum * sum) * shape, 1, 0.02) << shape;
  }
}

}  // namespace
}  // namespace insonify::gamma_quantiles_test
