// structure.cpp -- structural similarity: SSIM, and MS-SSIM at up to five scales.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "similarity/check_pictures.h"

namespace insonify {
namespace {

// Stabilising constants for pictures of full scale 1: (K1 L)^2 and (K2 L)^2.
constexpr double kLuminanceFloor = 0.01 * 0.01;
constexpr double kContrastFloor = 0.03 * 0.03;

using Taps = std::array<double, kSsimSide>;

// One-dimensional Gaussian of standard deviation 1.5 pixels and sum 1. The window is its product in rows and columns.
Taps gaussian_taps() {
  constexpr double kDeviation = 1.5;
  constexpr int kMiddle = kSsimSide / 2;
  Taps taps{};
  double sum = 0;
  for (int i = 0; i < kSsimSide; ++i) {
    const double distance = (i - kMiddle) / kDeviation;
    taps[i] = std::exp(-distance * distance / 2);
    sum += taps[i];
  }
  for (double& tap : taps) {
    tap /= sum;
  }
  return taps;
}

// A picture of any numbers, row-major.
struct Plane {
  Plane(int column_count, int row_count)
      : columns(column_count), rows(row_count), values(static_cast<std::size_t>(columns) * rows) {}
  explicit Plane(const GreyPicture& picture) : columns(picture.columns), rows(picture.rows), values(picture.values) {}

  [[nodiscard]] double* row(int index) { return &values[static_cast<std::size_t>(index) * columns]; }
  [[nodiscard]] const double* row(int index) const { return &values[static_cast<std::size_t>(index) * columns]; }

  int columns, rows;
  std::vector<double> values;
};

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.columns, a.rows);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = a.values[i] * b.values[i];
  }
  return result;
}

// Weighted mean in each window that lies inside the picture: first along columns, then along rows.
Plane window_mean(const Plane& plane) {
  static const Taps kTaps = gaussian_taps();
  Plane down(plane.columns, plane.rows - kSsimSide + 1);
  for (int y = 0; y < down.rows; ++y) {
    for (int k = 0; k < kSsimSide; ++k) {
      for (int x = 0; x < down.columns; ++x) {
        down.row(y)[x] += kTaps[k] * plane.row(y + k)[x];
      }
    }
  }
  Plane result(plane.columns - kSsimSide + 1, down.rows);
  for (int y = 0; y < result.rows; ++y) {
    for (int k = 0; k < kSsimSide; ++k) {
      for (int x = 0; x < result.columns; ++x) {
        result.row(y)[x] += kTaps[k] * down.row(y)[x + k];
      }
    }
  }
  return result;
}

// Means over all windows of the contrast-structure term (`pattern`), and of its product with luminance (`all`).
struct Structure {
  double pattern = 0;
  double all = 0;
};

Structure structure(const Plane& a, const Plane& b) {
  const Plane mean_a = window_mean(a), mean_b = window_mean(b);
  const Plane square_a = window_mean(product(a, a)), square_b = window_mean(product(b, b));
  const Plane cross = window_mean(product(a, b));

  Structure sum;
  for (std::size_t i = 0; i < cross.values.size(); ++i) {
    const double ma = mean_a.values[i], mb = mean_b.values[i];
    const double variances = square_a.values[i] - ma * ma + square_b.values[i] - mb * mb;
    const double covariance = cross.values[i] - ma * mb;
    const double brightness = (2 * ma * mb + kLuminanceFloor) / (ma * ma + mb * mb + kLuminanceFloor);
    const double pattern = (2 * covariance + kContrastFloor) / (variances + kContrastFloor);
    sum.pattern += pattern;
    sum.all += brightness * pattern;
  }
  const auto count = static_cast<double>(cross.values.size());
  return {sum.pattern / count, sum.all / count};
}

// Half the resolution: means of 2 x 2 pixels.
Plane halved(const Plane& plane) {
  Plane result(plane.columns / 2, plane.rows / 2);
  for (int y = 0; y < result.rows; ++y) {
    const double* upper = plane.row(2 * y);
    const double* lower = plane.row(2 * y + 1);
    for (int x = 0; x < result.columns; ++x, upper += 2, lower += 2) {
      result.row(y)[x] = (upper[0] + upper[1] + lower[0] + lower[1]) / 4;
    }
  }
  return result;
}

}  // namespace

double ssim(const GreyPicture& a, const GreyPicture& b) {
  check_pair(a, b);
  check_side(a, kSsimSide, "SSIM");
  return structure(Plane(a), Plane(b)).all;
}

int ms_ssim_scales(int columns, int rows) {
  int scales = 0;
  while (scales < kMsSsimScales && std::min(columns, rows) >> scales >= kSsimSide) {
    ++scales;
  }
  return scales;
}

double ms_ssim(const GreyPicture& a, const GreyPicture& b) {
  // Weights of the scales, finest first, which Wang, Simoncelli and Bovik found in experiments with viewers. They sum
  // to 1.0001, as printed.
  static constexpr std::array<double, kMsSsimScales> kWeights = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
  check_pair(a, b);
  check_side(a, kSsimSide, "MS-SSIM");
  const int scales = ms_ssim_scales(a.columns, a.rows);
  const double sum = scales == kMsSsimScales ? 1 : std::accumulate(kWeights.begin(), kWeights.begin() + scales, 0.0);
  Plane plane_a(a), plane_b(b);
  double result = 1;
  for (int scale = 0; scale < scales; ++scale) {
    const bool coarsest = scale + 1 == scales;
    const Structure found = structure(plane_a, plane_b);
    result *= std::pow(std::max(0.0, coarsest ? found.all : found.pattern), kWeights[scale] / sum);
    if (!coarsest) {
      plane_a = halved(plane_a);
      plane_b = halved(plane_b);
    }
  }
  return result;
}

}  // namespace insonify
