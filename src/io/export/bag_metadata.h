// bag_metadata.h -- the metadata of a Bathymetric Attributed Grid, as XML of ISO 19139.

#pragma once

#include <optional>
#include <string>

#include "io/export/raster_files.h"

namespace insonify {

struct BagFacts {
  PlanRaster raster;
  std::optional<GeographicPoint> origin = {};  ///< Present: the grid is in degrees.
  std::string title = {}, abstract = {}, process = {};
  double datum = 0;       ///< Height in the world that is 0 in the grid [m].
  std::string date = {};  ///< "2026-06-01"
};

[[nodiscard]] std::string bag_metadata(const BagFacts& facts);

}  // namespace insonify
