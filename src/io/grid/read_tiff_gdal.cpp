// read_tiff_gdal.cpp -- reads GeoTIFF by GDAL, whose library is opened at the first file: it takes as long to load as
// all others together.

#include <cpl_conv.h>
#include <cpl_error.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <memory>

#include "insonify/error.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/grid/height_grid_file.h"

namespace insonify {
namespace {

constexpr int kMost = 200'000;  // Rows and columns.

// GDAL's functions by name.
class Gdal {
 public:
  explicit Gdal(const std::filesystem::path& path) : library_(dlopen(INSONIFY_GDAL_LIBRARY, RTLD_NOW)) {
    if (library_ == nullptr) {
      throw Error(fmt::format("{}: GeoTIFF is read by GDAL, whose library {} is not installed{}", path.string(),
                              INSONIFY_GDAL_LIBRARY, or_convert(path)));
    }
  }

  template <typename Function>
  Function* get(const char* name) const {
    auto* const function = reinterpret_cast<Function*>(dlsym(library_, name));
    if (function == nullptr) {
      throw Error(fmt::format("{} has no function {}", INSONIFY_GDAL_LIBRARY, name));
    }
    return function;
  }

 private:
  void* library_;  // Stays open: it cannot be unloaded safely.
};

// A call that the compiler checks against GDAL's headers.
#define INSONIFY_GDAL_CALL(gdal, name) (gdal).get<decltype(name)>(#name)

using Dataset = std::unique_ptr<void, decltype(&GDALClose)>;

Dataset open(const Gdal& gdal, const std::filesystem::path& path) {
  INSONIFY_GDAL_CALL(gdal, CPLSetConfigOption)("GDAL_CACHEMAX", "64");
  INSONIFY_GDAL_CALL(gdal, CPLSetErrorHandler)
  (gdal.get<void(CPLErr, CPLErrorNum, const char*)>("CPLQuietErrorHandler"));
  gdal.get<void()>("GDALRegister_GTiff")();  // No other format, and no plugins.
  const char* const formats[] = {"GTiff", nullptr};
  const std::string whole = std::filesystem::absolute(path).string();
  GDALDatasetH const dataset =
      INSONIFY_GDAL_CALL(gdal, GDALOpenEx)(whole.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, formats, nullptr, nullptr);
  if (dataset == nullptr) {
    throw Error(fmt::format("{}: is not a TIFF file that GDAL reads: {}", path.string(),
                            foreign_reason(INSONIFY_GDAL_CALL(gdal, CPLGetLastErrorMsg)())));
  }
  return {dataset, INSONIFY_GDAL_CALL(gdal, GDALClose)};
}

// Metres in a unit of height by its name; 1 for names that are not known.
double metres_of(std::string_view unit) {
  constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937;
  if (unit == "ft" || unit == "foot" || unit == "feet") {
    return kFoot;
  }
  return unit == "us-ft" || unit == "US survey foot" || unit == "sfoot" ? kSurveyFoot : 1;
}

void read_reference(const Gdal& gdal, GDALDatasetH dataset, TiffContents& tiff) {
  OGRSpatialReferenceH const reference = INSONIFY_GDAL_CALL(gdal, GDALGetSpatialRef)(dataset);
  if (reference != nullptr) {
    tiff.is_geographic = INSONIFY_GDAL_CALL(gdal, OSRIsGeographic)(reference) != 0;
    tiff.is_projected = INSONIFY_GDAL_CALL(gdal, OSRIsProjected)(reference) != 0;
    if (tiff.is_projected) {
      tiff.metres = INSONIFY_GDAL_CALL(gdal, OSRGetLinearUnits)(reference, nullptr);
    }
  }
  tiff.has_place = INSONIFY_GDAL_CALL(gdal, GDALGetGeoTransform)(dataset, tiff.world_from_pixel.data()) == CE_None;
}

}  // namespace

TiffContents read_tiff(const std::filesystem::path& path) {
  const Gdal gdal(path);
  const Dataset dataset = open(gdal, path);
  TiffContents tiff;
  const int columns = INSONIFY_GDAL_CALL(gdal, GDALGetRasterXSize)(dataset.get());
  const int rows = INSONIFY_GDAL_CALL(gdal, GDALGetRasterYSize)(dataset.get());
  tiff.bands = static_cast<std::uint64_t>(INSONIFY_GDAL_CALL(gdal, GDALGetRasterCount)(dataset.get()));
  if (tiff.bands == 0 || std::min(rows, columns) < 2 || std::max(rows, columns) > kMost) {
    throw Error(fmt::format("{}: {} x {} pixels; heights need from 2 x 2 to {} x {}", path.string(), columns, rows,
                            kMost, kMost));
  }
  check_budget(Budget::kPixels, static_cast<double>(rows) * columns, path.string());
  GDALRasterBandH const band = INSONIFY_GDAL_CALL(gdal, GDALGetRasterBand)(dataset.get(), 1);
  if (INSONIFY_GDAL_CALL(gdal, GDALDataTypeIsComplex)(INSONIFY_GDAL_CALL(gdal, GDALGetRasterDataType)(band)) != 0) {
    throw Error(path.string() + ": its values are complex, heights must be real");
  }
  read_reference(gdal, dataset.get(), tiff);
  int has_hole = 0;
  const double hole = INSONIFY_GDAL_CALL(gdal, GDALGetRasterNoDataValue)(band, &has_hole);
  tiff.has_hole = has_hole != 0;
  tiff.hole = static_cast<float>(hole);
  tiff.scale = INSONIFY_GDAL_CALL(gdal, GDALGetRasterScale)(band, nullptr);
  tiff.offset = INSONIFY_GDAL_CALL(gdal, GDALGetRasterOffset)(band, nullptr);
  tiff.height_metres = metres_of(INSONIFY_GDAL_CALL(gdal, GDALGetRasterUnitType)(band));
  tiff.rows = static_cast<std::uint64_t>(rows);
  tiff.columns = static_cast<std::uint64_t>(columns);
  tiff.heights.resize(tiff.rows * tiff.columns);
  if (INSONIFY_GDAL_CALL(gdal, GDALRasterIO)(band, GF_Read, 0, 0, columns, rows, tiff.heights.data(), columns, rows,
                                             GDT_Float32, 0, 0) != CE_None) {
    throw Error(fmt::format("{}: cannot be read: {}", path.string(),
                            foreign_reason(INSONIFY_GDAL_CALL(gdal, CPLGetLastErrorMsg)())));
  }
  return tiff;
}

}  // namespace insonify
