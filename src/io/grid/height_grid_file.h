// height_grid_file.h -- readers of height grids by format, and conversion of degrees to metres.

#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <tuple>
#include <type_traits>

#include "insonify/log.h"
#include "insonify/mesh.h"

namespace insonify {

/// Whether the file name ends as that of a height grid does.
[[nodiscard]] bool is_height_grid_file(const std::filesystem::path& path);

/// Endings of height grids for messages: ".png, .asc, .bag, .tif, .tiff".
[[nodiscard]] std::string height_grid_file_endings();

/// make_height_field() of a grid that was read.
/// @throws Error for more triangles than Budget allows.
[[nodiscard]] Mesh height_field_of(const HeightGrid& grid);

// One reader a format; see load_height_grid.
[[nodiscard]] HeightGrid load_asc_grid(const std::filesystem::path& path, const Log& log);
[[nodiscard]] HeightGrid load_bag_grid(const std::filesystem::path& path, const Log& log);
[[nodiscard]] HeightGrid load_tiff_grid(const std::filesystem::path& path, const Log& log);

/// What a BAG file holds; the first row is the southernmost.
struct BagContents {
  std::uint64_t rows = 0, columns = 0;
  std::vector<float> heights;    ///< rows x columns, positive upwards [m].
  std::string metadata;          ///< XML, ISO 19139.
  bool has_refinements = false;  ///< Whether it is a grid of variable resolution.
};
template <typename Bag>
requires(std::is_same_v<std::remove_const_t<Bag>, BagContents>) [[nodiscard]] auto members(Bag& bag) {
  return std::tie(bag.rows, bag.columns, bag.heights, bag.metadata, bag.has_refinements);
}
[[nodiscard]] bool fits(const BagContents& bag);

/// Reads it by HDF5.
/// @throws Error with the path.
[[nodiscard]] BagContents read_bag(const std::filesystem::path& path);

/// What a GeoTIFF holds, as GDAL reads it.
struct TiffContents {
  std::uint64_t rows = 0, columns = 0, bands = 0;
  std::vector<float> heights;                       ///< rows x columns of the first band, as stored.
  double scale = 1, offset = 0, height_metres = 1;  ///< Height: (scale stored + offset) height_metres [m].
  bool has_hole = false;
  float hole = 0;          ///< Stored value that means no data.
  bool has_place = false;  ///< Whether world_from_pixel is known.
  std::array<double, 6> world_from_pixel = {0, 1, 0,
                                            0, 0, 1};  ///< x = [0] + [1] column + [2] row, y likewise; (0, 0) is
                                                       ///< a corner of the first pixel.
  bool is_geographic = false, is_projected = false;    ///< Both false where the file does not say.
  double metres = 1;                                   ///< Unit of x and y, where projected [m].
};
template <typename Tiff>
requires(std::is_same_v<std::remove_const_t<Tiff>, TiffContents>) [[nodiscard]] auto members(Tiff& tiff) {
  return std::tie(tiff.rows, tiff.columns, tiff.bands, tiff.heights, tiff.scale, tiff.offset, tiff.height_metres,
                  tiff.has_hole, tiff.hole, tiff.has_place, tiff.world_from_pixel, tiff.is_geographic,
                  tiff.is_projected, tiff.metres);
}
[[nodiscard]] bool fits(const TiffContents& tiff);

/// Reads it by GDAL.
/// @throws Error with the path; in builds without GDAL always.
[[nodiscard]] TiffContents read_tiff(const std::filesystem::path& path);

/// The end of a message about a GeoTIFF that cannot be read: ", or convert it: gdal_translate ...".
[[nodiscard]] std::string or_convert(const std::filesystem::path& path);

/// Length of one degree on the WGS 84 ellipsoid.
struct DegreeLength {
  double east = 0;   ///< One degree of longitude [m].
  double north = 0;  ///< One degree of latitude [m].
};
[[nodiscard]] DegreeLength degree_length(double latitude_deg);

/// Whether numbers without a unit are degrees: the grid lies within the ranges of longitude and latitude, its
/// spacing is at most a tenth of a degree (11 km), and the point (0, 0), where a tank or a test would start counting,
/// is not in it. `spacing_x`, `spacing_y` and `origin` as in the file.
[[nodiscard]] bool looks_geographic(const HeightGrid& grid);

/// Converts the spacing from degrees to metres at the latitude of the grid's middle, and writes that to the log. The
/// origin is not changed.
/// @throws Error if that latitude is not within -90 to 90 degrees.
void turn_degrees_into_metres(HeightGrid& grid, const std::filesystem::path& path, const Log& log);

}  // namespace insonify
