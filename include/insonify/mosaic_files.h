// mosaic_files.h -- writes the cells of a mosaic for other programs.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/survey/geographic.h"
#include "insonify/survey/mosaic.h"

namespace insonify {

/// Endings that write_mosaic() knows.
inline constexpr std::string_view kMosaicEndings = ".npz, .tif, .asc";

/// Writes a mosaic in the format of the file's ending:
///
/// - .npz: arrays `intensity`, `angle`, `line` and, where there is ground truth, `instance` and `instance_names`,
///   rows from the north; `x` and `y` of the middles of columns and rows [m]; `origin` [deg], if it is given;
/// - .tif: GeoTIFF of the intensities, 32-bit floats with NaN for cells that were not seen: in degrees (EPSG:4326)
///   where an origin is given, else in metres of the world;
/// - .asc: ESRI ASCII grid of the intensities in metres of the world, -9999 for cells that were not seen.
///
/// The file appears when it is whole.
/// @throws Error with the path for another ending, and where it cannot be written.
void write_mosaic(const Mosaic& mosaic, const std::filesystem::path& file,
                  const std::optional<GeographicPoint>& origin = {},
                  const std::vector<std::string>& instance_names = {});

/// The text of a world file (.pgw) for a picture with a pixel for each cell: sizes of a pixel and the middle of the
/// upper left one, in metres of the world or in degrees.
[[nodiscard]] std::string world_file_text(const Mosaic& mosaic, const std::optional<GeographicPoint>& origin = {});

}  // namespace insonify
