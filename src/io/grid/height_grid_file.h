// height_grid_file.h -- readers of height grids by format, and conversion of degrees to metres.

#pragma once

#include <filesystem>
#include <string>

#include "insonify/log.h"
#include "insonify/mesh.h"

namespace insonify {

/// Whether the file name ends as that of a height grid does.
[[nodiscard]] bool is_height_grid_file(const std::filesystem::path& path);

/// Endings of height grids for messages: ".png, .asc, .bag".
[[nodiscard]] std::string height_grid_file_endings();

// One reader a format; see load_height_grid.
[[nodiscard]] HeightGrid load_png_grid(const std::filesystem::path& path);
[[nodiscard]] HeightGrid load_asc_grid(const std::filesystem::path& path, const Log& log);
[[nodiscard]] HeightGrid load_bag_grid(const std::filesystem::path& path, const Log& log);

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
