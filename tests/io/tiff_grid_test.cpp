// tiff_grid_test.cpp -- heights of GeoTIFF files that are written here byte by byte, after TIFF 6.0 and GeoTIFF 1.1.

#include <gmock/gmock.h>

#include <cstring>
#include <map>

#include "insonify/mesh.h"
#include "io/grid/height_grid_file.h"
#include "io/loaded_grid.h"
#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify::tiff_grid_test {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsNan;

enum Type : std::uint16_t { kAscii = 2, kShort = 3, kLong = 4, kDouble = 12 };

template <typename Value>
std::string bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

// A little-endian file of one image.
class Tiff {
 public:
  Tiff(std::uint32_t width, std::uint32_t height, std::uint16_t bits, std::uint16_t sample_format) {
    longs(256, {width});
    longs(257, {height});
    shorts(258, {bits});
    shorts(259, {1});  // No compression.
    shorts(262, {1});
    shorts(277, {1});
    longs(278, {height});
    shorts(339, {sample_format});
  }

  // Heights of 32 bits, in one strip.
  static Tiff of(std::uint32_t width, const std::vector<float>& heights) {
    Tiff tiff(width, static_cast<std::uint32_t>(heights.size()) / width, 32, 3);
    tiff.strips = {bytes_of(heights)};
    return tiff;
  }

  Tiff& shorts(std::uint16_t tag, const std::vector<std::uint16_t>& values) {
    return put(tag, kShort, values.size(), bytes_of(values));
  }
  Tiff& longs(std::uint16_t tag, const std::vector<std::uint32_t>& values) {
    return put(tag, kLong, values.size(), bytes_of(values));
  }
  Tiff& doubles(std::uint16_t tag, const std::vector<double>& values) {
    return put(tag, kDouble, values.size(), bytes_of(values));
  }
  Tiff& text(std::uint16_t tag, const std::string& value) { return put(tag, kAscii, value.size() + 1, value + '\0'); }

  // The first pixel is at (x, y).
  Tiff& at(double x, double y, double step_x, double step_y) {
    doubles(33550, {step_x, step_y, 0});
    return doubles(33922, {0, 0, 0, x, y, 0});
  }
  // Keys in rising order: 1024 model (1 projected, 2 geographic), 1025 raster (1 area, 2 point), codes of EPSG.
  Tiff& keys(const std::map<std::uint16_t, std::uint16_t>& values) {
    std::vector<std::uint16_t> directory = {1, 1, 0, static_cast<std::uint16_t>(values.size())};
    for (const auto& [key, value] : values) {
      directory.insert(directory.end(), {key, 0, 1, value});
    }
    return shorts(34735, directory);
  }

  [[nodiscard]] std::string text() const {
    const bool tiled = entries_.contains(322);
    Tiff whole = *this;
    std::vector<std::uint32_t> offsets, counts;
    std::string data;
    for (const std::string& strip : strips) {
      offsets.push_back(static_cast<std::uint32_t>(8 + data.size()));
      counts.push_back(static_cast<std::uint32_t>(strip.size()));
      data += strip + (strip.size() % 2 == 0 ? "" : std::string(1, '\0'));
    }
    whole.longs(tiled ? 324 : 273, offsets);
    whole.longs(tiled ? 325 : 279, counts);
    std::string directory = bytes_of(std::vector{static_cast<std::uint16_t>(whole.entries_.size())}), beyond;
    const std::size_t start = 8 + data.size();
    const std::size_t free = start + 2 + 12 * whole.entries_.size() + 4;
    for (const auto& [tag, entry] : whole.entries_) {
      directory += bytes_of(std::vector<std::uint16_t>{tag, entry.type});
      directory += bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(entry.count)});
      std::string value = entry.bytes;
      if (value.size() > 4) {
        value = bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(free + beyond.size())});
        beyond += entry.bytes + (entry.bytes.size() % 2 == 0 ? "" : std::string(1, '\0'));
      }
      value.resize(4, '\0');
      directory += value;
    }
    return "II*" + std::string(1, '\0') + bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(start)}) +
           data + directory + std::string(4, '\0') + beyond;
  }

  std::vector<std::string> strips;

 private:
  struct Entry {
    Type type;
    std::size_t count;
    std::string bytes;
  };
  Tiff& put(std::uint16_t tag, Type type, std::size_t count, const std::string& bytes) {
    entries_[tag] = {type, count, bytes};
    return *this;
  }
  std::map<std::uint16_t, Entry> entries_;
};

constexpr std::uint16_t kArea = 1, kPoint = 2, kUtm32 = 32632, kWgs84 = 4326, kNewYorkInFeet = 2263;
const std::vector<float> kHeights = {-10, -11, -12, -20, -21, -22};  // Two rows, the northern one first.

class TiffGridTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string path = folder_.write("seabed.tif", "x");
    const std::string message = message_of([&] { (void)load_height_grid(path); });
    if (message.find("builds with GDAL") != std::string::npos) {
      EXPECT_EQ(message, path +
                             ": GeoTIFF is read by builds with GDAL, which this one has not: install libgdal-dev and "
                             "build again, or convert it: gdal_translate -of AAIGrid seabed.tif seabed.asc");
      GTEST_SKIP() << "built without GDAL";
    }
  }
  LoadedGrid load(const Tiff& tiff) { return load_grid(folder_.write("seabed.tif", tiff.text())); }
  std::string refusal(const std::string& text) {
    const std::string path = folder_.write("seabed.tif", text);
    const std::string message = message_of([&] { (void)load_height_grid(path); });
    return message.starts_with(path) ? message.substr(path.size()) : message;
  }

  ScratchFolder folder_;
};

TEST_F(TiffGridTest, APixelIsAnAreaWhoseCornerIsGiven) {
  const LoadedGrid loaded =
      load(Tiff::of(3, kHeights).at(500000, 5800000, 2, 4).keys({{1024, 1}, {1025, kArea}, {3072, kUtm32}}));
  EXPECT_EQ(loaded.grid.columns, 3);
  EXPECT_EQ(loaded.grid.rows, 2);
  EXPECT_EQ(loaded.grid.heights, kHeights);
  EXPECT_EQ(loaded.grid.spacing_x, 2);
  EXPECT_EQ(loaded.grid.spacing_y, 4);
  EXPECT_EQ(loaded.grid.origin, Vec3(500000 + 1.5 * 2, 5800000 - 1 * 4, 0));
  EXPECT_THAT(loaded.notes, IsEmpty());
}

TEST_F(TiffGridTest, OrAPointThatIsGiven) {
  const LoadedGrid loaded =
      load(Tiff::of(3, kHeights).at(500000, 5800000, 2, 4).keys({{1024, 1}, {1025, kPoint}, {3072, kUtm32}}));
  EXPECT_EQ(loaded.grid.origin, Vec3(500000 + 1 * 2, 5800000 - 0.5 * 4, 0));
  EXPECT_EQ(loaded.grid.heights, kHeights);
}

TEST_F(TiffGridTest, HolesAreStoredValuesAndScaleAndOffsetMakeHeights) {
  Tiff tiff(3, 2, 16, 2);
  tiff.strips = {bytes_of(std::vector<std::int16_t>{-999, 10, 20, 30, 40, -32768})};
  tiff.at(0, 0, 1, 1).keys({{1024, 1}, {1025, kArea}, {3072, kUtm32}}).text(42113, "-999");
  tiff.text(42112,
            "<GDALMetadata><Item name=\"OFFSET\" sample=\"0\" role=\"offset\">-100</Item>"
            "<Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.5</Item></GDALMetadata>");
  EXPECT_THAT(load(tiff).grid.heights, ElementsAre(IsNan(), -95, -90, -85, -80, -16484));
  const LoadedGrid floats = load(Tiff::of(2, {NAN, 1, -9999, 3}).text(42113, "-9999").at(5, 5, 1, 1));
  EXPECT_THAT(floats.grid.heights, ElementsAre(IsNan(), 1, IsNan(), 3));
}

TEST_F(TiffGridTest, UnitsBecomeMetres) {
  const LoadedGrid degrees =
      load(Tiff::of(3, kHeights).at(10, 30, 0.001, 0.001).keys({{1024, 2}, {1025, kArea}, {2048, kWgs84}}));
  const DegreeLength degree = degree_length(29.999);
  EXPECT_NEAR(degrees.grid.spacing_x, 0.001 * degree.east, 1e-9);
  EXPECT_NEAR(degrees.grid.spacing_y, 0.001 * degree.north, 1e-9);
  ASSERT_EQ(degrees.notes.size(), 1U);
  EXPECT_THAT(degrees.notes[0], HasSubstr("info: seabed.tif: spacing of 0.001 x 0.001 degrees taken as "));

  const LoadedGrid feet =
      load(Tiff::of(3, kHeights).at(1000000, 200000, 10, 20).keys({{1024, 1}, {1025, kArea}, {3072, kNewYorkInFeet}}));
  constexpr double kSurveyFoot = 1200.0 / 3937;
  EXPECT_NEAR(feet.grid.spacing_x, 10 * kSurveyFoot, 1e-9);
  EXPECT_NEAR(feet.grid.spacing_y, 20 * kSurveyFoot, 1e-9);
  EXPECT_NEAR(feet.grid.origin.x(), 1000015 * kSurveyFoot, 1e-6);
}

