// gamma_quantiles.h -- quantiles of the gamma distribution, for drawing numbers of it.

#pragma once

#include <vector>

namespace insonify {

/// Table of quantiles of the gamma distribution with mean 1 and shape nu.
class GammaQuantiles {
 public:
  /// @param shape  nu, > 0.
  explicit GammaQuantiles(double shape);

  /// Quantile of the probability u, given as v = log(u / (1 - u)): the table is evenly spaced in v, so that both tails
  /// are resolved.
  [[nodiscard]] float at(float v) const;

 private:
  std::vector<float> values_;  // Quantiles at evenly spaced v.
};

}  // namespace insonify
