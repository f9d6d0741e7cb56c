// sounding_grid_files.cpp -- grids of soundings as GeoTIFF, ASCII grids and NumPy archives, or as BAG.

#include "insonify/sounding_grid_files.h"

#include <fmt/format.h>

#include "insonify/error.h"
#include "io/export/bag_writer.h"
#include "io/export/raster_files.h"

namespace insonify {
namespace {

std::vector<float> above_datum(const std::vector<float>& heights, double datum) {
  std::vector<float> above;
  above.reserve(heights.size());
  for (const float height : heights) {
    above.push_back(static_cast<float>(static_cast<double>(height) - datum));
  }
  return above;
}

void write_grid_npz(const SoundingGrid& grid, const PlanRaster& raster, const std::filesystem::path& file,
                    const SoundingGridFileOptions& options) {
  UnfinishedFile out(file, "cannot write");
  ZipWriter zip(out, true);
  const std::vector<std::uint64_t> shape{static_cast<std::uint64_t>(grid.rows),
                                         static_cast<std::uint64_t>(grid.columns)};
  add_table<float>(zip, "height", "<f4", above_datum(grid.height, options.datum), shape);
  add_table<float>(zip, "uncertainty", "<f4", grid.uncertainty, shape);
  add_table<std::uint32_t>(zip, "count", "<u4", grid.count, shape);
  if (!grid.truth.empty()) {
    add_table<float>(zip, "truth", "<f4", above_datum(grid.truth, options.datum), shape);
  }
  add_raster_place(zip, raster, options.origin);
  add_table<double>(zip, "datum", "<f8", std::span(&options.datum, 1), {});
  zip.finish();
  out.put_in_place();
}

}  // namespace

void write_sounding_grid(const SoundingGrid& grid, const std::filesystem::path& file,
                         const SoundingGridFileOptions& options) {
  if (options.origin) {
    check_origin(*options.origin);
  }
  const PlanRaster raster{grid.west, grid.north, grid.cell, grid.columns, grid.rows};
  const std::string ending = file.extension().string();
  if (ending == ".bag") {
    write_bag_grid(grid, file, options);
  } else if (ending == ".tif") {
    write_tiff_raster(raster, above_datum(grid.height, options.datum), file, options.origin);
  } else if (ending == ".asc") {
    write_asc_raster(raster, above_datum(grid.height, options.datum), file);
  } else if (ending == ".npz") {
    write_grid_npz(grid, raster, file, options);
  } else {
    throw Error(fmt::format("{}: a grid of soundings is written as {}", file.string(), kSoundingGridEndings));
  }
}

}  // namespace insonify
