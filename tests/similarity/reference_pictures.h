// reference_pictures.h -- pictures given by formulas, and their similarities as computed by other programs.
//
// The numbers were computed with scikit-image's structural_similarity (gaussian_weights, sigma 1.5, population
// moments, data_range 1) and with two independent codes of MS-SSIM, which agree to 1e-13.

#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "insonify/similarity.h"

namespace insonify {

/// Waves and squares of 8 pixels: side x side pixels from 0.2 to 0.8.
inline GreyPicture waves_and_squares(int side) {
  GreyPicture picture{"a", side, side, {}};
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double wave = std::sin(2 * std::numbers::pi * i / 16) * std::cos(2 * std::numbers::pi * j / 32);
      picture.values.push_back(0.5 + 0.2 * wave + 0.2 * ((i / 8 + j / 8) % 2 - 0.5));
    }
  }
  return picture;
}

/// Uniform numbers that every language makes alike: .02040268573909998 .01654784823767841 .5431557944975793 ...
class PlainRandom {
 public:
  double next() {
    state_ = 1664525 * state_ + 1013904223;
    return state_ / 4294967296.0;
  }

 private:
  std::uint32_t state_ = 12345;
};

/// The picture with each value changed by its own value and a random number.
inline GreyPicture changed(const GreyPicture& picture,
                           const std::function<double(double value, double random)>& change) {
  GreyPicture result{"b", picture.columns, picture.rows, picture.values};
  PlainRandom random;
  for (double& value : result.values) {
    value = change(value, random.next());
  }
  return result;
}

inline GreyPicture with_gain(const GreyPicture& a) {
  return changed(a, [](double value, double) { return 0.8 * value + 0.1; });
}
inline GreyPicture with_offset(const GreyPicture& a) {
  return changed(a, [](double value, double) { return value + 0.05; });
}
inline GreyPicture with_noise(const GreyPicture& a, double strength = 0.2) {
  return changed(a, [=](double value, double random) { return value + strength * (random - 0.5); });
}
/// One column to the right, the last one coming first.
inline GreyPicture shifted(const GreyPicture& a) {
  GreyPicture result{"b", a.columns, a.rows, a.values};
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const std::size_t column = i % static_cast<std::size_t>(a.columns);
    result.values[i] = column > 0 ? a.values[i - 1] : a.values[i + static_cast<std::size_t>(a.columns) - 1];
  }
  return result;
}
/// Rayleigh speckle of mean one. Its peaks go beyond full scale.
inline GreyPicture with_speckle(const GreyPicture& a) {
  return changed(a, [](double value, double random) {
    return value * std::sqrt(-std::log(1 - random)) / (std::sqrt(std::numbers::pi) / 2);
  });
}

}  // namespace insonify
