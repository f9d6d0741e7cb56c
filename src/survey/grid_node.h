// grid_node.h -- height and uncertainty of one cell from the soundings in it.

#pragma once

#include <cstdint>
#include <vector>

#include "insonify/survey/sounding_grid.h"

namespace insonify {

/// What a cell needs of a sounding.
struct NodeSounding {
  double height = 0;     ///< [m]
  double deviation = 0;  ///< [m]
};

struct GridNode {
  double height = 0, uncertainty = 0;  ///< [m]
  std::uint32_t count = 0;             ///< Soundings that are not refused, > 0.
};

/// @param soundings  At least one. Sorted by height afterwards, without outliers.
[[nodiscard]] GridNode node_of(std::vector<NodeSounding>& soundings, GridMethod method, double outliers);

}  // namespace insonify
