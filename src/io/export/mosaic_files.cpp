// mosaic_files.cpp -- mosaics as NumPy archives, GeoTIFF and ASCII grids.

#include "insonify/mosaic_files.h"

#include <fmt/format.h>

#include "insonify/error.h"
#include "io/export/raster_files.h"

namespace insonify {
namespace {

PlanRaster raster_of(const Mosaic& mosaic) {
  return {mosaic.west, mosaic.north, mosaic.cell, mosaic.columns, mosaic.rows};
}

void write_npz(const Mosaic& mosaic, const std::filesystem::path& file, const std::optional<GeographicPoint>& origin,
               const std::vector<std::string>& names) {
  UnfinishedFile out(file, "cannot write");
  ZipWriter zip(out, true);
  const std::vector<std::uint64_t> shape{static_cast<std::uint64_t>(mosaic.rows),
                                         static_cast<std::uint64_t>(mosaic.columns)};
  add_table<float>(zip, "intensity", "<f4", mosaic.intensity, shape);
  add_table<float>(zip, "angle", "<f4", mosaic.angle, shape);
  add_table<std::uint16_t>(zip, "line", "<u2", mosaic.line, shape);
  if (!mosaic.instance.empty()) {
    add_table<std::uint16_t>(zip, "instance", "<u2", mosaic.instance, shape);
    add_texts(zip, "instance_names", names, false);
  }
  add_raster_place(zip, raster_of(mosaic), origin);
  zip.finish();
  out.put_in_place();
}

}  // namespace

void write_mosaic(const Mosaic& mosaic, const std::filesystem::path& file, const std::optional<GeographicPoint>& origin,
                  const std::vector<std::string>& instance_names) {
  if (origin) {
    check_origin(*origin);
  }
  const std::string ending = file.extension().string();
  if (ending == ".npz") {
    write_npz(mosaic, file, origin, instance_names);
  } else if (ending == ".tif") {
    write_tiff_raster(raster_of(mosaic), mosaic.intensity, file, origin);
  } else if (ending == ".asc") {
    write_asc_raster(raster_of(mosaic), mosaic.intensity, file);
  } else {
    throw Error(fmt::format("{}: a mosaic is written as {}", file.string(), kMosaicEndings));
  }
}

std::string world_file_text(const Mosaic& mosaic, const std::optional<GeographicPoint>& origin) {
  const RasterPlacement place = placement_of(raster_of(mosaic), origin);
  return fmt::format("{:.12g}\n0\n0\n{:.12g}\n{:.12g}\n{:.12g}\n", place.cell_x, -place.cell_y,
                     place.west + place.cell_x / 2, place.north - place.cell_y / 2);
}

}  // namespace insonify
