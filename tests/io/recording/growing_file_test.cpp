// growing_file_test.cpp -- a growing file holds every row, can be read by others while it grows, and replaces an older
// one only when it may.

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "io/growing_rows.h"
#include "io/recording/fletcher.h"
#include "support/message_of.h"

namespace insonify::growing_file_test {
namespace {

TEST(GrowingFileTest, HoldsEveryRowThatWasAdded) {
  for (const Kind kind : kKinds) {
    const auto path = place_for("rows");
    GrowingFile file = make_file(path, kind);
    EXPECT_EQ(whole_rows(path, kind), 0U);
    for (std::uint64_t number = 0; number < 150; ++number) {  // A node of the index holds 64.
      Row(number).append_to(file);
      EXPECT_EQ(whole_rows(path, kind), number + 1);
    }
    file.close();
    EXPECT_EQ(message_of([&] { Row(5).append_to(file); }), path.string() + ": cannot write: it is closed");
    EXPECT_EQ(whole_rows(path, kind), 150U);
  }
}

// Two levels of the index hold 64 x 64 = 4096 rows, each a chunk of its own.
TEST(GrowingFileTest, HoldsThousandsOfRows) {
  constexpr std::uint32_t kRows = 4096 + 130, kLength = 150;
  const auto path = place_for("thousands");
  {
    GrowingFile file(path, {{"words", H5T_STD_U32LE, {kLength}, true}}, [](hid_t) {});
    std::vector<std::uint32_t> words(kLength);
    for (std::uint32_t row = 0; row < kRows; ++row) {
      std::ranges::fill(words, row);
      const std::array rows = {std::as_bytes(std::span(words))};
      file.append(rows);
    }
  }
  const H5Reader file(path);
  const std::vector<std::uint32_t> words = file.values<std::uint32_t>("words");
  ASSERT_EQ(words.size(), std::size_t{kRows} * kLength);
  for (std::uint32_t row = 0; row < kRows; ++row) {
    EXPECT_EQ(words[std::size_t{row} * kLength + row % kLength], row);
  }
}

// Incompressible rows are stored as they are.
TEST(GrowingFileTest, HoldsNoiseUncompressed) {
  const auto path = place_for("noise");
  std::mt19937 random(1);
  std::vector<std::uint32_t> noise(1000);
  std::ranges::generate(noise, random);
  {
    GrowingFile file(path, {{"words", H5T_STD_U32LE, {1000}, true}}, [](hid_t) {});
    const std::array rows = {std::as_bytes(std::span(noise))};
    file.append(rows);
  }
  const H5Reader file(path);
  EXPECT_EQ(file.row<std::uint32_t>("words", 0), noise);
  EXPECT_EQ(file.storage("words"), 4004U);
}

TEST(GrowingFileTest, CanBeExtendedByHdf5Afterwards) {
  for (const Kind kind : kKinds) {
    for (const std::uint64_t rows : {0, 2, 64, 100}) {
      const auto path = place_for("extended");
      record(path, rows, kind);
      {
        const H5Handle file = h5_own(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, path, "open");
        H5Gclose(H5Gcreate2(file.get(), "added", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        for (std::uint64_t number = rows; number < rows + 100; ++number) {
          append_by_hdf5(file.get(), Row(number), number);
        }
      }
      EXPECT_EQ(whole_rows(path, kind), rows + 100);
      EXPECT_TRUE(H5Reader(path).has("added"));
    }
  }
}

// A copy visits every node of the index, as h5repack does.
TEST(GrowingFileTest, CanBeCopiedByHdf5) {
  for (const Kind kind : kKinds) {
    const auto path = place_for("copied"), copy = path.parent_path() / "copy.h5";
    record(path, 200, kind);
    {
      const H5Handle from = h5_open_to_read(path);
      const H5Handle to =
          h5_own(H5Fcreate(copy.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, copy, "create");
      for (const char* name : {"words", "labels", "time", "aside"}) {
        h5_check(H5Ocopy(from.get(), name, to.get(), name, H5P_DEFAULT, H5P_DEFAULT), copy, "copy");
      }
    }
    EXPECT_EQ(whole_rows(copy, kind), 200U);
  }
}

// HDF5 compares them as it reads. Rows of time share chunks, of which the last, with 3 rows, has its own when the file
// is closed.
TEST(GrowingFileTest, EveryChunkHasAChecksum) {
  constexpr std::uint64_t kTimes = 512, kRows = kTimes + 3;
  for (const Kind kind : kKinds) {
    const auto path = place_for("checksums");
    record(path, kRows, kind);
    std::ifstream in(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    for (const char* name : {"words", "labels", "time"}) {
      haddr_t address = 0;
      {
        const H5Reader file(path);
        const H5Handle data(H5Dopen2(file.id(), name, H5P_DEFAULT), H5Dclose);
        const H5Handle space(H5Dget_space(data.get()), H5Sclose);
        hsize_t chunks = 0, size = 0;
        H5Dget_num_chunks(data.get(), space.get(), &chunks);
        EXPECT_EQ(chunks, name == std::string("time") ? 2U : kRows);
        for (hsize_t i = 0; i < chunks; ++i) {
          unsigned skipped = 1;
          std::array<hsize_t, 3> start{};
          H5Dget_chunk_info(data.get(), space.get(), i, start.data(), &skipped, &address, &size);
          EXPECT_EQ(skipped, 0U) << name << i;
        }
      }
      std::string damaged = bytes;
      damaged[address + 1] = static_cast<char>(damaged[address + 1] ^ 4);
      std::ofstream(path, std::ios::binary) << damaged;
      const H5Reader file(path);
      const H5Quiet quiet;
      EXPECT_NE(message_of([&] { (void)file.row<double>(name, kRows - 1); }), "no error") << name;
      EXPECT_EQ(message_of([&] { (void)file.row<double>(name, 0); }), "no error") << name;
    }
  }
}

TEST(FletcherTest, IsThatOfHdf5) {
  std::mt19937 random(5);
  std::vector<std::byte> bytes;
  for (const std::size_t length : {1, 2, 3, 31, 32, 33, 719, 720, 721, 11520, 11521, 100'003}) {
    for (const int kind : {0, 1, 2}) {  // Zeros, ones, anything.
      bytes.resize(length);
      std::ranges::generate(bytes, [&] { return std::byte(kind == 0 ? 0 : kind == 1 ? 255 : random() & 255U); });
      // By the definition, with numbers that cannot overflow here.
      std::uint64_t first = 0, second = 0;
      for (std::size_t i = 0; i < length; i += 2) {
        first += std::to_integer<std::uint64_t>(bytes[i]) << 8U;
        first += i + 1 < length ? std::to_integer<std::uint64_t>(bytes[i + 1]) : 0;
        second += first;
      }
      const auto folded = [](std::uint64_t sum) { return sum == 0 ? 0 : (sum - 1) % 65535 + 1; };
      EXPECT_EQ(fletcher32(bytes), folded(second) << 16U | folded(first)) << length << " " << kind;
    }
  }
}

// Beside the rows there are about 70 kB made by HDF5, an index of a hundred bytes per chunk, the index node being
// filled, and the unused rest of the last 4096-byte block of times.
TEST(GrowingFileTest, IsAsLargeAsTheRowsItHolds) {
  const auto path = place_for("size");
  GrowingFile file = make_file(path);
  const auto empty = std::filesystem::file_size(path);
  EXPECT_LT(empty, 200'000U);
  const auto most = [&](std::uint64_t rows) { return empty + rows * (7208 + 2 * 2 * 64) + 30'000; };
  for (std::uint64_t number = 0; number < 300; ++number) {
    Row(number).append_to(file);
    struct stat status {};
    ASSERT_EQ(stat(path.c_str(), &status), 0);
    EXPECT_LT(static_cast<std::uint64_t>(status.st_blocks) * 512, most(number + 1) + 20'000) << number;
    EXPECT_LT(static_cast<std::uint64_t>(status.st_size), most(number + 1) + 150'000) << "with a hole at its end";
  }
  file.close();
  EXPECT_LT(std::filesystem::file_size(path), most(300));
}

// The reader opened the file before the rows were added that it then finds in its dataset.
TEST(GrowingFileTest, CanBeReadByOneThatOpenedItARowAgo) {
  const auto path = place_for("live");
  GrowingFile file = make_file(path);
  for (std::uint64_t number = 0; number < 100; ++number) {
    const H5Reader reader(path);
    Row(number).append_to(file);
    EXPECT_EQ(reader.row<std::uint32_t>("words", number), Row(number).words) << number;
  }
}

std::vector<std::string> files_beside(const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
    names.push_back(entry.path().filename());
  }
  return names;
}

TEST(GrowingFileTest, TakesThePlaceOfAnOlderFileOnceItIsClosed) {
  const auto path = place_for("replaced");
  record(path, 3);
  GrowingFile file = make_file(path, Kind::kPlain, true);
  for (std::uint64_t number = 0; number < 7; ++number) {
    Row(number).append_to(file);
  }
  EXPECT_EQ(whole_rows(path), 3U);
  EXPECT_EQ(whole_rows(file.place()), 7U);
  EXPECT_NE(file.place(), path);
  file.close();
  EXPECT_EQ(file.place(), path);
  EXPECT_EQ(whole_rows(path), 7U);
  EXPECT_EQ(files_beside(path), std::vector<std::string>{"fls.h5"});
}

TEST(GrowingFileTest, TakesNoOldersPlaceUnlessItMay) {
  const auto path = place_for("older");
  record(path, 3);
  EXPECT_EQ(message_of([&] { make_file(path); }), path.string() + ": cannot create: it exists already");
  EXPECT_EQ(whole_rows(path), 3U);
  EXPECT_EQ(files_beside(path), std::vector<std::string>{"fls.h5"});
}

TEST(GrowingFileTest, StaysBesideTheOlderFileIfItIsNotClosed) {
  const auto path = place_for("beside");
  record(path, 3);
  (void)make_file(path, Kind::kPlain, true);
  EXPECT_EQ(files_beside(path), std::vector<std::string>{"fls.h5"}) << "without a row it is of no use";
  std::filesystem::path beside;
  {
    GrowingFile file = make_file(path, Kind::kPlain, true);
    Row(0).append_to(file);
    beside = file.place();
  }
  EXPECT_EQ(whole_rows(path), 3U);
  EXPECT_EQ(whole_rows(beside), 1U);
}

TEST(GrowingFileTest, IsTheOnlyOneToReplaceAFile) {
  const auto path = place_for("only");
  record(path, 3);
  const GrowingFile first = make_file(path, Kind::kPlain, true);
  EXPECT_EQ(message_of([&] { make_file(path, Kind::kPlain, true); }),
            path.string() + ": cannot create: another run is writing it; choose another folder");
}

TEST(GrowingFileTest, LeavesTheOlderFileWhereANewOneCannotBeMade) {
  const auto path = place_for("kept");
  record(path, 3);
  const auto fail = [](hid_t) { throw Error("described badly"); };
  EXPECT_EQ(message_of([&] {
              GrowingFile(path, {{"time", H5T_IEEE_F64LE, {}}}, fail, {.replace = true});
            }),
            "described badly");
  EXPECT_EQ(whole_rows(path), 3U);
  EXPECT_EQ(files_beside(path), std::vector<std::string>{"fls.h5"});
}

TEST(GrowingFileTest, SaysWhyAFileCannotBeMade) {
  EXPECT_EQ(message_of([] { make_file("/nowhere/fls.h5"); }),
            "/nowhere/fls.h5: cannot create: No such file or directory");
  const auto path = place_for("folder");
  std::filesystem::create_directory(path);
  EXPECT_EQ(message_of([&] { make_file(path); }),
            path.string() + ": cannot create: it exists and is not a regular file");
  EXPECT_EQ(message_of([] { make_file("/dev/null"); }),
            "/dev/null: cannot create: it exists and is not a regular file");
  EXPECT_EQ(message_of([] { make_file("/proc/fls.h5"); }), "/proc/fls.h5: cannot create: No such file or directory");
}

}  // namespace
}  // namespace insonify::growing_file_test
