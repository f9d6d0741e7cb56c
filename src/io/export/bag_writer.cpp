// bag_writer.cpp -- the datasets of a BAG: HDF5 that is made in memory and written as a whole.
//
// Format Specification Document of the Bathymetric Attributed Grid Object, version 1.6 (2018).

#include "io/export/bag_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "insonify/error.h"
#include "io/export/bag_metadata.h"
#include "io/export/navigation.h"
#include "io/file/hdf5.h"

namespace insonify {
namespace {

constexpr float kNoBagValue = 1e6F;
constexpr const char* kBagVersion = "1.6.3";

// An entry of the list of changes by hand: there are none, but readers expect the list.
struct BagTrackingItem {
  std::uint32_t row, column;
  float depth, uncertainty;
  std::uint8_t track_code;
  std::uint16_t list_series;
};

class BagFile {
 public:
  explicit BagFile(const std::filesystem::path& path) : path_(path) {
    constexpr std::size_t kStep = std::size_t{1} << 20U;  // By which memory grows [bytes].
    const H5Handle access = own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    check(H5Pset_fapl_core(access.get(), kStep, 0));
    file_ = own(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
    const H5Handle root = own(H5Gcreate2(file_.get(), "/BAG_root", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    const H5Handle text = own(H5Tcopy(H5T_C_S1), H5Tclose);
    check(H5Tset_size(text.get(), kVersionSize));
    std::array<char, kVersionSize> version{};
    std::ranges::copy(std::string_view(kBagVersion), version.begin());
    put_attribute(root.get(), "Bag Version", text.get(), version.data());
  }

  void put_metadata(const std::string& xml) {
    const H5Handle text = own(H5Tcopy(H5T_C_S1), H5Tclose);
    const H5Handle data = dataset("/BAG_root/metadata", text.get(), {xml.size()}, {1024}, true);
    check(H5Dwrite(data.get(), text.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, xml.data()));
  }

  // A layer of values, which become south-up. `what`: "Elevation".
  void put_layer(const char* name, const std::string& what, const SoundingGrid& grid,
                 const std::vector<float>& values) {
    const auto rows = static_cast<std::size_t>(grid.rows), columns = static_cast<std::size_t>(grid.columns);
    std::vector<float> layer(values.size());
    float least = kNoBagValue, most = -kNoBagValue;
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const float value = values[(rows - 1 - row) * columns + column];
        layer[row * columns + column] = std::isnan(value) ? kNoBagValue : value;
        least = std::isnan(value) ? least : std::min(least, value);
        most = std::isnan(value) ? most : std::max(most, value);
      }
    }
    const std::vector<hsize_t> chunk{std::min<hsize_t>(rows, 100), std::min<hsize_t>(columns, 100)};
    const H5Handle data = dataset(name, H5T_IEEE_F32LE, {rows, columns}, chunk, false);
    check(H5Dwrite(data.get(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, layer.data()));
    put_attribute(data.get(), fmt::format("Minimum {} Value", what).c_str(), H5T_IEEE_F32LE, &least);
    put_attribute(data.get(), fmt::format("Maximum {} Value", what).c_str(), H5T_IEEE_F32LE, &most);
  }

  void put_empty_tracking_list() {
    const H5Handle type = own(H5Tcreate(H5T_COMPOUND, sizeof(BagTrackingItem)), H5Tclose);
    check(H5Tinsert(type.get(), "row", HOFFSET(BagTrackingItem, row), H5T_NATIVE_UINT32));
    check(H5Tinsert(type.get(), "col", HOFFSET(BagTrackingItem, column), H5T_NATIVE_UINT32));
    check(H5Tinsert(type.get(), "depth", HOFFSET(BagTrackingItem, depth), H5T_NATIVE_FLOAT));
    check(H5Tinsert(type.get(), "uncertainty", HOFFSET(BagTrackingItem, uncertainty), H5T_NATIVE_FLOAT));
    check(H5Tinsert(type.get(), "track_code", HOFFSET(BagTrackingItem, track_code), H5T_NATIVE_UINT8));
    check(H5Tinsert(type.get(), "list_series", HOFFSET(BagTrackingItem, list_series), H5T_NATIVE_UINT16));
    const H5Handle data = dataset("/BAG_root/tracking_list", type.get(), {0}, {10}, true);
    const std::uint32_t length = 0;
    put_attribute(data.get(), "Tracking List Length", H5T_STD_U32LE, &length);
  }

  // The bytes of the whole file.
  [[nodiscard]] std::vector<std::byte> image() const {
    check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL));
    const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
    check(size);
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    check(H5Fget_file_image(file_.get(), bytes.data(), bytes.size()));
    return bytes;
  }

