// mosaic_files_test.cpp -- cells of a mosaic read back by the readers of grids and recordings.

#include "insonify/mosaic_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/mesh.h"
#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify::mosaic_files_test {
namespace {

// 3 x 2 cells of 2 m; the upper left corner at (-10, 40).
Mosaic small_mosaic() {
  const float none = std::numeric_limits<float>::quiet_NaN();
  return {.west = -10,
          .north = 40,
          .cell = 2,
          .columns = 3,
          .rows = 2,
          .intensity = {1, 2, none, 4, 5, 6},
          .angle = {.1F, .2F, none, .4F, .5F, .6F},
          .line = {0, 0, kNoLabel, 1, 1, 1},
          .instance = {3, 3, kNoLabel, 3, 0, 0}};
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(MosaicFilesTest, AsciiGridsAreInMetresOfTheWorld) {
  const ScratchFolder folder;
  write_mosaic(small_mosaic(), folder.path() / "a.asc");
  EXPECT_EQ(text_of(folder.path() / "a.asc"),
            "ncols 3\nnrows 2\nxllcorner -10\nyllcorner 36\ncellsize 2\nNODATA_value -9999\n1 2 -9999\n4 5 6\n");
}

// Longitude by hand: on the equator a degree is 111 319.49 m east and 110 574.28 m north.
TEST(MosaicFilesTest, WorldFilesHaveTheMiddleOfTheFirstPixel) {
  EXPECT_EQ(world_file_text(small_mosaic()), "2\n0\n0\n-2\n-9\n39\n");
  double numbers[6] = {};
  const std::string text = world_file_text(small_mosaic(), GeographicPoint{0, 10});
  ASSERT_EQ(std::sscanf(text.c_str(), "%lf %lf %lf %lf %lf %lf", numbers, numbers + 1, numbers + 2, numbers + 3,
                        numbers + 4, numbers + 5),
            6);
  EXPECT_NEAR(numbers[0] * 111319.49, 2, 1e-6);
  EXPECT_NEAR(numbers[3] * 110574.28, -2, 1e-6);
  EXPECT_NEAR((numbers[4] - 10) * 111319.49, -9, 1e-5);
  EXPECT_NEAR(numbers[5] * 110574.28, 39, 1e-5);
}

// Tags of a TIFF as its specification has them: 12 bytes each from byte 10 on.
TEST(MosaicFilesTest, GeoTiffHasFloatsAndItsPlace) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "a.tif";
  write_mosaic(small_mosaic(), path);
  const std::string bytes = text_of(path);
  const auto number = [&](std::size_t at, auto value) {
    std::memcpy(&value, &bytes.at(at), sizeof value);
    return value;
  };
  ASSERT_EQ(bytes.substr(0, 4), std::string("II*\0", 4));
  std::map<int, std::size_t> places;
  for (int i = 0; i < number(8, std::uint16_t{}); ++i) {
    places[number(10 + 12 * i, std::uint16_t{})] = 10 + 12 * i;
  }
  const auto value_of = [&](int tag) { return number(places.at(tag) + 8, std::uint32_t{}); };
  EXPECT_EQ(value_of(256), 3);
  EXPECT_EQ(value_of(257), 2);
  EXPECT_EQ(value_of(279), 24);
  EXPECT_EQ(bytes.size(), value_of(273) + 24);
  EXPECT_EQ(number(value_of(273) + 4, float{}), 2);
  EXPECT_TRUE(std::isnan(number(value_of(273) + 8, float{})));
  EXPECT_EQ(number(value_of(33550), double{}), 2);
  EXPECT_EQ(number(value_of(33922) + 24, double{}), -10);
  EXPECT_EQ(number(value_of(33922) + 32, double{}), 40);
}

// The same by GDAL, where insonify was built with it.
TEST(MosaicFilesTest, GeoTiffIsReadBack) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "a.tif";
  Mosaic mosaic = small_mosaic();
  mosaic.intensity[2] = 3;
  write_mosaic(mosaic, path);
  HeightGrid grid;
  try {
    grid = load_height_grid(path);
  } catch (const Error& error) {
    if (std::string(error.what()).find("builds with GDAL") != std::string::npos) {
      GTEST_SKIP() << error.what();
    }
    throw;
  }
  EXPECT_EQ(grid.heights, mosaic.intensity);
  EXPECT_EQ(grid.spacing_x, 2);
  EXPECT_EQ(grid.origin.x(), -7);
  EXPECT_EQ(grid.origin.y(), 38);
}

TEST(MosaicFilesTest, OtherEndingsAndOriginsAreRefused) {
  EXPECT_EQ(message_of([] { write_mosaic(small_mosaic(), "a.bmp"); }),
            "a.bmp: a mosaic is written as .npz, .tif, .asc");
  EXPECT_EQ(message_of([] {
              write_mosaic(small_mosaic(), "a.tif", GeographicPoint{90, 0});
            }),
            "origin.latitude = 90 deg must be from -89 to 89 deg");
}

}  // namespace
}  // namespace insonify::mosaic_files_test
