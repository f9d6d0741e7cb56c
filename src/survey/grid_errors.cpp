// grid_errors.cpp -- compares the heights of a grid with the truth and with the limits of hydrographic orders.

#include <algorithm>
#include <array>
#include <cmath>

#include "insonify/survey/sounding_grid.h"

namespace insonify {

std::optional<GridErrors> errors_of(const SoundingGrid& grid, double datum) {
  GridErrors errors;
  std::vector<double> sizes;
  double sum = 0, squares = 0;
  std::array<std::uint64_t, 3> allowed{};
  for (std::size_t cell = 0; cell < grid.truth.size(); ++cell) {
    const auto height = static_cast<double>(grid.height[cell]), truth = static_cast<double>(grid.truth[cell]);
    const double difference = height - truth;
    if (std::isnan(difference)) {
      continue;
    }
    sum += difference;
    squares += difference * difference;
    sizes.push_back(std::abs(difference));
    for (const SurveyOrder order : {SurveyOrder::kExclusive, SurveyOrder::kSpecial, SurveyOrder::k1a}) {
      allowed[static_cast<std::size_t>(order)] += sizes.back() <= allowed_uncertainty(order, datum - truth) ? 1 : 0;
    }
  }
  if (sizes.empty()) {
    return std::nullopt;
  }
  const auto count = static_cast<double>(sizes.size());
  errors.cells = sizes.size();
  errors.mean = sum / count;
  errors.deviation = std::sqrt(std::max(0.0, squares / count - errors.mean * errors.mean));
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * count)) - 1;
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  errors.within_95 = sizes[static_cast<std::size_t>(rank)];
  errors.exclusive = static_cast<double>(allowed[0]) / count;
  errors.special = static_cast<double>(allowed[1]) / count;
  errors.order_1a = static_cast<double>(allowed[2]) / count;
  return errors;
}

}  // namespace insonify
