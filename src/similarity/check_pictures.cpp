// check_pictures.cpp -- checks that pictures can be compared.

#include "similarity/check_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"

namespace insonify {
namespace {

std::string shape_of(const GreyPicture& picture) {
  return fmt::format("{} columns x {} rows", picture.columns, picture.rows);
}

void check_levels(const GreyPicture& picture) {
  const auto wrong = std::ranges::find_if(picture.values, [](double value) { return !(value >= 0 && value <= 1); });
  if (wrong != picture.values.end()) {
    const auto at = wrong - picture.values.begin();
    throw Error(fmt::format("{}: the value in column {}, row {} is {:.6g}; it must be from 0 to full scale, 1",
                            picture.name, at % picture.columns, at / picture.columns, *wrong));
  }
}

}  // namespace

void check_table(const GreyPicture& picture) {
  const auto columns = static_cast<std::size_t>(std::max(0, picture.columns));
  const auto rows = static_cast<std::size_t>(std::max(0, picture.rows));
  if (columns * rows == 0 || picture.values.size() != columns * rows) {
    throw Error(fmt::format("{}: {} must hold at least one pixel and a value for each, not {} values", picture.name,
                            shape_of(picture), picture.values.size()));
  }
}

void check_pair(const GreyPicture& a, const GreyPicture& b) {
  check_table(a);
  check_table(b);
  if (a.columns != b.columns || a.rows != b.rows) {
    throw Error(fmt::format("{}: {}, but {} has {}", b.name, shape_of(b), a.name, shape_of(a)));
  }
}

void check_side(const GreyPicture& picture, int side, const char* measure) {
  if (std::min(picture.columns, picture.rows) < side) {
    throw Error(fmt::format("{}: {}; {} needs at least {} x {}", picture.name, shape_of(picture), measure, side, side));
  }
}

void check_comparable(const GreyPicture& picture) {
  check_table(picture);
  check_levels(picture);
  check_side(picture, kSsimSide, "SSIM");
  const auto [least, most] = std::ranges::minmax(picture.values);
  if (least == most) {
    throw Error(fmt::format("{}: every value is {:.6g}; there is nothing to compare in a constant picture",
                            picture.name, least));
  }
}

}  // namespace insonify
