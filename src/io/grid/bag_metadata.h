// bag_metadata.h -- what the XML inside a BAG says of its grid.

#pragma once

#include <optional>
#include <string>

#include "insonify/geometry.h"

namespace insonify {

struct BagMetadata {
  std::optional<double> spacing_x;  ///< Between columns, in the units of the reference system.
  std::optional<double> spacing_y;  ///< Between rows.
  std::optional<Vec3> south_west;   ///< Of the grid's corner points; z is 0.
  std::optional<Vec3> north_east;
  std::optional<bool> is_geographic;  ///< Whether those units are degrees; nothing where the XML does not tell.
};

/// Finds them in ISO 19139 metadata of any BAG version: names are compared without their namespaces, which changed.
[[nodiscard]] BagMetadata parse_bag_metadata(const std::string& xml);

}  // namespace insonify
