// sounding_grid_files_test.cpp -- grids of soundings read back by the readers of height grids, HDF5 and NumPy archives.

#include "insonify/sounding_grid_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "insonify/files.h"
#include "insonify/mesh.h"
#include "io/file/hdf5.h"
#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify::sounding_grid_files_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

// 3 x 2 cells of 2 m; the upper left corner at (-10, 40).
SoundingGrid small_grid() {
  return {.west = -10,
          .north = 40,
          .cell = 2,
          .columns = 3,
          .rows = 2,
          .height = {-1, -2, kNone, -4, -5, -6},
          .uncertainty = {.1F, .2F, kNone, .4F, .5F, .6F},
          .count = {1, 2, 0, 4, 5, 6},
          .truth = {-1, -2, -3, -4, -5, kNone},
          .given = 18};
}

std::string bytes_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(SoundingGridFilesTest, BagsAreReadBack) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "a.bag";
  write_sounding_grid(small_grid(), path);
  const HeightGrid grid = load_height_grid(path);
  EXPECT_EQ(grid.columns, 3);
  EXPECT_EQ(grid.rows, 2);
  EXPECT_EQ(grid.spacing_x, 2);
  EXPECT_EQ(grid.spacing_y, 2);
  EXPECT_EQ(grid.origin, Vec3(-7, 38, 0));
  EXPECT_THAT(grid.heights, ElementsAre(-1, -2, IsNan(), -4, -5, -6));
}

// On the equator a degree is 111 319.49 m east and 110 574.28 m north; heights count from the datum.
TEST(SoundingGridFilesTest, BagsOnTheEarthAreInDegrees) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "a.bag";
  write_sounding_grid(small_grid(), path, {.origin = GeographicPoint{0, 10}, .datum = 2});
  const HeightGrid grid = load_height_grid(path);
  EXPECT_NEAR(grid.spacing_x, 2, 1e-5);
  EXPECT_NEAR(grid.spacing_y, 2, 1e-5);
  EXPECT_NEAR(grid.origin.x(), 10 - 7 / 111319.49, 1e-9);
  EXPECT_NEAR(grid.origin.y(), 38 / 110574.28, 1e-9);
  EXPECT_THAT(grid.heights, ElementsAre(-3, -4, IsNan(), -6, -7, -8));
}

// The datasets that the format's specification names.
TEST(SoundingGridFilesTest, BagsHaveWhatTheFormatAsksFor) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "a.bag";
  write_sounding_grid(small_grid(), path, {.title = "R&D <1>"});
  const H5Handle file = h5_open_to_read(path);
  const auto attribute = [&](const char* of, const char* name) {
    float value = 0;
    const H5Handle object(H5Oopen(file.get(), of, H5P_DEFAULT), H5Oclose);
    const H5Handle opened(H5Aopen(object.get(), name, H5P_DEFAULT), H5Aclose);
    H5Aread(opened.get(), H5T_NATIVE_FLOAT, &value);
    return value;
  };
  EXPECT_EQ(attribute("/BAG_root/elevation", "Minimum Elevation Value"), -6);
  EXPECT_EQ(attribute("/BAG_root/elevation", "Maximum Elevation Value"), -1);
  EXPECT_EQ(attribute("/BAG_root/uncertainty", "Minimum Uncertainty Value"), .1F);
  EXPECT_EQ(attribute("/BAG_root/uncertainty", "Maximum Uncertainty Value"), .6F);
  std::array<float, 6> uncertainty{};
  const H5Handle layer(H5Dopen2(file.get(), "/BAG_root/uncertainty", H5P_DEFAULT), H5Dclose);
  H5Dread(layer.get(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, uncertainty.data());
  EXPECT_THAT(uncertainty, ElementsAre(.4F, .5F, .6F, .1F, .2F, 1e6F));
  const H5Handle list(H5Dopen2(file.get(), "/BAG_root/tracking_list", H5P_DEFAULT), H5Dclose);
  const H5Handle space(H5Dget_space(list.get()), H5Sclose);
  EXPECT_EQ(H5Sget_simple_extent_npoints(space.get()), 0);
  char version[32] = {};
  const H5Handle root(H5Gopen2(file.get(), "/BAG_root", H5P_DEFAULT), H5Gclose);
  const H5Handle stored(H5Aopen(root.get(), "Bag Version", H5P_DEFAULT), H5Aclose);
  const H5Handle text(H5Aget_type(stored.get()), H5Tclose);
  H5Aread(stored.get(), text.get(), version);
  EXPECT_STREQ(version, "1.6.3");
  const H5Handle metadata(H5Dopen2(file.get(), "/BAG_root/metadata", H5P_DEFAULT), H5Dclose);
  const H5Handle characters(H5Dget_type(metadata.get()), H5Tclose);
  std::string xml(H5Dget_storage_size(metadata.get()), '\0');
  H5Dread(metadata.get(), characters.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, xml.data());
  EXPECT_THAT(xml, HasSubstr("<gco:CharacterString>R&amp;D &lt;1&gt;</gco:CharacterString>"));
  EXPECT_THAT(xml, HasSubstr("-9,37 -5,39</gml:coordinates>"));
}

