// sounding_grid_files.h -- writes the cells of a grid of soundings for other programs.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "insonify/survey/geographic.h"
#include "insonify/survey/sounding_grid.h"

namespace insonify {

/// Endings that write_sounding_grid() knows.
inline constexpr std::string_view kSoundingGridEndings = ".bag, .tif, .asc, .npz";

struct SoundingGridFileOptions {
  std::optional<GeographicPoint> origin = {};  ///< Place of the world's origin on the Earth.
  double datum = 0;                            ///< Height in the world from which heights in files count [m].
  std::string title = {};                      ///< Name of the survey, for metadata.
};

/// Writes a grid in the format of the file's ending. Heights are positive upwards, so those of a bed below the datum
/// are negative.
///
/// - .bag: Bathymetric Attributed Grid, version 1.6: elevation and uncertainty (standard deviations), of cells without
/// a
///   height 1e6;
/// - .tif: GeoTIFF of the heights, 32-bit floats with NaN for cells without one;
/// - .asc: ESRI ASCII grid of the heights in metres of the world, -9999 for cells without one;
/// - .npz: arrays `height`, `uncertainty`, `count` and, where there is one, `truth`, rows from the north; `x` and `y`
/// of
///   the middles of columns and rows [m]; `datum` [m]; `origin` [deg], if it is given.
///
/// .bag and .tif are in degrees (EPSG:4326) where an origin is given, else in metres of the world. The file appears
/// when it is whole.
/// @throws Error with the path for another ending, for a .bag of fewer than 2 x 2 cells, and where it cannot be
/// written.
void write_sounding_grid(const SoundingGrid& grid, const std::filesystem::path& file,
                         const SoundingGridFileOptions& options = {});

}  // namespace insonify
