// window.cpp -- window functions. Those of Taylor and Dolph are also in Van Trees, Optimum Array Processing (2002),
// sections 3.1 and 3.4.

#include "sonar/window.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

using std::numbers::pi;

// Amplitude of the main lobe over that of the side lobes.
double lobe_ratio(const ArraySettings& settings) {
  return std::pow(10, -settings.side_lobe_db / 20);
}

// Taylor (1955): side lobes are level up to number nbar, as in Dolph's pattern, and fall as 1/x beyond. The pattern
// reaches the level only with an nbar of at least 2 A^2 + 1/2; with a smaller one the first side lobes are higher.
std::vector<WindowCosine> taylor_weight(const ArraySettings& settings) {
  constexpr int kLeastLevel = 4;  // Side lobes that are level, where fewer would do.
  const double a = std::acosh(lobe_ratio(settings)) / pi;
  const int nbar =
      settings.nbar > 0 ? settings.nbar : std::max(kLeastLevel, static_cast<int>(std::lround(2 * a * a + 0.5)));
  const double dilation_squared = nbar * nbar / (a * a + (nbar - 0.5) * (nbar - 0.5));
  std::vector<WindowCosine> weight{{0, 1}};
  for (int m = 1; m < nbar; ++m) {
    double coefficient = m % 2 == 1 ? 1 : -1;
    for (int i = 1; i < nbar; ++i) {
      coefficient *= 1 - m * m / dilation_squared / (a * a + (i - 0.5) * (i - 0.5));
      coefficient /= i == m ? 1 : 1 - static_cast<double>(m * m) / (i * i);
    }
    weight.push_back({static_cast<double>(m), coefficient});
  }
  return weight;
}

// Chebyshev polynomial T_n(x), for any x.
double chebyshev(int n, double x) {
  if (std::abs(x) <= 1) {
    return std::cos(n * std::acos(x));
  }
  return (x < 0 && n % 2 == 1 ? -1 : 1) * std::cosh(n * std::acosh(std::abs(x)));
}

// Dolph (1946): the pattern is T_{N-1}(x0 cos(psi / 2)), whose side lobes are all level. The weights are the discrete
// Fourier transform of N samples of it.
std::vector<double> dolph_chebyshev_weights(const ArraySettings& settings) {
  const int count = settings.elements;
  const double x0 = std::cosh(std::acosh(lobe_ratio(settings)) / (count - 1));
  std::vector<double> weights(count);
  for (int k = 0; k < count; ++k) {
    const double pattern = chebyshev(count - 1, x0 * std::cos(pi * k / count));
    for (int n = 0; n < count; ++n) {
      weights[n] += pattern * std::cos(2 * pi * k * (n - (count - 1) / 2.0) / count);
    }
  }
  return weights;
}

// Length of the window, in elements. The zeros of a Hann window are one element beyond the ends of the array, so that
// no element has weight 0; the ends of a Hamming window are at the outermost elements. Other windows are as long as the
// array and are sampled at the middle of each element.
int window_length(ArrayWindow window, int elements) {
  switch (window) {
    case ArrayWindow::kHann:
      return elements + 1;
    case ArrayWindow::kHamming:
      return elements - 1;
    default:
      return elements;
  }
}

// Integral of e^(i pi (t^2 - v^2) / 2) over t from v >= 0 to infinity, to 1e-8: the Fresnel integrals' power series
// near 0, beyond their continued fraction (Press et al., Numerical Recipes, 3rd ed. (2007), section 6.8.1).
std::complex<double> fresnel_tail(double v) {
  constexpr double kSeriesEnd = 1.5, kLeastTerm = 1e-10;
  const double turn = 0.5 * pi * v * v;
  if (v < kSeriesEnd) {
    std::complex<double> sum = 0, term = v;
    for (int n = 0; std::norm(term) > kLeastTerm * kLeastTerm; ++n) {
      sum += term / (2.0 * n + 1);
      term *= std::complex<double>(0, turn / (n + 1));
    }
    return std::polar(1.0, -turn) * (std::complex<double>(0.5, 0.5) - sum);
  }
  const int depth = static_cast<int>(3 + 30 / (v * v));
  std::complex<double> rest(1 + 4 * depth, -2 * turn);
  for (int k = depth; k > 0; --k) {
    const std::complex<double> part = (2 * k - 1) * (2 * k) / std::norm(rest) * std::conj(rest);
    rest = std::complex<double>(4 * k - 3, -2 * turn) - part;
  }
  return v / std::norm(rest) * std::conj(rest);
}

