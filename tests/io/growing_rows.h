// growing_rows.h -- files of numbered rows, for the tests of growing files.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "io/h5_read.h"
#include "io/recording/growing_file.h"
#include "support/test_files.h"

namespace insonify {

/// A ping of 30 x 40 cells. Every value encodes its row and its cell.
inline constexpr std::size_t kCells = 30 * 40;

struct Row {
  std::vector<std::uint32_t> words = std::vector<std::uint32_t>(kCells);
  std::vector<std::uint16_t> labels = std::vector<std::uint16_t>(kCells);
  double time = 0;

  explicit Row(std::uint64_t number) { set(number); }
  void set(std::uint64_t number) {
    std::iota(words.begin(), words.end(), static_cast<std::uint32_t>(number * kCells));
    std::iota(labels.begin(), labels.end(), static_cast<std::uint16_t>(number));
    time = 0.25 * static_cast<double>(number);
  }
  void append_to(GrowingFile& file) const {
    const std::array rows = {std::as_bytes(std::span(words)), std::as_bytes(std::span(labels)),
                             std::as_bytes(std::span(&time, 1))};
    file.append(rows);
  }
};

enum class Kind { kPlain, kCompressed };
inline constexpr Kind kKinds[] = {Kind::kPlain, Kind::kCompressed};

inline GrowingFile make_file(const std::filesystem::path& path, Kind kind = Kind::kPlain, bool replace = false) {
  const auto describe = [](hid_t file) { H5Gclose(H5Gcreate2(file, "aside", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); };
  const bool compress = kind == Kind::kCompressed;
  return {path,
          {{"words", H5T_STD_U32LE, {30, 40}, compress},
           {"labels", H5T_STD_U16LE, {30, 40}, compress},
           {"time", H5T_IEEE_F64LE, {}, compress}},
          describe,
          {.replace = replace}};
}

inline void record(const std::filesystem::path& path, std::uint64_t rows, Kind kind = Kind::kPlain) {
  GrowingFile file = make_file(path, kind, true);
  for (std::uint64_t number = 0; number < rows; ++number) {
    Row(number).append_to(file);
  }
  file.close();
}

/// Adds a row to all datasets through HDF5, as any other program would.
inline void append_by_hdf5(hid_t file, const Row& row, hsize_t number) {
  const auto append = [&](const char* name, hid_t type, std::vector<hsize_t> shape, const void* values) {
    const H5Handle data(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    shape.insert(shape.begin(), number + 1);
    h5_check(H5Dset_extent(data.get(), shape.data()), name, "extend");
    std::vector<hsize_t> start(shape.size(), 0), length = shape;
    start[0] = number;
    length[0] = 1;
    const H5Handle to(H5Dget_space(data.get()), H5Sclose);
    H5Sselect_hyperslab(to.get(), H5S_SELECT_SET, start.data(), nullptr, length.data(), nullptr);
    const H5Handle from(H5Screate_simple(static_cast<int>(length.size()), length.data(), nullptr), H5Sclose);
    h5_check(H5Dwrite(data.get(), type, from.get(), to.get(), H5P_DEFAULT, values), name, "write");
  };
  append("words", H5T_NATIVE_UINT32, {30, 40}, row.words.data());
  append("labels", H5T_NATIVE_UINT16, {30, 40}, row.labels.data());
  append("time", H5T_NATIVE_DOUBLE, {}, &row.time);
}

/// Opens the file through HDF5 and returns its number of rows. Checks the first, the last and one between.
inline std::uint64_t whole_rows(const std::filesystem::path& path, Kind kind = Kind::kPlain) {
  const H5Reader file(path);
  const std::uint64_t count = file.shape("time").at(0);
  EXPECT_EQ(file.shape("words"), (std::vector<hsize_t>{count, 30, 40}));
  EXPECT_EQ(file.shape("labels"), (std::vector<hsize_t>{count, 30, 40}));
  EXPECT_TRUE(file.has("aside"));
  // No larger than a file written by HDF5 itself. Shuffled ascending numbers compress to almost nothing.
  const hsize_t all = count * (4 * kCells + 4);  // With a checksum of each row.
  EXPECT_EQ(file.storage("words"), kind == Kind::kPlain ? all : std::min(all, file.storage("words")));
  EXPECT_TRUE(kind == Kind::kPlain || file.storage("words") <= all / 2);
  for (const std::uint64_t number : {std::uint64_t{0}, count / 2, count - 1}) {
    if (number < count) {
      const Row row(number);
      EXPECT_EQ(file.row<std::uint32_t>("words", number), row.words) << number;
      EXPECT_EQ(file.row<std::uint16_t>("labels", number), row.labels) << number;
      EXPECT_EQ(file.row<double>("time", number).at(0), row.time) << number;
    }
  }
  return count;
}

inline std::filesystem::path place_for(const std::string& name) {
  const std::filesystem::path folder = process_folder() / ("growing_file_test_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder / "fls.h5";
}

}  // namespace insonify