TEST_F(TiffGridTest, TheFirstOfSeveralBandsIsTaken) {
  Tiff tiff(2, 2, 32, 3);
  tiff.strips = {bytes_of(std::vector<float>{1, 100, 2, 200, 3, 300, 4, 400})};
  tiff.shorts(277, {2}).shorts(258, {32, 32}).shorts(339, {3, 3}).shorts(338, {0}).at(7, 7, 1, 1);
  const LoadedGrid loaded = load(tiff);
  EXPECT_THAT(loaded.grid.heights, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(loaded.notes, ElementsAre("warning: seabed.tif: has 2 bands; heights are those of the first"));
}

TEST_F(TiffGridTest, CompressedAndTiledFilesAreTheSame) {
  Tiff packed = Tiff::of(3, kHeights);
  packed.shorts(259, {32773});  // PackBits: a count less one, then as many bytes as they are.
  const std::string bytes = bytes_of(kHeights);
  packed.strips = {'\x0b' + bytes.substr(0, 12) + '\x0b' + bytes.substr(12)};
  EXPECT_EQ(load(packed).grid.heights, kHeights);

  Tiff tiled(3, 2, 32, 3);
  std::vector<float> tile(16 * 16, 0);
  std::copy_n(kHeights.begin(), 3, tile.begin());
  std::copy_n(kHeights.begin() + 3, 3, tile.begin() + 16);
  tiled.strips = {bytes_of(tile)};
  tiled.longs(322, {16}).longs(323, {16});
  EXPECT_EQ(load(tiled).grid.heights, kHeights);
}

TEST_F(TiffGridTest, WithoutAPlaceTheSpacingIsAMetre) {
  const LoadedGrid loaded = load(Tiff::of(3, kHeights));
  EXPECT_EQ(loaded.grid.spacing_x, 1);
  EXPECT_THAT(loaded.notes, ElementsAre("warning: seabed.tif: says neither where it is nor its spacing: 1 m is taken"));
}

// Rows from south to north: y grows with the row.
TEST_F(TiffGridTest, TheNorthernRowIsTheFirst) {
  const LoadedGrid loaded = load(Tiff::of(3, kHeights)
                                     .doubles(34264, {2, 0, 0, 500000, 0, 4, 0, 5800000, 0, 0, 0, 0, 0, 0, 0, 1})
                                     .keys({{1024, 1}, {1025, kArea}, {3072, kUtm32}}));
  EXPECT_THAT(loaded.grid.heights, ElementsAre(-20, -21, -22, -10, -11, -12));
  EXPECT_EQ(loaded.grid.origin, Vec3(500003, 5800004, 0));
}

TEST_F(TiffGridTest, IsAWorld) {
  const Scene scene = load_scene(folder_.write("seabed.tiff", Tiff::of(3, kHeights).at(7, 7, 2, 4).text()));
  EXPECT_EQ(scene.instances.at(0).mesh->triangles.size(), 4U);
  EXPECT_NEAR(scene.bounds().low.z(), -22, 1e-6);
}

TEST_F(TiffGridTest, WhatCannotBeReadIsOneLine) {
  EXPECT_THAT(refusal("x"), HasSubstr(": is not a TIFF file that GDAL reads: "));
  EXPECT_THAT(refusal("II*"), HasSubstr(": is not a TIFF file that GDAL reads: "));
  EXPECT_EQ(refusal(Tiff::of(3, kHeights).doubles(34264, {1, 1, 0, 0, -1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}).text()),
            ": its rows do not run from west to east; turn it: gdalwarp seabed.tif seabed-north.tif");
  EXPECT_EQ(refusal(Tiff::of(1, {1, 2}).text()), ": 1 x 2 pixels; heights need from 2 x 2 to 200000 x 200000");
  Tiff huge(20000, 20000, 32, 3);
  huge.strips = {"x"};
  EXPECT_EQ(refusal(huge.text()),
            ": has 400000000 pixels, more than 100000000; for a file that you trust: INSONIFY_LIMITS=pixels=400000000");
}

// libtiff goes on without tags whose values are lost; then the place is among them, which is told.
TEST_F(TiffGridTest, ATruncatedFileIsNotReadInSilence) {
  const std::string whole = Tiff::of(3, kHeights).at(7, 7, 1, 1).text();
  for (std::size_t length = 1; length < whole.size(); length += 7) {
    const std::string path = folder_.write("seabed.tif", whole.substr(0, length));
    try {
      EXPECT_EQ(load_grid(path).notes.size(), 1U) << length;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path + ": ")) << length;
    }
  }
}

}  // namespace
}  // namespace insonify::tiff_grid_test
