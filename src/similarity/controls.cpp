// controls.cpp -- control pictures without the scene's content, whose scores a useful simulation must exceed.

#include <algorithm>
#include <numeric>

#include "base/philox.h"
#include "similarity/check_pictures.h"

namespace insonify {
namespace {

constexpr std::uint64_t kShuffleSeed = 1;

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

GreyPicture flat_grey(const GreyPicture& picture) {
  check_table(picture);
  GreyPicture result = picture;
  result.name = "flat grey of " + picture.name;
  std::ranges::fill(result.values, mean(picture.values));
  return result;
}

GreyPicture mean_range_profile(const GreyPicture& picture) {
  check_table(picture);
  GreyPicture result = picture;
  result.name = "mean range profile of " + picture.name;
  const auto length = static_cast<std::size_t>(result.columns);
  for (std::size_t start = 0; start < result.values.size(); start += length) {
    const std::span<double> row(&result.values[start], length);
    std::ranges::fill(row, mean(row));
  }
  return result;
}

// Fisher-Yates shuffle: each pixel, from the last to the first, is swapped with one at or before it.
GreyPicture pixel_shuffle(const GreyPicture& picture) {
  check_table(picture);
  GreyPicture result = picture;
  result.name = "pixel shuffle of " + picture.name;
  for (std::size_t left = result.values.size(); left > 1; --left) {
    const PhiloxCounter words = philox({static_cast<std::uint32_t>(left), 0, 0, 0}, philox_key(kShuffleSeed));
    const std::size_t chosen = (words[0] * std::uint64_t{left}) >> 32;  // Uniform to within left / 2^32.
    std::swap(result.values[left - 1], result.values[chosen]);
  }
  return result;
}

}  // namespace insonify
