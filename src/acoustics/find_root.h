// find_root.h -- zeros of a function of one number between given arguments.

#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace insonify {

/// The argument between two at which a function passes zero, by secants and bisection in turn. At a jump it is the
/// place of the jump.
/// @param low_value, high_value  The function there, of different signs.
template <typename Function>
double find_root(const Function& function, double low, double high, double low_value, double high_value) {
  for (bool halve = false; low_value != 0 && high_value != 0; halve = !halve) {
    const double secant = low - low_value * (high - low) / (high_value - low_value);
    const double middle = halve ? low + (high - low) / 2 : secant;
    if (!(middle > low && middle < high)) {
      if (halve) {
        break;  // No number lies between.
      }
      continue;
    }
    const double value = function(middle);
    const bool below = (value < 0) == (low_value < 0) && value != 0;
    (below ? low : high) = middle;
    (below ? low_value : high_value) = value;
  }
  return std::abs(low_value) < std::abs(high_value) ? low : high;
}

/// The argument between two at which a function that has one extremum between them is least.
template <typename Function>
double find_least(const Function& function, double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 40;  // To 1e-8 of the interval.
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = function(left), at_right = function(right);
  for (int i = 0; i < kSteps; ++i) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = function(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = function(right);
    }
  }
  return at_left < at_right ? left : right;
}

/// Calls found(argument) for the roots of a function that between neighbouring arguments has at most two.
/// @param at  Rising arguments.
template <typename Function, typename Found>
void for_each_root(const Function& function, std::span<const double> at, const Found& found) {
  std::vector<double> values(at.size());
  std::ranges::transform(at, values.begin(), function);
  for (std::size_t i = 1; i < at.size(); ++i) {
    if ((values[i - 1] < 0) != (values[i] < 0)) {
      found(find_root(function, at[i - 1], at[i], values[i - 1], values[i]));
      continue;
    }
    // Two roots may lie between three values of one sign whose middle one is nearest to zero.
    const double middle = std::abs(values[i - 1]);
    if (i < 2 || !(middle <= std::abs(values[i]) && middle <= std::abs(values[i - 2])) ||
        (values[i - 2] < 0) != (values[i] < 0)) {
      continue;
    }
    const double sign = values[i] < 0 ? -1 : 1;
    const double least = find_least([&](double x) { return sign * function(x); }, at[i - 2], at[i]);
    const double value = function(least);
    if (sign * value < 0) {
      found(find_root(function, at[i - 2], least, values[i - 2], value));
      found(find_root(function, least, at[i], value, values[i]));
    }
  }
}

}  // namespace insonify
