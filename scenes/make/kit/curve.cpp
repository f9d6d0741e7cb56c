// curve.cpp -- monotone cubics.

#include "kit/curve.h"

#include <algorithm>
#include <cmath>

Curve::Curve(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)), slope_(x_.size(), 0) {
  // Slopes of the chords; at a point the harmonic mean of its two, and level where they change sign.
  const std::size_t last = x_.size() - 1;
  std::vector<double> chord;
  for (std::size_t i = 0; i < last; ++i) {
    chord.push_back((y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]));
  }
  slope_.front() = chord.front();
  slope_.back() = chord.back();
  for (std::size_t i = 1; i < last; ++i) {
    if (chord[i - 1] * chord[i] > 0) {
      slope_[i] = 2 * chord[i - 1] * chord[i] / (chord[i - 1] + chord[i]);
    }
  }
}

double Curve::operator()(double x) const {
  if (x <= x_.front()) {
    return y_.front();
  }
  if (x >= x_.back()) {
    return y_.back();
  }
  const auto i = static_cast<std::size_t>(std::ranges::upper_bound(x_, x) - x_.begin()) - 1;
  const double width = x_[i + 1] - x_[i];
  const double t = (x - x_[i]) / width;
  return y_[i] * (1 + 2 * t) * (1 - t) * (1 - t) + y_[i + 1] * t * t * (3 - 2 * t) +
         width * t * (1 - t) * (slope_[i] * (1 - t) - slope_[i + 1] * t);
}

std::vector<double> spaced(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(first + (last - first) * i / (count - 1));
  }
  return values;
}

std::vector<double> stepped(double first, double last, double step) {
  return spaced(first, last, 1 + std::max(1, static_cast<int>(std::ceil(std::abs(last - first) / step - 1e-9))));
}

std::vector<double> merged(std::vector<double> values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
  std::ranges::sort(values);
  const auto repeated = std::ranges::unique(values, [](double a, double b) { return b - a < 1e-6; });
  values.erase(repeated.begin(), repeated.end());
  return values;
}

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
