// load_tiff_grid.cpp -- GeoTIFF: places, units and holes of the grid, whose heights GDAL reads.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log_line.h"
#include "insonify/error.h"
#include "io/file/reader_process.h"
#include "io/grid/height_grid_file.h"

namespace insonify {
namespace {

// Values of the file as heights in metres; holes are not a number.
std::vector<float> heights_of(TiffContents& tiff) {
  const double scale = tiff.scale * tiff.height_metres, offset = tiff.offset * tiff.height_metres;
  for (float& height : tiff.heights) {
    const bool is_hole = !std::isfinite(height) || (tiff.has_hole && height == tiff.hole);
    height = is_hole ? std::numeric_limits<float>::quiet_NaN()
                     : static_cast<float>(scale * static_cast<double>(height) + offset);
  }
  return std::move(tiff.heights);
}

// Makes the first row the northernmost, and the first column the westernmost.
void turn_north(const TiffContents& tiff, HeightGrid& grid) {
  const auto row = [&](int index) { return grid.heights.begin() + static_cast<std::ptrdiff_t>(index) * grid.columns; };
  if (tiff.world_from_pixel[5] > 0) {
    for (int south = 0, north = grid.rows - 1; south < north; ++south, --north) {
      std::swap_ranges(row(south), row(south + 1), row(north));
    }
  }
  if (tiff.world_from_pixel[1] < 0) {
    for (int index = 0; index < grid.rows; ++index) {
      std::reverse(row(index), row(index + 1));
    }
  }
}

}  // namespace

bool fits(const TiffContents& tiff) {
  return std::min(tiff.rows, tiff.columns) >= 2 && tiff.heights.size() / tiff.rows == tiff.columns &&
         tiff.heights.size() % tiff.rows == 0;
}

std::string or_convert(const std::filesystem::path& path) {
  return fmt::format(", or convert it: gdal_translate -of AAIGrid {} {}.asc", path.filename().string(),
                     path.stem().string());
}

HeightGrid load_tiff_grid(const std::filesystem::path& path, const Log& log) {
  TiffContents tiff =
      reads_here() ? read_tiff(path) : read_apart<TiffContents>({path, "TIFF"}, ReaderTask::kTiff, path.string());
  const std::array<double, 6>& affine = tiff.world_from_pixel;
  HeightGrid grid;
  grid.rows = static_cast<int>(tiff.rows);
  grid.columns = static_cast<int>(tiff.columns);
  grid.heights = heights_of(tiff);
  const std::string file = path.filename().string();
  if (tiff.bands > 1) {
    log_line(log, Severity::kWarning,
             fmt::format("{}: has {} bands; heights are those of the first", file, tiff.bands));
  }
  if (!tiff.has_place) {
    log_line(log, Severity::kWarning, file + ": says neither where it is nor its spacing: 1 m is taken");
    return grid;
  }
  if (affine[2] != 0 || affine[4] != 0 || affine[1] == 0 || affine[5] == 0) {
    throw Error(fmt::format("{}: its rows do not run from west to east; turn it: gdalwarp {} {}-north.tif",
                            path.string(), file, path.stem().string()));
  }
  turn_north(tiff, grid);
  // GDAL gives the outer corner of the first pixel, also where the file gives its middle.
  grid.spacing_x = std::abs(affine[1]) * tiff.metres;
  grid.spacing_y = std::abs(affine[5]) * tiff.metres;
  grid.origin.x() = (affine[0] + grid.columns * affine[1] / 2) * tiff.metres;
  grid.origin.y() = (affine[3] + grid.rows * affine[5] / 2) * tiff.metres;
  if (tiff.is_geographic || (!tiff.is_projected && looks_geographic(grid))) {
    turn_degrees_into_metres(grid, path, log);
  }
  return grid;
}

}  // namespace insonify
