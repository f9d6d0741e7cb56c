// load_height_grid_test.cpp -- heights from pictures, ESRI ASCII grids and BAGs, north-west corner first and in metres.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "insonify/files.h"
#include "io/hdf5.h"
#include "io/height_grid_file.h"
#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::IsEmpty;
using testing::IsNan;

// Loads a file and what was said about it.
struct Loaded {
  HeightGrid grid;
  std::vector<std::string> notes;
};

Loaded load(const std::filesystem::path& path) {
  Loaded loaded;
  loaded.grid = load_height_grid(path, [&](Severity severity, const std::string& note) {
    loaded.notes.push_back((severity == Severity::kWarning ? "warning: " : "info: ") + note);
  });
  return loaded;
}

// Lowest and highest height, and how many there are.
struct Extent {
  float low = INFINITY, high = -INFINITY;
  std::size_t count = 0;
};

Extent extent_of(const HeightGrid& grid) {
  Extent extent;
  for (const float height : grid.heights) {
    if (!std::isnan(height)) {
      extent = {std::min(extent.low, height), std::max(extent.high, height), extent.count + 1};
    }
  }
  return extent;
}

// --------------------------------------------------------------------------------------------------------------- PNG
// --

struct Picture {
  int width, height, bits, type;
  std::vector<std::vector<png_byte>> rows;  // As PNG packs them; 16 bits high byte first.
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
  png_set_gAMA(png, info, 0.45455);  // Says how to show it; heights must not care.
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
  std::filesystem::resize_file(path, 60);
  EXPECT_EQ(message_of([&] { (void)load_height_grid(path); }), path + ": cannot be read: Read Error");
}

// --------------------------------------------------------------------------------------------------------------- ASC
// --