// Integral of e^(i (2 pi x s + 4 phase s^2)) over s from -1/2 to 1/2; phase > 0. With t = c s + 2 x / c, c^2 = 8 phase
// / pi, the exponent is i pi / 2 (t^2 - (2 x / c)^2), so it is a difference of two Fresnel integrals.
std::complex<double> defocused_line(double x, double phase) {
  const double scale = std::sqrt(8 * phase / pi), place = 2 * x / scale;
  const auto tail = [&](double end, double turn) {  // Of the end of the line at t = end.
    return (end < 0 ? -1.0 : 1.0) * std::polar(1.0, turn) * fresnel_tail(std::abs(end));
  };
  const double low = place - 0.5 * scale, high = place + 0.5 * scale;
  std::complex<double> sum = tail(low, phase - pi * x) - tail(high, phase + pi * x);
  if (low < 0 && high >= 0) {
    sum += std::polar(std::numbers::sqrt2, 0.25 * pi - 0.5 * pi * place * place);
  }
  return sum / scale;
}

}  // namespace

std::vector<WindowCosine> line_weight(const ArraySettings& settings) {
  switch (settings.window) {
    case ArrayWindow::kHann:
      return {{0, 0.5}, {1, 0.5}};
    case ArrayWindow::kHamming:
      return {{0, 0.54}, {1, 0.46}};
    case ArrayWindow::kCosine:
      return {{0.5, 1}};
    case ArrayWindow::kTaylor:
      return taylor_weight(settings);
    case ArrayWindow::kRectangular:
    case ArrayWindow::kDolphChebyshev:
      break;
  }
  return {{0, 1}};
}

std::vector<double> element_weights(const ArraySettings& settings) {
  if (settings.window == ArrayWindow::kDolphChebyshev) {
    return dolph_chebyshev_weights(settings);
  }
  const std::vector<WindowCosine> weight = line_weight(settings);
  const double length = window_length(settings.window, settings.elements);
  std::vector<double> weights(settings.elements);
  for (int n = 0; n < settings.elements; ++n) {
    const double s = (n - (settings.elements - 1) / 2.0) / length;
    for (const WindowCosine& part : weight) {
      weights[n] += part.share * std::cos(2 * pi * part.turns * s);
    }
  }
  return weights;
}

double sinc(double x) {
  const double angle = pi * x;
  return std::abs(angle) < 1e-5 ? 1 - angle * angle / 6 : std::sin(angle) / angle;
}

double line_pattern(const std::vector<WindowCosine>& weight, double x) {
  double sum = 0;
  for (const WindowCosine& part : weight) {
    sum += part.share * 0.5 * (sinc(x - part.turns) + sinc(x + part.turns));
  }
  return sum;
}

std::complex<double> defocused_line_pattern(const std::vector<WindowCosine>& weight, double x, double edge_phase) {
  const double phase = std::abs(edge_phase);
  std::complex<double> sum = 0;
  for (const WindowCosine& part : weight) {
    const std::complex<double> shifted = defocused_line(x - part.turns, phase);
    sum += part.share * (part.turns == 0 ? shifted : 0.5 * (shifted + defocused_line(x + part.turns, phase)));
  }
  return edge_phase < 0 ? std::conj(sum) : sum;
}

double line_power(const std::vector<WindowCosine>& weight) {
  double sum = 0;
  for (const WindowCosine& part : weight) {
    sum += part.share * line_pattern(weight, part.turns);
  }
  return sum;
}

}  // namespace insonify
