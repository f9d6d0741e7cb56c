// texture_correlation.h -- correlation of a patchy surface's texture, from its definition.

#pragma once

#include <algorithm>
#include <boost/math/distributions/gamma.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace insonify::validation {

/// Correlation of the texture at two places of a level bed, averaged over places and directions. The texture has the
/// quantiles of a gamma distribution where a field of normal numbers has those of a normal one. The field is the sum of
/// three square lattices, 30 degrees apart, over the square root of 3; between the numbers at the ends of an edge it
/// changes as 3 t^2 - 2 t^3, and is scaled to unit variance. Distances are in lengths: the edge of the lattices is such
/// that the integral of the correlation over the plane is 1.
class TextureCorrelation {
 public:
  explicit TextureCorrelation(double shape) : shape_(shape), of_field_(kSteps + 1) {
    tabulate_texture();
    for (int i = 0; i <= kSteps; ++i) {
      of_field_[i] = by_quadrature(static_cast<double>(i) / kSteps);
    }
    double integral = 0;
    for (int i = 0; i < kDistances; ++i) {
      by_distance_.push_back(average_at(i * kDistance));
      integral += 2 * std::numbers::pi * (i * kDistance) * by_distance_.back() * kDistance;
    }
    edge_ = 1 / std::sqrt(integral);
  }

  [[nodiscard]] double edge() const { return edge_; }

  /// @param distance  In lengths.
  [[nodiscard]] double at(double distance) const {
    const double place = distance / edge_ / kDistance;
    const auto below = static_cast<std::size_t>(place);
    return below + 1 >= by_distance_.size() ? 0
                                            : by_distance_[below] + (place - static_cast<double>(below)) *
                                                                        (by_distance_[below + 1] - by_distance_[below]);
  }

 private:
  static constexpr int kSteps = 64, kDistances = 96;
  static constexpr double kDistance = 2.9 / kDistances;  // In edges; beyond 2 sqrt(2) no number is shared.
  static constexpr double kMost = 6;     // Greatest value of the field in the table of textures [standard deviations].
  static constexpr double kFine = 0.01;  // Step of that table [standard deviations].

  void tabulate_texture() {
    const boost::math::gamma_distribution<double> gamma(shape_, 1 / shape_);
    for (double normal = -kMost; normal <= kMost + kFine; normal += kFine) {
      const double above = 0.5 * std::erfc(normal / std::numbers::sqrt2);
      textures_.push_back(boost::math::quantile(boost::math::complement(gamma, above)));
    }
  }

  [[nodiscard]] double texture(double normal) const {
    const double place = (std::clamp(normal, -kMost, kMost) + kMost) / kFine;
    const auto below = std::min(static_cast<std::size_t>(place), textures_.size() - 2);
    return textures_[below] + (place - static_cast<double>(below)) * (textures_[below + 1] - textures_[below]);
  }

  // Correlation of the textures of two normal numbers with correlation `field`.
  [[nodiscard]] double by_quadrature(double field) const {
    constexpr double kStep = 0.05;
    double sum = 0, weights = 0;
    for (double first = -kMost; first <= kMost; first += kStep) {
      for (double second = -kMost; second <= kMost; second += kStep) {
        const double weight = std::exp(-0.5 * (first * first + second * second));
        weights += weight;
        sum += weight * texture(first) * texture(field * first + std::sqrt(1 - field * field) * second);
      }
    }
    return (sum / weights - 1) * shape_;
  }

  // Shares of the number at the lattice point `number` at a place along an axis.
  static double share(double place, int number) {
    const double part = place - std::floor(place), rise = part * part * (3 - 2 * part);
    const int below = static_cast<int>(std::floor(place));
    const double own = number == below ? 1 - rise : number == below + 1 ? rise : 0;
    return own / std::hypot(rise, 1 - rise);
  }

  static double shared(double here, double there) {
    double sum = 0;
    for (int number = -4; number <= 5; ++number) {
      sum += share(here, number) * share(there, number);
    }
    return sum;
  }

  [[nodiscard]] double average_at(double distance) const {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr int kDraws = 400;
    double sum = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const double direction = 2 * std::numbers::pi * (draw + uniform(random)) / kDraws;
      double field = 0;
      for (int lattice = 0; lattice < 3; ++lattice) {
        const double turn = direction - lattice * std::numbers::pi / 6;
        const double x = uniform(random), y = uniform(random);
        field += shared(x, x + distance * std::cos(turn)) * shared(y, y + distance * std::sin(turn)) / 3;
      }
      const double place = std::clamp(field, 0.0, 1.0) * kSteps;
      const int below = std::min(static_cast<int>(place), kSteps - 1);
      sum += of_field_[below] + (place - below) * (of_field_[below + 1] - of_field_[below]);
    }
    return sum / kDraws;
  }

  double shape_, edge_ = 0;
  std::vector<double> textures_, of_field_, by_distance_;
};

}  // namespace insonify::validation
