// raster_files.cpp -- tags of GeoTIFF, texts of ASCII grids, axes of arrays.

#include "io/export/raster_files.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "insonify/error.h"

namespace insonify {
namespace {

// A little-endian TIFF of one strip: header, directory, the values that do not fit into it, the cells.
class TiffDirectory {
 public:
  template <typename Value>
  void add(std::uint16_t tag, std::uint16_t type, std::span<const Value> values) {
    entries_.push_back({tag,
                        type,
                        static_cast<std::uint32_t>(values.size()),
                        {reinterpret_cast<const char*>(values.data()), values.size_bytes()}});
  }
  void add_long(std::uint16_t tag, std::uint32_t value) { add<std::uint32_t>(tag, 4, std::array{value}); }
  void add_short(std::uint16_t tag, std::uint16_t value) { add<std::uint16_t>(tag, 3, std::array{value}); }

  // Bytes before the cells; where they begin goes into kOffsets.
  [[nodiscard]] std::string bytes() {
    const auto directory = static_cast<std::uint32_t>(8 + 2 + 12 * entries_.size() + 4);
    std::uint32_t beyond = directory;
    for (const Entry& entry : entries_) {
      beyond += entry.bytes.size() > 4 ? static_cast<std::uint32_t>(entry.bytes.size() + entry.bytes.size() % 2) : 0;
    }
    std::string head = "II*", tail;
    head += '\0';
    append(head, std::uint32_t{8});
    append(head, static_cast<std::uint16_t>(entries_.size()));
    for (Entry& entry : entries_) {
      if (entry.tag == kOffsets) {
        entry.bytes.assign(reinterpret_cast<const char*>(&beyond), sizeof beyond);
      }
      append(head, entry.tag);
      append(head, entry.type);
      append(head, entry.count);
      if (entry.bytes.size() > 4) {
        append(head, static_cast<std::uint32_t>(directory + tail.size()));
        tail += entry.bytes;
        tail.resize(tail.size() + tail.size() % 2);
      } else {
        head += entry.bytes;
        head.resize(head.size() + 4 - entry.bytes.size());
      }
    }
    append(head, std::uint32_t{0});
    return head + tail;
  }

  static constexpr std::uint16_t kOffsets = 273;

 private:
  struct Entry {
    std::uint16_t tag = 0, type = 0;
    std::uint32_t count = 0;
    std::string bytes = {};
  };
  template <typename Value>
  static void append(std::string& to, Value value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::vector<Entry> entries_;
};

}  // namespace

RasterPlacement placement_of(const PlanRaster& raster, const std::optional<GeographicPoint>& origin) {
  if (!origin) {
    return {raster.cell, raster.cell, raster.west, raster.north};
  }
  const LocalGrid grid(*origin);
  const GeographicPoint upper = grid.geographic({raster.west, raster.north, 0});
  const GeographicPoint lower =
      grid.geographic({raster.west + raster.columns * raster.cell, raster.north - raster.rows * raster.cell, 0});
  return {std::remainder(lower.longitude - upper.longitude, 360) / raster.columns,
          (upper.latitude - lower.latitude) / raster.rows, upper.longitude, upper.latitude};
}

// GeoTIFF 1.1 (OGC 19-008r4): ModelPixelScale, ModelTiepoint and GeoKeyDirectory; GDAL's tag for cells without a value.
void write_tiff_raster(const PlanRaster& raster, std::span<const float> values, const std::filesystem::path& file,
                       const std::optional<GeographicPoint>& origin) {
  const std::size_t size = values.size_bytes();
  if (size > std::numeric_limits<std::uint32_t>::max() - 4096) {
    throw Error(fmt::format("{}: {} bytes of cells are more than a TIFF holds", file.string(), size));
  }
  constexpr std::uint16_t kDouble = 12, kText = 2, kShort = 3, kUserDefined = 32767;
  const RasterPlacement place = placement_of(raster, origin);
  TiffDirectory tiff;
  tiff.add_long(256, static_cast<std::uint32_t>(raster.columns));
  tiff.add_long(257, static_cast<std::uint32_t>(raster.rows));
  tiff.add_short(258, 32);
  tiff.add_short(259, 1);  // Not compressed.
  tiff.add_short(262, 1);  // Black is 0.
  tiff.add_long(TiffDirectory::kOffsets, 0);
  tiff.add_short(277, 1);
  tiff.add_long(278, static_cast<std::uint32_t>(raster.rows));
  tiff.add_long(279, static_cast<std::uint32_t>(size));
  tiff.add_short(339, 3);  // Floating-point.
  tiff.add<double>(33550, kDouble, std::array{place.cell_x, place.cell_y, 0.0});
  tiff.add<double>(33922, kDouble, std::array{0.0, 0.0, 0.0, place.west, place.north, 0.0});
  using Keys = std::array<std::uint16_t, 20>;
  const Keys degrees{1, 1, 0, 4, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326, 2054, 0, 1, 9102};
  const Keys metres{1, 1, 0, 4, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, kUserDefined, 3076, 0, 1, 9001};
  tiff.add<std::uint16_t>(34735, kShort, origin ? degrees : metres);
  tiff.add<char>(42113, kText, std::array{'n', 'a', 'n', '\0'});
  UnfinishedFile out(file, "cannot write");
  const std::string head = tiff.bytes();
  put_at(out, 0, std::as_bytes(std::span(head)));
  put_at(out, head.size(), std::as_bytes(values));
  out.put_in_place();
}

void write_asc_raster(const PlanRaster& raster, std::span<const float> values, const std::filesystem::path& file) {
  constexpr int kNothing = -9999;
  std::string text = fmt::format(
      "ncols {}\nnrows {}\nxllcorner {:.9g}\nyllcorner {:.9g}\ncellsize {:.9g}\nNODATA_value {}\n", raster.columns,
      raster.rows, raster.west, raster.north - raster.rows * raster.cell, raster.cell, kNothing);
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column) {
      const float value = values[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster.columns) +
                                 static_cast<std::size_t>(column)];
      text += std::isnan(value) ? fmt::format("{} ", kNothing) : fmt::format("{:.6g} ", value);
    }
    text.back() = '\n';
  }
  UnfinishedFile out(file, "cannot write");
  put_at(out, 0, std::as_bytes(std::span(text)));
  out.put_in_place();
}

void add_raster_place(ZipWriter& zip, const PlanRaster& raster, const std::optional<GeographicPoint>& origin) {
  std::vector<double> x, y;
  for (int column = 0; column < raster.columns; ++column) {
    x.push_back(raster.west + (column + 0.5) * raster.cell);
  }
  for (int row = 0; row < raster.rows; ++row) {
    y.push_back(raster.north - (row + 0.5) * raster.cell);
  }
  add_table<double>(zip, "x", "<f8", x, {x.size()});
  add_table<double>(zip, "y", "<f8", y, {y.size()});
  if (origin) {
    const std::array<double, 2> place{origin->latitude, origin->longitude};
    add_table<double>(zip, "origin", "<f8", place, {place.size()});
  }
}

void put_at(UnfinishedFile& out, std::uint64_t offset, std::span<const std::byte> bytes) {
  if (!write_at(out.descriptor(), offset, bytes)) {
    out.fail_by_errno();
  }
}

}  // namespace insonify
