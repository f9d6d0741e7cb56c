// load_height_grid_test.cpp -- heights from pictures and ESRI ASCII grids, north-west corner first and in metres.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "insonify/files.h"
#include "io/grid/height_grid_file.h"
#include "io/loaded_grid.h"
#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify::load_height_grid_test {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::IsEmpty;
using testing::IsNan;

// ----------------------------------------------------------------------------------------------------------------- PNG

struct Picture {
  int width, height, bits, type;
  std::vector<std::vector<png_byte>> rows;  // Packed as in PNG; 16-bit samples have the high byte first.
};

std::filesystem::path write_picture(const ScratchFolder& folder, const Picture& picture,
                                    int interlace = PNG_INTERLACE_NONE) {
  const std::filesystem::path path = folder.path() / "seabed.png";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, picture.width, picture.height, picture.bits, picture.type, interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  const png_color palette[2] = {{10, 10, 10}, {200, 200, 200}};
  if (picture.type == PNG_COLOR_TYPE_PALETTE) {
    png_set_PLTE(png, info, palette, 2);
  }
  png_set_gAMA(png, info, 0.45455);  // A display hint that heights must ignore.
  std::vector<png_bytep> rows;
  for (const auto& row : picture.rows) {
    rows.push_back(const_cast<png_bytep>(row.data()));
  }
  png_write_info(png, info);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
  return path;
}

TEST(PngGridTest, GreyOf16BitsRunsFromZeroToOne) {
  const ScratchFolder folder;
  for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
    const HeightGrid grid = load_height_grid(write_picture(
        folder, {3, 2, 16, PNG_COLOR_TYPE_GRAY, {{0, 0, 0, 1, 0x40, 0}, {0x80, 0, 0xff, 0xfe, 0xff, 0xff}}},
        interlace));
    EXPECT_EQ(grid.columns, 3);
    EXPECT_EQ(grid.rows, 2);
    EXPECT_EQ(grid.spacing_x, 1);
    EXPECT_EQ(grid.spacing_y, 1);
    EXPECT_THAT(grid.heights, ElementsAre(0, FloatEq(1 / 65535.F), FloatEq(16384 / 65535.F), FloatEq(32768 / 65535.F),
                                          FloatEq(65534 / 65535.F), 1));
  }
}

TEST(PngGridTest, GreyOf8BitsRunsFromZeroToOne) {
  const ScratchFolder folder;
  const HeightGrid grid =
      load_height_grid(write_picture(folder, {2, 2, 8, PNG_COLOR_TYPE_GRAY, {{0, 51}, {102, 255}}}));
  EXPECT_THAT(grid.heights, ElementsAre(0, FloatEq(0.2F), FloatEq(0.4F), 1));
}

TEST(PngGridTest, GreyInAnotherGuiseIsGrey) {
  const ScratchFolder folder;
  EXPECT_THAT(load_height_grid(write_picture(folder, {2, 2, 1, PNG_COLOR_TYPE_GRAY, {{0x40}, {0x80}}})).heights,
              ElementsAre(0, 1, 1, 0));
  EXPECT_THAT(
      load_height_grid(
          write_picture(folder, {2, 2, 8, PNG_COLOR_TYPE_RGB, {{0, 0, 0, 51, 51, 51}, {255, 255, 255, 0, 0, 0}}}))
          .heights,
      ElementsAre(0, FloatEq(0.2F), 1, 0));
  EXPECT_THAT(load_height_grid(
                  write_picture(folder, {2, 2, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {{0, 255, 51, 255}, {255, 255, 0, 255}}}))
                  .heights,
              ElementsAre(0, FloatEq(0.2F), 1, 0));
  EXPECT_THAT(load_height_grid(write_picture(folder, {2, 2, 8, PNG_COLOR_TYPE_PALETTE, {{0, 1}, {1, 1}}})).heights,
              ElementsAre(FloatEq(10 / 255.F), FloatEq(200 / 255.F), FloatEq(200 / 255.F), FloatEq(200 / 255.F)));
}

