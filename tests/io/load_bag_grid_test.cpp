// load_bag_grid_test.cpp -- heights from BAG files, reordered to have the north-west corner first, in metres.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "io/file/hdf5.h"
#include "io/loaded_grid.h"
#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify::load_bag_grid_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsNan;

// Parameters of the tests' BAG files; the heights are 2 rows x 3 columns, the southern row first.
struct Bag {
  std::string row = "4", column = "2";  // Resolution.
  std::string corners = "500000,6000000 500004,6000004";
  std::string reference = "<code>UTM</code>";
  std::string unit = "m";
  std::vector<float> heights{-1, -2, -3, -4, 1e6F, -6};
  bool varies = false;  // Variable resolution.
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
  const LoadedGrid loaded = load_grid(write_bag(folder));
  EXPECT_THAT(loaded.notes, IsEmpty());
  EXPECT_EQ(loaded.grid.columns, 3);
  EXPECT_EQ(loaded.grid.rows, 2);
  EXPECT_EQ(loaded.grid.spacing_x, 2);
  EXPECT_EQ(loaded.grid.spacing_y, 4);
  EXPECT_EQ(loaded.grid.origin, Vec3(500002, 6000002, 0));
  EXPECT_THAT(loaded.grid.heights, ElementsAre(-4, IsNan(), -6, -1, -2, -3));
}

// With an odd number of rows, the middle one stays.
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
      load_grid(write_bag(folder, {.column = "20"})).notes,
      ElementsAre("warning: seabed.bag: its metadata gives a column resolution of 20, but corner points 2 apart; "
                  "the first is used"));
}

TEST(BagGridTest, WarnsThatRefinementsAreLeftOut) {
  const ScratchFolder folder;
  EXPECT_THAT(
      load_grid(write_bag(folder, {.varies = true})).notes,
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

// Two metres between points in UTM, depths from 50.99 to 52.96 m.
TEST(RealHeightGridTest, Bag) {
  INSONIFY_REAL_DATA(path, "bathymetry_bag/JD211_public_Release_1-4_UTM.bag");
  const LoadedGrid loaded = load_grid(path);
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
  const LoadedGrid loaded = load_grid(path);
  EXPECT_EQ(loaded.grid.columns, 4);
  EXPECT_EQ(loaded.grid.spacing_x, 50.1675);
  EXPECT_EQ(extent_of(loaded.grid).count, 6U);
  EXPECT_THAT(loaded.notes,
              ElementsAre("warning: Sample_VR_BAG-gzip.bag: a grid of variable resolution; only its base grid of 4 x 4 "
                          "points every 50.17 m is read"));
}

}  // namespace
}  // namespace insonify::load_bag_grid_test