 private:
  static constexpr std::size_t kVersionSize = 32;

  template <typename Result>
  Result check(Result result) const {
    return h5_check(result, path_, "write");
  }
  [[nodiscard]] H5Handle own(hid_t id, H5Handle::Close close) const { return h5_own(id, close, path_, "write"); }

  [[nodiscard]] H5Handle dataset(const char* name, hid_t type, const std::vector<hsize_t>& size,
                                 const std::vector<hsize_t>& chunk, bool grows) const {
    const std::vector<hsize_t> most(size.size(), H5S_UNLIMITED);
    const int axes = static_cast<int>(size.size());
    const H5Handle space = own(H5Screate_simple(axes, size.data(), grows ? most.data() : nullptr), H5Sclose);
    const H5Handle how = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    check(H5Pset_chunk(how.get(), axes, chunk.data()));
    check(H5Pset_obj_track_times(how.get(), false));
    if (!grows) {
      check(H5Pset_deflate(how.get(), 6));
      check(H5Pset_fill_value(how.get(), H5T_NATIVE_FLOAT, &kNoBagValue));
    }
    return own(H5Dcreate2(file_.get(), name, type, space.get(), H5P_DEFAULT, how.get(), H5P_DEFAULT), H5Dclose);
  }

  void put_attribute(hid_t to, const char* name, hid_t type, const void* value) const {
    const H5Handle space = own(H5Screate(H5S_SCALAR), H5Sclose);
    const H5Handle attribute = own(H5Acreate2(to, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(H5Awrite(attribute.get(), type, value));
  }

  std::filesystem::path path_;
  H5Handle file_;
};

// Today in UTC.
std::string today_text() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  const ClockTime now = clock_time(static_cast<std::uint64_t>(std::chrono::nanoseconds(since).count()));
  return fmt::format("{:04}-{:02}-{:02}", now.year, now.month, now.day);
}

BagFacts bag_facts(const SoundingGrid& grid, const SoundingGridFileOptions& options) {
  return {
      .raster = {grid.west, grid.north, grid.cell, grid.columns, grid.rows},
      .origin = options.origin,
      .title = options.title.empty() ? "grid of soundings" : options.title,
      .abstract = fmt::format("{} simulated soundings in cells of {:.6g} m. The uncertainty is one standard "
                              "deviation of a cell's height, by the soundings' own uncertainties and their scatter.",
                              grid.given, grid.cell),
      .process = fmt::format("insonify grid: {} of the soundings in each cell; {} left out, {} refused as outliers, "
                             "{} cells filled",
                             word_of(grid.method), grid.left_out, grid.refused, grid.filled),
      .datum = options.datum,
      .date = today_text()};
}

}  // namespace

void write_bag_grid(const SoundingGrid& grid, const std::filesystem::path& file,
                    const SoundingGridFileOptions& options) {
  if (std::min(grid.columns, grid.rows) < 2) {
    throw Error(fmt::format("{}: a grid of {} x {} cells is too small for a BAG, which has at least 2 x 2",
                            file.string(), grid.columns, grid.rows));
  }
  std::vector<float> heights = grid.height;
  for (float& height : heights) {
    height = static_cast<float>(static_cast<double>(height) - options.datum);
  }
  UnfinishedFile out(file, "cannot write");
  const H5Quiet quiet;
  BagFile bag(file);
  bag.put_metadata(bag_metadata(bag_facts(grid, options)));
  bag.put_layer("/BAG_root/elevation", "Elevation", grid, heights);
  bag.put_layer("/BAG_root/uncertainty", "Uncertainty", grid, grid.uncertainty);
  bag.put_empty_tracking_list();
  put_at(out, 0, bag.image());
  out.put_in_place();
}

}  // namespace insonify
