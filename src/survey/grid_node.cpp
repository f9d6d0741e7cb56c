// grid_node.cpp -- robust medians, weighted means and their uncertainties.

#include "survey/grid_node.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

// Of values in order.
double median_of_sorted(const std::vector<double>& values) {
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double median_height(const std::vector<NodeSounding>& sorted) {
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle].height : 0.5 * (sorted[middle - 1].height + sorted[middle].height);
}

// Removes outliers. Of two soundings none is more credible than the other.
void refuse_outliers(std::vector<NodeSounding>& sorted, double outliers) {
  constexpr std::size_t kFewest = 3;
  constexpr double kDeviationByMedian = 1.4826;  // Of a normal distribution, by its median absolute deviation.
  if (outliers <= 0 || sorted.size() < kFewest) {
    return;
  }
  const double median = median_height(sorted);
  std::vector<double> distances;
  distances.reserve(sorted.size());
  for (const NodeSounding& sounding : sorted) {
    distances.push_back(std::abs(sounding.height - median));
  }
  std::ranges::sort(distances);
  const double spread = kDeviationByMedian * median_of_sorted(distances);
  std::erase_if(sorted, [&](const NodeSounding& sounding) {
    return std::abs(sounding.height - median) > outliers * std::max(spread, sounding.deviation);
  });
}

// By how much more soundings scatter about a height than they state; at least 1.
double birge_ratio(const std::vector<NodeSounding>& soundings, double height) {
  double chi_squared = 0;
  for (const NodeSounding& sounding : soundings) {
    chi_squared += std::pow((sounding.height - height) / sounding.deviation, 2);
  }
  return soundings.size() < 2 ? 1 : std::max(1.0, std::sqrt(chi_squared / static_cast<double>(soundings.size() - 1)));
}

GridNode weighted_mean(const std::vector<NodeSounding>& soundings) {
  double weights = 0, sum = 0;
  for (const NodeSounding& sounding : soundings) {
    const double weight = 1 / (sounding.deviation * sounding.deviation);
    weights += weight;
    sum += weight * sounding.height;
  }
  return {.height = sum / weights, .uncertainty = 1 / std::sqrt(weights)};
}

// The median of n normal variables of densities f_i at their common middle has the variance n / (2 sum f_i)^2.
GridNode median_node(const std::vector<NodeSounding>& sorted) {
  double densities = 0;
  for (const NodeSounding& sounding : sorted) {
    densities += 1 / (sounding.deviation * std::sqrt(2 * std::numbers::pi));
  }
  // A mean of one or two.
  return sorted.size() < 3 ? GridNode{.height = median_height(sorted), .uncertainty = weighted_mean(sorted).uncertainty}
                           : GridNode{.height = median_height(sorted),
                                      .uncertainty = std::sqrt(static_cast<double>(sorted.size())) / (2 * densities)};
}

}  // namespace

GridNode node_of(std::vector<NodeSounding>& soundings, GridMethod method, double outliers) {
  // By deviation too, so that the node does not depend on the order of equal heights.
  std::ranges::sort(soundings, [](const NodeSounding& a, const NodeSounding& b) {
    return a.height != b.height ? a.height < b.height : a.deviation < b.deviation;
  });
  refuse_outliers(soundings, outliers);
  GridNode node;
  if (method == GridMethod::kShoal) {
    node = {.height = soundings.back().height, .uncertainty = soundings.back().deviation};
  } else {
    node = method == GridMethod::kMean ? weighted_mean(soundings) : median_node(soundings);
    node.uncertainty *= birge_ratio(soundings, node.height);
  }
  node.count = static_cast<std::uint32_t>(soundings.size());
  return node;
}

}  // namespace insonify
