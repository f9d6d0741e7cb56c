// curve.h -- smooth curves through given points, and evenly or unevenly spaced numbers.

#pragma once

#include <vector>

#include "kit/shape.h"

/// A smooth curve through points (x, y), x rising, that never overshoots them: the spline that a shipwright bends over
/// a table of offsets. Monotone cubic after Fritsch and Carlson, SIAM J. Numer. Anal. 17(2), 238 (1980); level beyond
/// its ends.
class Curve {
 public:
  Curve(std::vector<double> x, std::vector<double> y);
  [[nodiscard]] double operator()(double x) const;

 private:
  std::vector<double> x_, y_, slope_;
};

/// `count` numbers from `first` to `last`, both included; `count` >= 2.
[[nodiscard]] std::vector<double> spaced(double first, double last, int count);

/// From `first` to `last` in equal steps no longer than `step`.
[[nodiscard]] std::vector<double> stepped(double first, double last, double step);

/// `values` and `more`, sorted, without those that come within a micrometre of their forerunner.
[[nodiscard]] std::vector<double> merged(std::vector<double> values, const std::vector<double>& more);

/// 0 below `low`, 1 above `high`, smooth in between.
[[nodiscard]] double smooth_step(double low, double high, double x);