TEST(PngGridErrorTest, TellsThePathAndTheReason) {
  const ScratchFolder folder;
  const std::string path = (folder.path() / "seabed.png").string();
  const auto message = [&](const Picture& picture) {
    return message_of([&] { (void)load_height_grid(write_picture(folder, picture)); });
  };
  EXPECT_EQ(message({2, 2, 8, PNG_COLOR_TYPE_RGB, {{0, 0, 0, 5, 5, 5}, {9, 9, 9, 1, 2, 3}}}),
            path + ": the pixel in column 1, row 1 is coloured; heights need a grey picture");
  EXPECT_EQ(message({2, 2, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {{0, 255, 51, 254}, {255, 255, 0, 255}}}),
            path + ": the pixel in column 1, row 0 is transparent; heights need an opaque picture");
  EXPECT_EQ(message({1, 2, 8, PNG_COLOR_TYPE_GRAY, {{0}, {1}}}), path + ": 1 x 2 pixels; heights need at least 2 x 2");

  EXPECT_EQ(message_of([&] { (void)load_height_grid(folder.write("seabed.png", "hello, this is no picture")); }),
            path + ": cannot be read: Not a PNG file");
  (void)write_picture(folder, {2, 2, 8, PNG_COLOR_TYPE_GRAY, {{0, 51}, {102, 255}}});
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 12);
  EXPECT_EQ(message_of([&] { (void)load_height_grid(path); }),
            path + ": cannot be read: the file ends before its IEND");
  std::filesystem::resize_file(path, 60);
  EXPECT_EQ(message_of([&] { (void)load_height_grid(path); }), path + ": cannot be read: read beyond end of data");
}

// ----------------------------------------------------------------------------------------------------------------- ASC

TEST(AscGridTest, RunsFromTheNorthWestCorner) {
  const ScratchFolder folder;
  const LoadedGrid loaded =
      load_grid(folder.write("a.asc",
                             "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 6000000\ncellsize 20\nNODATA_value -9999\n"
                             "-1 -2 -3.5\n-4 -9999 +6e0\n"));
  const HeightGrid& grid = loaded.grid;
  EXPECT_THAT(loaded.notes, IsEmpty());
  EXPECT_EQ(grid.columns, 3);
  EXPECT_EQ(grid.rows, 2);
  EXPECT_EQ(grid.spacing_x, 20);
  EXPECT_EQ(grid.spacing_y, 20);
  EXPECT_EQ(grid.origin, Vec3(500030, 6000020, 0));
  EXPECT_THAT(grid.heights, ElementsAre(-1, -2, -3.5F, -4, IsNan(), 6));
}

// Lower left corner given by the centre of its cell, two spacings, any case and order, Windows line ends, a byte-order
// mark, line breaks within rows, and missing data although the header defines no value for it.
TEST(AscGridTest, HeadersOfAllKindsAreRead) {
  const ScratchFolder folder;
  const HeightGrid grid = load_height_grid(
      folder.write("a.ASC",
                   "\xef\xbb\xbfNROWS 2\r\nNCols\t3\r\nDY 5\r\ndx 2\r\nXLLCENTER 100\r\nyllCenter 200\r\n"
                   "1 2\r\n3 4 5\r\n-9999"));
  EXPECT_EQ(grid.spacing_x, 2);
  EXPECT_EQ(grid.spacing_y, 5);
  EXPECT_EQ(grid.origin, Vec3(102, 202.5, 0));
  EXPECT_THAT(grid.heights, ElementsAre(1, 2, 3, 4, 5, IsNan()));
}

