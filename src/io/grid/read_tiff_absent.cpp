// read_tiff_absent.cpp -- stands for read_tiff_gdal.cpp in builds without GDAL.

#include <fmt/format.h>

#include "insonify/error.h"
#include "io/grid/height_grid_file.h"

namespace insonify {

TiffContents read_tiff(const std::filesystem::path& path) {
  throw Error(
      fmt::format("{}: GeoTIFF is read by builds with GDAL, which this one has not: install libgdal-dev and build "
                  "again{}",
                  path.string(), or_convert(path)));
}

}  // namespace insonify
