// load_bag_grid.cpp -- Bathymetric Attributed Grids: HDF5 with the heights in /BAG_root/elevation.
//
// Format Specification Document of the Bathymetric Attributed Grid Object, version 1.6 (2018).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log_line.h"
#include "insonify/error.h"
#include "io/file/hdf5.h"
#include "io/grid/bag_metadata.h"
#include "io/grid/height_grid_file.h"

namespace insonify {
namespace {

constexpr float kNoData = 1e6F;

// Heights are positive upwards, so depths are negative. The first row is the southernmost.
HeightGrid read_elevation(hid_t file, const std::filesystem::path& path) {
  const H5Handle dataset =
      h5_own(H5Dopen2(file, "/BAG_root/elevation", H5P_DEFAULT), H5Dclose, path, "open /BAG_root/elevation");
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path, "size /BAG_root/elevation");
  hsize_t size[2] = {0, 0};
  constexpr hsize_t kMost = 200000;
  if (H5Sget_simple_extent_ndims(space.get()) != 2 || H5Sget_simple_extent_dims(space.get(), size, nullptr) != 2 ||
      std::min(size[0], size[1]) < 2 || std::max(size[0], size[1]) > kMost) {
    throw Error(fmt::format("{}: /BAG_root/elevation must have from 2 to {} rows and columns", path.string(), kMost));
  }

  HeightGrid grid;
  grid.rows = static_cast<int>(size[0]);
  grid.columns = static_cast<int>(size[1]);
  grid.heights.resize(size[0] * size[1]);
  h5_check(H5Dread(dataset.get(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, grid.heights.data()), path,
           "read /BAG_root/elevation");

  const auto row = [&](int index) { return grid.heights.begin() + static_cast<std::ptrdiff_t>(index) * grid.columns; };
  for (int south = 0, north = grid.rows - 1; south < north; ++south, --north) {
    std::swap_ranges(row(south), row(south + 1), row(north));
  }
  for (float& height : grid.heights) {
    if (!std::isfinite(height) || height >= kNoData) {
      height = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return grid;
}

std::string read_metadata(hid_t file, const std::filesystem::path& path) {
  const H5Handle dataset =
      h5_own(H5Dopen2(file, "/BAG_root/metadata", H5P_DEFAULT), H5Dclose, path, "open /BAG_root/metadata");
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path, "size /BAG_root/metadata");
  const H5Handle type = h5_own(H5Dget_type(dataset.get()), H5Tclose, path, "read /BAG_root/metadata");
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0) {
    throw Error(fmt::format("{}: /BAG_root/metadata must be an array of characters", path.string()));
  }
  const hssize_t count = h5_check(H5Sget_simple_extent_npoints(space.get()), path, "size /BAG_root/metadata");
  std::string xml(static_cast<std::size_t>(count) * H5Tget_size(type.get()), '\0');
  h5_check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, xml.data()), path,
           "read /BAG_root/metadata");
  return xml;
}

// Spacing by the corner points: their distance divided by the number of steps between them.
std::optional<double> spacing_by_corners(const BagMetadata& metadata, int axis, int count) {
  if (!metadata.south_west || !metadata.north_east) {
    return std::nullopt;
  }
  const double spacing = ((*metadata.north_east)[axis] - (*metadata.south_west)[axis]) / (count - 1);
  return spacing > 0 ? std::optional(spacing) : std::nullopt;
}

double spacing(std::optional<double> told, std::optional<double> by_corners, std::string_view dimension,
               const std::filesystem::path& path, const Log& log) {
  if (!told && !by_corners) {
    throw Error(fmt::format("{}: its metadata gives no resolution of the {} dimension", path.string(), dimension));
  }
  // Some writers give the corners of the outermost cells, others their middles: a difference of one step.
  constexpr double kDiffer = 1.5;
  if (told && by_corners && std::max(*told / *by_corners, *by_corners / *told) > kDiffer) {
    log_line(log, Severity::kWarning,
             fmt::format("{}: its metadata gives a {} resolution of {:.6g}, but corner points {:.6g} apart; "
                         "the first is used",
                         path.filename().string(), dimension, *told, *by_corners));
  }
  return told ? *told : *by_corners;
}

void warn_of_refinements(hid_t file, const HeightGrid& grid, const std::filesystem::path& path, const Log& log) {
  if (H5Lexists(file, "/BAG_root/varres_refinements", H5P_DEFAULT) > 0) {
    log_line(log, Severity::kWarning,
             fmt::format("{}: a grid of variable resolution; only its base grid of {} x {} points every "
                         "{:.4g} m is read",
                         path.filename().string(), grid.columns, grid.rows, grid.spacing_x));
  }
}

}  // namespace

HeightGrid load_bag_grid(const std::filesystem::path& path, const Log& log) {
  const H5Quiet quiet;
  const H5Handle file = h5_open_to_read(path);

  HeightGrid grid = read_elevation(file.get(), path);
  const BagMetadata metadata = parse_bag_metadata(read_metadata(file.get(), path));
  grid.spacing_x = spacing(metadata.spacing_x, spacing_by_corners(metadata, 0, grid.columns), "column", path, log);
  grid.spacing_y = spacing(metadata.spacing_y, spacing_by_corners(metadata, 1, grid.rows), "row", path, log);
  if (metadata.south_west && metadata.north_east) {
    grid.origin = (*metadata.south_west + *metadata.north_east) / 2;
  }

  if (metadata.is_geographic.value_or(metadata.south_west && looks_geographic(grid))) {
    turn_degrees_into_metres(grid, path, log);
  }
  warn_of_refinements(file.get(), grid, path, log);
  return grid;
}

}  // namespace insonify