TEST(AscGridTest, NoDataMayBeAnyNumberOrNan) {
  const ScratchFolder folder;
  const std::string header = "ncols 2\nnrows 2\ncellsize 1\nnodata_value ";
  EXPECT_THAT(load_height_grid(folder.write("a.asc", header + "0.1\n0.1 0.10 1 -9999\n")).heights,
              ElementsAre(IsNan(), IsNan(), 1, -9999));
  EXPECT_THAT(load_height_grid(folder.write("a.asc", header + "nan\nnan 1 2 3\n")).heights,
              ElementsAre(IsNan(), 1, 2, 3));
  EXPECT_THAT(
      load_height_grid(folder.write("a.asc", header + "-3.4028234663852886e+38\n-3.4028235e+38 1 2 3\n")).heights,
      ElementsAre(IsNan(), 1, 2, 3));
}

// A degree of WGS 84 at 60 degrees north: 111412.24 m of latitude, 55800.00 m of longitude (a pi/180 / sqrt(1 - e2
// sin2) times cos = 1/2, and that times (1 - e2) / (1 - e2 sin2)). Published, e.g. by NGA: 111 412 m and 55 800 m.
TEST(AscGridTest, DegreesBecomeMetres) {
  const ScratchFolder folder;
  const LoadedGrid loaded = load_grid(folder.write("a.asc",
                                                   "ncols 4\nnrows 2\nxllcorner 10\nyllcorner 59.99\ncellsize 0.01\n"
                                                   "1 2 3 4 5 6 7 8\n"));
  EXPECT_NEAR(loaded.grid.spacing_x, 558.00, 0.01);
  EXPECT_NEAR(loaded.grid.spacing_y, 1114.12, 0.01);
  EXPECT_NEAR(loaded.grid.origin.x(), 10.02, 1e-9);
  EXPECT_NEAR(loaded.grid.origin.y(), 60, 1e-9);
  EXPECT_THAT(loaded.notes,
              ElementsAre("info: a.asc: spacing of 0.01 x 0.01 degrees taken as 558 x 1114 m, at latitude "
                          "60"));
}

TEST(AscGridTest, DegreesAreTakenForWhatTheyLookLike) {
  const auto is_geographic = [](double x, double y, double spacing) {
    HeightGrid grid{10, 10, spacing, spacing, {}, Vec3(x, y, 0)};
    return looks_geographic(grid);
  };
  EXPECT_TRUE(is_geographic(-79.8, 29.5, 0.00083));
  EXPECT_TRUE(is_geographic(200, -60, 0.1));
  EXPECT_FALSE(is_geographic(0.03, 0.02, 0.01)) << "a tank, measured from its corner";
  EXPECT_FALSE(is_geographic(20, 30, 0.5)) << "half a degree is 55 km";
  EXPECT_FALSE(is_geographic(500000, 6000000, 0.01));
  EXPECT_FALSE(is_geographic(20, 95, 0.01)) << "no such latitude";
}

TEST(AscGridTest, AProjectionFileDecidesWhereThereIsOne) {
  const ScratchFolder folder;
  const std::string degrees = "ncols 2\nnrows 2\nxllcorner 10\nyllcorner 60\ncellsize 0.01\n1 2 3 4\n";
  const auto path = folder.write("a.asc", degrees);
  const auto spacing_with = [&](const std::string& projection) {
    folder.write("a.prj", projection);
    return load_height_grid(path).spacing_x;
  };
  EXPECT_EQ(spacing_with("PROJCS[\"WGS 84 / UTM zone 33N\",GEOGCS[\"WGS 84\"]]"), 0.01);
  EXPECT_GT(spacing_with("GEOGCS[\"WGS 84\"]"), 500);
  EXPECT_GT(spacing_with("Projection    GEOGRAPHIC\nUnits DD\n"), 500);
}

