// texture_law.cpp -- tabulates the quantiles of the gamma distribution by those of the normal one, and integrates the
// correlation of the texture.

#include "receiver/speckle/texture_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/gamma_quantiles.h"

namespace insonify {
namespace {

constexpr float kStepsPerUnit = 32;  // Table entries per standard deviation of the field.
constexpr float kGreatest = 5.5F;    // Greatest value of the field in the table [standard deviations].

// log(u / (1 - u)) of the probability u of a normal number.
double logit_of(double normal) {
  return std::log(std::erfc(-normal / std::numbers::sqrt2) / std::erfc(normal / std::numbers::sqrt2));
}

// Correlation of the texture at two points by the correlation of the field there. With the texture's Hermite
// coefficients a_k it is the sum of a_k^2 rho^k over that of a_k^2, k >= 1 (Mehler's formula).
class TextureCorrelation {
 public:
  explicit TextureCorrelation(const TextureLaw& texture) {
    std::array<double, kOrders + 1> coefficients = {};
    constexpr int kPerUnit = 64, kEnd = static_cast<int>(kGreatest * kPerUnit);
    for (int i = -kEnd; i <= kEnd; ++i) {
      const double x = static_cast<double>(i) / kPerUnit;
      const double weighted = double{texture.at(static_cast<float>(x))} * std::exp(-0.5 * x * x);
      double before = 0, polynomial = 1;  // Hermite polynomials over the square root of k!.
      for (int k = 0; k <= kOrders; ++k) {
        coefficients[k] += weighted * polynomial;
        const double next = (x * polynomial - std::sqrt(static_cast<double>(k)) * before) / std::sqrt(k + 1.0);
        before = polynomial;
        polynomial = next;
      }
    }
    double sum = 0;
    for (int k = 1; k <= kOrders; ++k) {
      sum += coefficients[k] * coefficients[k];
    }
    for (int i = 0; i <= kSteps; ++i) {
      double power = 1, value = 0;
      for (int k = 1; k <= kOrders; ++k) {
        power *= static_cast<double>(i) / kSteps;
        value += coefficients[k] * coefficients[k] * power;
      }
      values_[i] = value / sum;
    }
  }

  [[nodiscard]] double at(double field) const {
    const double place = std::clamp(field, 0.0, 1.0) * kSteps;
    const int below = std::min(static_cast<int>(place), kSteps - 1);
    return values_[below] + (place - below) * (values_[below + 1] - values_[below]);
  }

 private:
  static constexpr int kOrders = 40, kSteps = 256;
  std::array<double, kSteps + 1> values_ = {};
};

// Sum of the products of the shares that two points on a line have of the same numbers.
float shared(double here, double there) {
  const double cell = std::floor(here), other = std::floor(there);
  Floats low, high;
  smooth_shares(Floats{static_cast<float>(here - cell), static_cast<float>(there - other)}, low, high);
  return other == cell       ? low[0] * low[1] + high[0] * high[1]
         : other == cell + 1 ? high[0] * low[1]
         : other == cell - 1 ? low[0] * high[1]
                             : 0.0F;
}

}  // namespace

TextureLaw::TextureLaw(double shape, double the_length) : length(the_length), edge(the_length) {
  const GammaQuantiles quantiles(shape);
  const int count = static_cast<int>(2 * kGreatest * kStepsPerUnit) + 2;
  for (int i = 0; i < count; ++i) {
    values_.push_back(quantiles.at(static_cast<float>(logit_of(i / double{kStepsPerUnit} - double{kGreatest}))));
  }
  edge = length * unit_edge(*this);
}

float TextureLaw::at(float normal) const {
  const float place = (std::clamp(normal, -kGreatest, kGreatest) + kGreatest) * kStepsPerUnit;
  const auto below = static_cast<int>(place);
  return values_[below] + (place - static_cast<float>(below)) * (values_[below + 1] - values_[below]);
}

// The integral over the plane of the correlation, for cubes of edge 1, by a sum over separations, averaged over places
// of the first point in the three lattices.
double unit_edge(const TextureLaw& texture) {
  const TextureCorrelation correlation(texture);
  constexpr int kPlaces = 12, kHalf = 20;
  constexpr double kStep = 0.125;  // Between two separations along an axis [edges]; numbers are shared up to 2 edges.
  double integral = 0;
  for (int place = 0; place < kPlaces; ++place) {
    for (int i = -kHalf; i <= kHalf; ++i) {
      for (int j = -kHalf; j <= kHalf; ++j) {
        double field = 0;
        for (int lattice = 0; lattice < TextureLaw::kLattices; ++lattice) {
          const double c = std::cos(lattice * std::numbers::pi / 6), s = std::sin(lattice * std::numbers::pi / 6);
          const double x = std::fmod((3 * place + lattice + 1) * 0.7548776662, 1);  // Evenly spread.
          const double y = std::fmod((3 * place + lattice + 1) * 0.5698402910, 1);
          const double a = (c * i + s * j) * kStep, b = (c * j - s * i) * kStep;
          field += double{shared(x, x + a)} * double{shared(y, y + b)} / TextureLaw::kLattices;
        }
        integral += correlation.at(field) * kStep * kStep / kPlaces;
      }
    }
  }
  return 1 / std::sqrt(integral);
}

}  // namespace insonify
