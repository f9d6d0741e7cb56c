// diffraction.cpp -- Fresnel integrals by a power series near zero and a continued fraction beyond; Keller's
// coefficient of a wedge.

#include "acoustics/diffraction.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace insonify {
namespace {

using Complex = std::complex<double>;

constexpr double kSeriesEnd = 1.6;  // Beyond, the series' terms grow before they shrink, which costs digits.
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The integral of exp(i pi t^2/2), term by term: Abramowitz and Stegun 7.3.11 and 7.3.13 in one.
Complex power_series(double x) {
  const Complex step{0, std::numbers::pi / 2 * x * x};
  Complex term = x;
  Complex sum = x;
  for (int n = 1; std::abs(term) > kEpsilon * std::abs(sum); ++n) {
    term *= step / static_cast<double>(n);
    sum += term / static_cast<double>(2 * n + 1);
  }
  return sum;
}

// sqrt(pi) exp(z^2) erfc(z) = 1/(z + (1/2)/(z + 1/(z + (3/2)/(z + ...)))), Abramowitz and Stegun 7.1.14, evaluated from
// the inside out. Sixty steps are exact to rounding for |z| >= 2.
Complex erfc_fraction(Complex z) {
  constexpr int kSteps = 60;
  Complex tail = z;
  for (int n = kSteps; n > 0; --n) {
    tail = z + n / 2.0 / tail;
  }
  return 1.0 / tail;
}

// Abramowitz and Stegun 7.3.22: C + i S = (1 + i)/2 erf(z), z = sqrt(pi)/2 (1 - i) x, where exp(-z^2) = exp(i pi
// x^2/2).
Complex from_error_function(double x) {
  const Complex z = std::sqrt(std::numbers::pi) / 2 * x * Complex{1, -1};
  const Complex erfc = std::polar(1 / std::sqrt(std::numbers::pi), std::numbers::pi / 2 * x * x) * erfc_fraction(z);
  return Complex{0.5, 0.5} * (1.0 - erfc);
}

double cotangent(double angle) {
  return std::cos(angle) / std::sin(angle);
}

}  // namespace

Complex fresnel_integral(double x) {
  assert(x >= 0);
  return x < kSeriesEnd ? power_series(x) : from_error_function(x);
}

Complex fresnel_between(double from, double to) {
  const auto odd = [](double x) { return std::copysign(1.0, x) * fresnel_integral(std::abs(x)); };
  return odd(to) - odd(from);
}

double wedge_backscatter(double exterior, const std::array<WedgeFace, 2>& faces, double mirror) {
  double sum = 2 * cotangent(0.5 * std::numbers::pi / exterior);
  for (const WedgeFace& face : faces) {
    const double off =
        0.5 * std::numbers::pi - face.angle;  // < 0 if the edge is the end of the face nearest to the source.
    const double held = off < 0 ? std::min(off, -mirror) : std::max(off, mirror);
    sum += face.reflection * cotangent(held / exterior);
  }
  return -sum / (4 * std::numbers::pi * exterior);
}

}  // namespace insonify