TEST(AscGridErrorTest, TellsTheLineAndTheReason) {
  struct BadFile {
    std::string text;
    std::string message;  // After the path.
  };
  const std::vector<BadFile> files{
      {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3 x4\n", ":5: \"x4\" is not a number"},
      {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3,5 4\n", ":5: \"3,5\" is not a number"},
      {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3 -inf\n", ":5: height -inf must be finite"},
      {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3\n\n", ":5: the file ends after 3 heights; ncols x nrows = 2 x 2 needs 4"},
      {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3 4\n5\n", ":6: more heights than ncols x nrows = 2 x 2 = 4"},
      {"ncols 2\ncellsize 1\n1 2\n", ":2: the header has no nrows"},
      {"ncols 2\nnrows 2\ndx 1\n1 2 3 4\n", ":3: the header has neither cellsize nor dy"},
      {"ncols 2\nnrows 2\ncellsize -1\n1 2 3 4\n", ":3: cellsize = -1 must be greater than 0"},
      {"ncols 2\nnrows 2\ndx nan\ndy 1\n1 2 3 4\n", ":3: dx = nan must be greater than 0"},
      {"ncols 1.5\nnrows 2\ncellsize 1\n1 2 3 4\n", ":1: ncols = 1.5 must be a whole number from 2 to 1000000"},
      {"ncols -2\nnrows 2\nxllcorner 0\ncellsize 1\n1 2 3 4\n",
       ":1: ncols = -2 must be a whole number from 2 to 1000000"},
      {"ncols 2\nncols 3\n", ":2: ncols is given twice"},
      {"ncols 2\nnrows\n2 cellsize 1\n1 2 3 4\n", ":2: nrows needs a number"},
      {"ncols 2\nncows 2\n",
       ":2: \"ncows\" is neither a number nor a key of an ESRI ASCII grid; keys: ncols, nrows, xllcorner, xllcenter, "
       "yllcorner, yllcenter, cellsize, dx, dy, nodata_value"},
      {"", ": the file is empty"},
      {"ncols 1000000\nnrows 1000000\ncellsize 1\n1\n",
       ":4: the file ends after 1 heights; ncols x nrows = 1000000 x 1000000 needs 1000000000000"},
  };
  for (const BadFile& file : files) {
    const ScratchFolder folder;
    const std::filesystem::path path = folder.write("a.asc", file.text);
    EXPECT_EQ(message_of([&] { (void)load_height_grid(path); }), path.string() + file.message);
  }
}

TEST(LoadAscGridTest, AGridWithoutDataIsToldWithItsFile) {
  const ScratchFolder folder;
  const std::filesystem::path path =
      folder.write("a.asc", "ncols 2\nnrows 2\ncellsize 1\nNODATA_value -1\n-1 -1\n-1 3\n");
  EXPECT_EQ(message_of([&] { (void)make_height_field(load_height_grid(path)); }),
            path.string() + ": no triangles, as no three neighbouring points have data");
}

// ----------------------------------------------------------------------------------------------------------------------

TEST(LoadHeightGridErrorTest, TellsWhatIsNoHeightGrid) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.write("seabed.grd", "x");
  EXPECT_EQ(
      message_of([&] { (void)load_height_grid(path); }),
      path.string() + ": \".grd\" is not a known extension of a height grid; known: .png, .asc, .bag, .tif, .tiff");
  EXPECT_EQ(message_of([&] { (void)load_height_grid("/nowhere/seabed.bag"); }), "/nowhere/seabed.bag: no such file");
}

// Three seconds of arc at 29.5 degrees north.
TEST(RealHeightGridTest, Asc) {
  INSONIFY_REAL_DATA(path, "bathymetry_asc/small_crm.asc");
  const LoadedGrid loaded = load_grid(path);
  EXPECT_EQ(loaded.grid.columns, 241);
  EXPECT_EQ(loaded.grid.rows, 241);
  EXPECT_NEAR(loaded.grid.spacing_x, 80.8, 0.1);
  EXPECT_NEAR(loaded.grid.spacing_y, 92.4, 0.1);
  const Extent extent = extent_of(loaded.grid);
  EXPECT_EQ(extent.low, -771);
  EXPECT_EQ(extent.high, -622);
  EXPECT_EQ(extent.count, 241U * 241U);
  EXPECT_EQ(loaded.notes.size(), 1U);
}

}  // namespace
}  // namespace insonify::load_height_grid_test
