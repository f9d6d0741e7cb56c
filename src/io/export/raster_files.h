// raster_files.h -- grids of values in plan as GeoTIFF, ASCII grids and NumPy arrays.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/survey/geographic.h"
#include "io/export/npz_writer.h"

namespace insonify {

/// Square cells in the world, rows from the north.
struct PlanRaster {
  double west = 0, north = 0;  ///< World coordinates of the upper left corner [m].
  double cell = 0;             ///< Side of a cell [m].
  int columns = 0, rows = 0;
};

/// Sizes of a cell, and the upper left corner, in the units of a file: degrees where an origin is given, else metres of
/// the world. In degrees rows and columns are straight lines between opposite corners.
struct RasterPlacement {
  double cell_x = 0, cell_y = 0, west = 0, north = 0;
};
[[nodiscard]] RasterPlacement placement_of(const PlanRaster& raster, const std::optional<GeographicPoint>& origin);

/// GeoTIFF of 32-bit floats, NaN for cells without a value: in degrees (EPSG:4326) where an origin is given, else in
/// metres of the world.
/// @param values  [row * columns + column]
/// @throws Error with the path.
void write_tiff_raster(const PlanRaster& raster, std::span<const float> values, const std::filesystem::path& file,
                       const std::optional<GeographicPoint>& origin);

/// ESRI ASCII grid in metres of the world, -9999 for cells without a value.
/// @throws Error with the path.
void write_asc_raster(const PlanRaster& raster, std::span<const float> values, const std::filesystem::path& file);

/// A whole array of a NumPy archive.
template <typename Value>
void add_table(ZipWriter& zip, const std::string& name, const std::string& type, std::span<const Value> values,
               const std::vector<std::uint64_t>& shape) {
  add_array(zip, name, type, shape);
  zip.add(std::as_bytes(values));
  zip.end();
}

/// Adds `x` and `y` of the middles of columns and rows [m], and `origin` [deg], if it is given.
void add_raster_place(ZipWriter& zip, const PlanRaster& raster, const std::optional<GeographicPoint>& origin);

/// Writes all bytes at an offset of a file.
/// @throws Error with the path.
void put_at(UnfinishedFile& out, std::uint64_t offset, std::span<const std::byte> bytes);

}  // namespace insonify