TEST(AscGridTest, RunsFromTheNorthWestCorner) {
  const ScratchFolder folder;
  const Loaded loaded =
      load(folder.write("a.asc",
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

// Lower left by the middle of its cell, two spacings, any case and order, Windows line ends, a byte-order mark, heights
// wrapped elsewhere than at the ends of rows, and no data where the header says nothing of it.
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
  const Loaded loaded = load(folder.write("a.asc",
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
      {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3 x4\n", ":5: \"x4\" is no number"},
      {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3,5 4\n", ":5: \"3,5\" is no number"},
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

// --------------------------------------------------------------------------------------------------------------- BAG
// --

// What varies between the BAGs of the tests; the heights are 2 rows x 3 columns, the southern row first.
struct Bag {
  std::string row = "4", column = "2";  // Resolution.
  std::string corners = "500000,6000000 500004,6000004";
  std::string reference = "<code>UTM</code>";
  std::string unit = "m";
  std::vector<float> heights{-1, -2, -3, -4, 1e6F, -6};
  bool varies = false;  // In resolution.
};

std::string bag_xml(const Bag& bag) {
  const auto dimension = [&](const std::string& name, const std::string& resolution) {
    return fmt::format(
        "<gmd:axisDimensionProperties><gmd:MD_Dimension><gmd:dimensionName><gmd:MD_DimensionNameTypeCode "
        "codeListValue=\"{0}\">{0}</gmd:MD_DimensionNameTypeCode></gmd:dimensionName>{1}</gmd:MD_Dimension>"
        "</gmd:axisDimensionProperties>",
        name,
        resolution.empty() ? ""
                           : fmt::format("<gmd:resolution><gco:Measure uom=\"{}\">{}</gco:Measure>"
                                         "</gmd:resolution>",
                                         bag.unit, resolution));
  };
  return "<?xml version=\"1.0\"?><gmi:MI_Metadata><!-- <resolution>99</resolution> -->" + dimension("row", bag.row) +
         dimension("column", bag.column) +
         "<gmd:cornerPoints><gml:Point><gml:coordinates decimal=\".\" cs=\",\" ts=\" \">" + bag.corners +
         "</gml:coordinates></gml:Point></gmd:cornerPoints><gmd:referenceSystemInfo>" + bag.reference +
         "</gmd:referenceSystemInfo><gmd:referenceSystemInfo><code>VERT_CS[\"x\"]</code></gmd:referenceSystemInfo>"
         "</gmi:MI_Metadata>";
}

void write_dataset(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& size, const void* values) {
  const H5Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  const H5Handle data(H5Dcreate2(file, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
}

std::filesystem::path write_bag(const ScratchFolder& folder, const Bag& bag = {}) {
  const std::filesystem::path path = folder.path() / "seabed.bag";
  const H5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  const H5Handle group(H5Gcreate2(file.get(), "/BAG_root", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  write_dataset(file.get(), "/BAG_root/elevation", H5T_NATIVE_FLOAT, {bag.heights.size() / 3, 3}, bag.heights.data());
  const std::string xml = bag_xml(bag);
  write_dataset(file.get(), "/BAG_root/metadata", H5T_C_S1, {xml.size()}, xml.data());
  if (bag.varies) {
    write_dataset(file.get(), "/BAG_root/varres_refinements", H5T_NATIVE_FLOAT, {1, 1}, bag.heights.data());
  }
  return path;
}

TEST(BagGridTest, TurnsTheNorthernRowFirst) {
  const ScratchFolder folder;
  const Loaded loaded = load(write_bag(folder));
  EXPECT_THAT(loaded.notes, IsEmpty());
  EXPECT_EQ(loaded.grid.columns, 3);
  EXPECT_EQ(loaded.grid.rows, 2);
  EXPECT_EQ(loaded.grid.spacing_x, 2);
  EXPECT_EQ(loaded.grid.spacing_y, 4);
  EXPECT_EQ(loaded.grid.origin, Vec3(500002, 6000002, 0));
  EXPECT_THAT(loaded.grid.heights, ElementsAre(-4, IsNan(), -6, -1, -2, -3));
}

// An odd number of rows has a middle one, which stays.
TEST(BagGridTest, TurnsAnOddNumberOfRows) {
  const ScratchFolder folder;
  const HeightGrid grid = load_height_grid(write_bag(folder, {.heights = {1, 1, 1, 2, 2, 2, 3, 3, 3}}));
  EXPECT_THAT(grid.heights, ElementsAre(3, 3, 3, 2, 2, 2, 1, 1, 1));
}

TEST(BagGridTest, SpacingComesFromTheCornersWhereThereIsNoOther) {
  const ScratchFolder folder;
  const HeightGrid grid = load_height_grid(write_bag(folder, {.row = "", .column = ""}));
  EXPECT_EQ(grid.spacing_x, 2);
  EXPECT_EQ(grid.spacing_y, 4);
}

TEST(BagGridTest, DegreesAreToldByReferenceSystemUnitOrCorners) {
  const ScratchFolder folder;
  const Bag degrees{.row = "0.01", .column = "0.01", .corners = "10,59.995 10.02,60.005"};
  const auto spacing = [&](const std::string& reference, const std::string& unit) {
    Bag bag = degrees;
    bag.reference = reference;
    bag.unit = unit;
    return load_height_grid(write_bag(folder, bag)).spacing_x;
  };
  EXPECT_NEAR(spacing("<code>GEOGCS[\"WGS 84\"]</code>", "m"), 558.00, 0.01);
  EXPECT_NEAR(spacing("<code> Geodetic </code>", "m"), 558.00, 0.01);
  EXPECT_NEAR(spacing("<gmd:code><gco:CharacterString>4326</gco:CharacterString></gmd:code>", "m"), 558.00, 0.01);
  EXPECT_NEAR(spacing("<code>PROJCS[\"x\"]</code>", "degrees"), 558.00, 0.01);
  EXPECT_NEAR(spacing("", "m"), 558.00, 0.01);
  EXPECT_EQ(spacing("<code>PROJCS[\"x\",GEOGCS[\"WGS 84\"]]</code>", "m"), 0.01);
}

TEST(BagGridTest, WarnsWhereResolutionAndCornersDisagree) {
  const ScratchFolder folder;
  EXPECT_THAT(
      load(write_bag(folder, {.column = "20"})).notes,
      ElementsAre("warning: seabed.bag: its metadata gives a column resolution of 20, but corner points 2 apart; "
                  "the first is used"));
}

TEST(BagGridTest, WarnsThatRefinementsAreLeftOut) {
  const ScratchFolder folder;
  EXPECT_THAT(
      load(write_bag(folder, {.varies = true})).notes,
      ElementsAre("warning: seabed.bag: a grid of variable resolution; only its base grid of 3 x 2 points every "
                  "2 m is read"));
}

TEST(BagGridErrorTest, TellsThePathAndTheReason) {
  const ScratchFolder folder;
  const std::string path = (folder.path() / "seabed.bag").string();
  const auto message = [&] { return message_of([&] { (void)load_height_grid(path); }); };

  (void)folder.write("seabed.bag", "not HDF5");
  EXPECT_EQ(message(), path + ": cannot open it as HDF5: file signature not found");
  (void)write_bag(folder, {.row = "", .corners = "0,0 1"});
  EXPECT_EQ(message(), path + ": its metadata gives no resolution of the row dimension");
  (void)write_bag(folder, {.row = "0", .column = "-2", .corners = ""});
  EXPECT_EQ(message(), path + ": its metadata gives no resolution of the column dimension");
  (void)write_bag(folder, {.heights = {1, 2, 3}});
  EXPECT_EQ(message(), path + ": /BAG_root/elevation must have from 2 to 200000 rows and columns");
  (void)write_bag(folder, {.row = "0.01", .column = "0.01", .corners = "10,94 10.02,94.01", .unit = "deg"});
  EXPECT_EQ(message(), path + ": its middle is at latitude 94.005, which must be between -90 and 90 degrees");
  { const H5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose); }
  EXPECT_EQ(message(), path + ": cannot open /BAG_root/elevation: component not found");
}

// ----------------------------------------------------------------------------------------------------------------------

TEST(LoadHeightGridErrorTest, TellsWhatIsNoHeightGrid) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.write("seabed.tif", "x");
  EXPECT_EQ(message_of([&] { (void)load_height_grid(path); }),
            path.string() + ": \".tif\" is no known ending of a height grid; known: .png, .asc, .bag");
  EXPECT_EQ(message_of([&] { (void)load_height_grid("/nowhere/seabed.bag"); }), "/nowhere/seabed.bag: no such file");
}

// Two metres between points in UTM, depths from 50.99 to 52.96 m.
TEST(RealHeightGridTest, Bag) {
  INSONIFY_REAL_DATA(path, "bathymetry_bag/JD211_public_Release_1-4_UTM.bag");
  const Loaded loaded = load(path);
  EXPECT_THAT(loaded.notes, IsEmpty());
  EXPECT_EQ(loaded.grid.columns, 1707);
  EXPECT_EQ(loaded.grid.rows, 1478);
  EXPECT_EQ(loaded.grid.spacing_x, 2);
  EXPECT_EQ(loaded.grid.spacing_y, 2);
  const Extent extent = extent_of(loaded.grid);
  EXPECT_NEAR(extent.low, -52.957, 1e-3);
  EXPECT_NEAR(extent.high, -50.987, 1e-3);
  EXPECT_EQ(extent.count, 1157306U);

  const Mesh mesh = make_height_field(loaded.grid);
  EXPECT_LE(mesh.vertices.size(), extent.count);
  EXPECT_GT(mesh.triangles.size(), 2'200'000U);
}

TEST(RealHeightGridTest, BagOfVariableResolution) {
  INSONIFY_REAL_DATA(path, "bathymetry_bag/Sample_VR_BAG-gzip.bag");
  const Loaded loaded = load(path);
  EXPECT_EQ(loaded.grid.columns, 4);
  EXPECT_EQ(loaded.grid.spacing_x, 50.1675);
  EXPECT_EQ(extent_of(loaded.grid).count, 6U);
  EXPECT_THAT(loaded.notes,
              ElementsAre("warning: Sample_VR_BAG-gzip.bag: a grid of variable resolution; only its base grid of 4 x 4 "
                          "points every 50.17 m is read"));
}

// Three seconds of arc at 29.5 degrees north.
TEST(RealHeightGridTest, Asc) {
  INSONIFY_REAL_DATA(path, "bathymetry_asc/small_crm.asc");
  const Loaded loaded = load(path);
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
}  // namespace insonify
