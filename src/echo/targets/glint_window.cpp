// glint_window.cpp -- sums Fresnel's integrals over the cells of a face.

#include "echo/targets/glint_window.h"

#include <algorithm>
#include <cmath>

#include "acoustics/diffraction.h"

namespace insonify {
namespace {

using Amplitudes = std::array<std::complex<double>, GlintWindow::kCells>;

struct Interval {
  double from, to;
};

// The part of a side that is sampled [u].
Interval window_of(const GlintSide& side) {
  constexpr double kWindow = GlintWindow::kWindow;
  return {std::max(side.low, std::min(-kWindow, side.high - kWindow)),
          std::min(side.high, std::max(kWindow, side.low + kWindow))};
}

Amplitudes amplitudes_of(const GlintSide& side) {
  const Interval window = window_of(side);
  Amplitudes amplitudes;
  for (int i = 0; i < GlintWindow::kCells; ++i) {
    const auto edge = [&](int k) {
      return k == 0                     ? side.low
             : k == GlintWindow::kCells ? side.high
                                        : window.from + (window.to - window.from) * k / GlintWindow::kCells;
    };
    amplitudes[i] = fresnel_between(edge(i), edge(i + 1));
  }
  return amplitudes;
}

double middle_of(const GlintSide& side, int i) {
  const Interval window = window_of(side);
  return side.stationary + (window.from + (window.to - window.from) * (i + 0.5) / GlintWindow::kCells) / side.scale;
}

}  // namespace

GlintSide GlintSide::of(double foot, double half, double nearest, double range, double wavelength) {
  const double along = (nearest - foot) / range, bend = 1 - along * along;
  const double stationary = nearest - along * range / bend, scale = 2 * std::sqrt(bend / (wavelength * range));
  return {(-half - stationary) * scale, (half - stationary) * scale, scale, stationary, bend};
}

Eigen::Vector2d GlintWindow::middle(int cell) const {
  return {middle_of(sides[0], cell / kCells), middle_of(sides[1], cell % kCells)};
}

double GlintWindow::visible(std::span<const double, kCount> passed) const {
  const Amplitudes first = amplitudes_of(sides[0]), second = amplitudes_of(sides[1]);
  std::complex<double> all = 0, seen = 0;
  for (int cell = 0; cell < kCount; ++cell) {
    const std::complex<double> amplitude = first[cell / kCells] * second[cell % kCells];
    all += amplitude;
    seen += passed[cell] * amplitude;
  }
  return std::norm(all) > 0 ? std::norm(seen) / std::norm(all) : 0;
}

}  // namespace insonify
