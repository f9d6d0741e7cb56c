// bag_metadata.h -- spacing, corners and units of a BAG grid, from the XML inside the file.

#pragma once

#include <optional>
#include <string>

#include "insonify/geometry.h"

namespace insonify {

struct BagMetadata {
  std::optional<double> spacing_x;  ///< Between columns, in the units of the reference system.
  std::optional<double> spacing_y;  ///< Between rows.
  std::optional<Vec3> south_west;   ///< Corner point of the grid; z is 0.
  std::optional<Vec3> north_east;
  std::optional<bool> is_geographic;  ///< Whether the units are degrees; empty if the XML does not say.
};

/// Reads ISO 19139 metadata of any BAG version. Namespaces are ignored, since they differ between versions.
[[nodiscard]] BagMetadata parse_bag_metadata(const std::string& xml);

}  // namespace insonify