TEST(SoundingGridFilesTest, AsciiGridsAndGeoTiffHaveHeightsAboveTheDatum) {
  const ScratchFolder folder;
  write_sounding_grid(small_grid(), folder.path() / "a.asc", {.datum = 0.5});
  EXPECT_EQ(bytes_in(folder.path() / "a.asc"),
            "ncols 3\nnrows 2\nxllcorner -10\nyllcorner 36\ncellsize 2\nNODATA_value -9999\n-1.5 -2.5 -9999\n-4.5 -5.5 "
            "-6.5\n");
  write_sounding_grid(small_grid(), folder.path() / "a.tif", {.datum = 0.5});
  HeightGrid grid;
  const std::string message = message_of([&] { grid = load_height_grid(folder.path() / "a.tif"); });
  if (message.find("builds with GDAL") != std::string::npos) {
    GTEST_SKIP() << message;
  }
  EXPECT_EQ(message, "no error");
  EXPECT_THAT(grid.heights, ElementsAre(-1.5, -2.5, IsNan(), -4.5, -5.5, -6.5));
  EXPECT_EQ(grid.origin, Vec3(-7, 38, 0));
}

TEST(SoundingGridFilesTest, NumPyArchivesHaveAllLayers) {
  const ScratchFolder folder;
  write_sounding_grid(small_grid(), folder.path() / "a.npz", {.origin = GeographicPoint{54, 8}});
  const std::string bytes = bytes_in(folder.path() / "a.npz");
  for (const char* name :
       {"height.npy", "uncertainty.npy", "count.npy", "truth.npy", "x.npy", "y.npy", "origin.npy", "datum.npy"}) {
    EXPECT_THAT(bytes, HasSubstr(name));
  }
  SoundingGrid without = small_grid();
  without.truth.clear();
  write_sounding_grid(without, folder.path() / "b.npz");
  EXPECT_THAT(bytes_in(folder.path() / "b.npz"), testing::Not(HasSubstr("truth.npy")));
}

TEST(SoundingGridFilesTest, OtherEndingsSmallGridsAndOriginsAreRefused) {
  EXPECT_EQ(message_of([] { write_sounding_grid(small_grid(), "a.bmp"); }),
            "a.bmp: a grid of soundings is written as .bag, .tif, .asc, .npz");
  EXPECT_EQ(message_of([] {
              write_sounding_grid(small_grid(), "a.bag", {.origin = GeographicPoint{90, 0}});
            }),
            "origin.latitude = 90 deg must be from -89 to 89 deg");
  const SoundingGrid row{.cell = 1, .columns = 2, .rows = 1, .height = {1, 2}, .uncertainty = {1, 1}, .count = {1, 1}};
  EXPECT_EQ(message_of([&] { write_sounding_grid(row, "a.bag"); }),
            "a.bag: a grid of 2 x 1 cells is too small for a BAG, which has at least 2 x 2");
  EXPECT_THAT(message_of([] { write_sounding_grid(small_grid(), "nowhere/a.bag"); }),
              HasSubstr("nowhere/a.bag: cannot write: No such file or directory"));
}

// A file that may not grow, as on a full disk: the one before it stays, and nothing is left beside it.
TEST(SoundingGridFilesTest, AFullDiskIsTold) {
  const ScratchFolder folder;
  for (const char* ending : {".bag", ".tif", ".asc", ".npz"}) {
    const std::filesystem::path path = folder.path() / (std::string("a") + ending);
    folder.write(path.filename(), "old");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{.rlim_cur = 64, .rlim_max = before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = message_of([&] { write_sounding_grid(small_grid(), path); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(message, path.string() + ": cannot write: File too large") << ending;
    EXPECT_EQ(bytes_in(path), "old");
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()),
            4);
}

}  // namespace
}  // namespace insonify::sounding_grid_files_test
