// similarity.cpp -- similarity measures of pictures: error, correlation, KS distance, and all measures together.

#include "insonify/similarity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "insonify/error.h"
#include "similarity/check_pictures.h"

namespace insonify {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> sorted(std::span<const double> sample) {
  if (sample.empty() || std::ranges::any_of(sample, [](double value) { return std::isnan(value); })) {
    throw Error(fmt::format("a sample of {} values must have at least one and no NaN", sample.size()));
  }
  std::vector<double> result(sample.begin(), sample.end());
  std::ranges::sort(result);
  return result;
}

// Levels rounded to single precision, so that files of integers and files of floats with the same levels have equal
// values.
std::vector<double> single_precision(const GreyPicture& picture) {
  const std::vector<float> rounded(picture.values.begin(), picture.values.end());
  return {rounded.begin(), rounded.end()};
}

Similarity measured(const GreyPicture& a, const GreyPicture& b, const SimilarityOptions& options) {
  Similarity result;
  result.mse = mean_squared_error(a, b);
  result.psnr_db = psnr_db(result.mse);
  result.ssim = ssim(a, b);
  if (options.ms_ssim) {
    result.ms_ssim = ms_ssim(a, b);
  }
  result.correlation = correlation(a, b);
  result.ks_distance = ks_distance(single_precision(a), single_precision(b));
  return result;
}

}  // namespace

double mean_squared_error(const GreyPicture& a, const GreyPicture& b) {
  check_pair(a, b);
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double difference = a.values[i] - b.values[i];
    sum += difference * difference;
  }
  return sum / static_cast<double>(a.values.size());
}

double psnr_db(double mse) {
  return mse > 0 ? -10 * std::log10(mse) : std::numeric_limits<double>::infinity();
}

double correlation(const GreyPicture& a, const GreyPicture& b) {
  check_pair(a, b);
  const auto is_constant = [](const GreyPicture& picture) {
    return std::ranges::all_of(picture.values, [&](double value) { return value == picture.values.front(); });
  };
  if (is_constant(a) || is_constant(b)) {
    return 0;
  }
  const double mean_a = mean(a.values), mean_b = mean(b.values);
  double aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double from_a = a.values[i] - mean_a, from_b = b.values[i] - mean_b;
    aa += from_a * from_a;
    bb += from_b * from_b;
    ab += from_a * from_b;
  }
  return std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0);
}

double ks_distance(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> x = sorted(a), y = sorted(b);
  // Both cumulative distributions are step functions. Their difference is evaluated after each distinct value of either
  // sample.
  double largest = 0;
  for (std::size_t i = 0, j = 0; i < x.size() && j < y.size();) {
    const double level = std::min(x[i], y[j]);
    for (; i < x.size() && x[i] == level; ++i) {
    }
    for (; j < y.size() && y[j] == level; ++j) {
    }
    const double below_x = static_cast<double>(i) / static_cast<double>(x.size());
    const double below_y = static_cast<double>(j) / static_cast<double>(y.size());
    largest = std::max(largest, std::abs(below_x - below_y));
  }
  return largest;
}

NormalisedSimilarity normalised(const Similarity& similarity) {
  static const double kEightBitsDb = 20 * std::log10(255.0);
  return {.mse = 1 - similarity.mse,
          .psnr = std::min(1.0, similarity.psnr_db / kEightBitsDb),
          .ssim = std::max(0.0, similarity.ssim),
          .ms_ssim = similarity.ms_ssim};
}

Similarity compare_pictures(const GreyPicture& a, const GreyPicture& b, const SimilarityOptions& options) {
  check_pair(a, b);
  check_comparable(a);
  check_comparable(b);
  return measured(a, b, options);
}

ControlSimilarities compare_controls(const GreyPicture& picture, const SimilarityOptions& options) {
  check_comparable(picture);
  return {.flat_grey = measured(picture, flat_grey(picture), options),
          .range_profile = measured(picture, mean_range_profile(picture), options),
          .pixel_shuffle = measured(picture, pixel_shuffle(picture), options)};
}

}  // namespace insonify
