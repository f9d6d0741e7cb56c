// growing_file_test.cpp -- a growing file is valid at every moment: when its writer is killed, when the disk is full,
// when it replaces another.

#include "io/recording/growing_file.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <fstream>
#include <numeric>
#include <random>

#include "io/h5_read.h"
#include "support/test_files.h"

namespace insonify {
namespace {

// A ping of 30 x 40 cells. Every value encodes its row and its cell.
constexpr std::size_t kCells = 30 * 40;

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
constexpr Kind kKinds[] = {Kind::kPlain, Kind::kCompressed};

GrowingFile make_file(const std::filesystem::path& path, Kind kind = Kind::kPlain, bool replace = false) {
  const auto describe = [](hid_t file) { H5Gclose(H5Gcreate2(file, "aside", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); };
  const bool compress = kind == Kind::kCompressed;
  return {path,
          {{"words", H5T_STD_U32LE, {30, 40}, compress},
           {"labels", H5T_STD_U16LE, {30, 40}, compress},
           {"time", H5T_IEEE_F64LE, {}, compress}},
          describe,
          {.replace = replace}};
}

void record(const std::filesystem::path& path, std::uint64_t rows, Kind kind = Kind::kPlain) {
  GrowingFile file = make_file(path, kind, true);
  for (std::uint64_t number = 0; number < rows; ++number) {
    Row(number).append_to(file);
  }
  file.close();
}

// Adds a row to all datasets through HDF5, as any other program would.
void append_by_hdf5(hid_t file, const Row& row, hsize_t number) {
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

// Opens the file through HDF5 and returns its number of rows. Checks the first, the last and one between.
std::uint64_t whole_rows(const std::filesystem::path& path, Kind kind = Kind::kPlain) {
  const H5Reader file(path);
  const std::uint64_t count = file.shape("time").at(0);
  EXPECT_EQ(file.shape("words"), (std::vector<hsize_t>{count, 30, 40}));
  EXPECT_EQ(file.shape("labels"), (std::vector<hsize_t>{count, 30, 40}));
  EXPECT_TRUE(file.has("aside"));
  // No larger than a file written by HDF5 itself. Shuffled ascending numbers compress to almost nothing.
  const hsize_t all = count * 4 * kCells;
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

std::filesystem::path scratch(const std::string& name) {
  const std::filesystem::path folder = process_folder() / ("growing_file_test_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder / "fls.h5";
}

template <typename Act>
std::string message_of(Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no Error";
}

TEST(GrowingFileTest, HoldsEveryRowThatWasAdded) {
  for (const Kind kind : kKinds) {
    const auto path = scratch("rows");
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
  const auto path = scratch("thousands");
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
  const auto path = scratch("noise");
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
  EXPECT_EQ(file.storage("words"), 4000U);
}

TEST(GrowingFileTest, CanBeExtendedByHdf5Afterwards) {
  for (const Kind kind : kKinds) {
    for (const std::uint64_t rows : {0, 2, 64, 100}) {
      const auto path = scratch("extended");
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
    const auto path = scratch("copied"), copy = path.parent_path() / "copy.h5";
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

// Beside the rows there are about 70 kB made by HDF5, an index of a hundred bytes per chunk, the index node being
// filled, and the unused rest of the last 4096-byte block of times.
TEST(GrowingFileTest, IsAsLargeAsTheRowsItHolds) {
  const auto path = scratch("size");
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
  const auto path = scratch("live");
  GrowingFile file = make_file(path);
  for (std::uint64_t number = 0; number < 100; ++number) {
    const H5Reader reader(path);
    Row(number).append_to(file);
    EXPECT_EQ(reader.row<std::uint32_t>("words", number), Row(number).words) << number;
  }
}

// ---- Killed --------------------------------------------------------------------------------------------------------

// Progress of a writer process, in memory shared with it.
struct Progress {
  std::atomic<std::uint64_t> started{0}, added{0};
};

// Runs a writer in a process of its own, and kills it some microseconds after it has begun a given number of rows.
template <typename Write>
void write_and_kill(Progress& progress, std::uint64_t rows_before, useconds_t moment, const Write& write) {
  const pid_t writer = fork();
  ASSERT_GE(writer, 0);
  if (writer == 0) {
    write();
    _exit(0);
  }
  while (progress.started < rows_before) {
    usleep(50);
  }
  usleep(moment);
  kill(writer, SIGKILL);
  int status = 0;
  waitpid(writer, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
}

class KilledTest : public testing::TestWithParam<Kind> {
 protected:
  KilledTest() {
    void* shared = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    EXPECT_NE(shared, MAP_FAILED);
    progress_ = new (shared) Progress;
  }
  ~KilledTest() override { munmap(progress_, sizeof(Progress)); }

  Progress* progress_;
};
INSTANTIATE_TEST_SUITE_P(Kinds, KilledTest, testing::ValuesIn(kKinds), [](const auto& test) {
  return std::string(test.param == Kind::kPlain ? "Plain" : "Compressed");
});

TEST_P(KilledTest, FileIsWholeWheneverItsWriterIsKilled) {
  constexpr int kKills = 60;
  constexpr std::uint64_t kMost = 3'000'000;  // Cells still fit 32 bits.
  const std::string folder = GetParam() == Kind::kPlain ? "killed" : "killed_compressed";
  std::mt19937 random(20240607);
  int killed_while_recording = 0;
  for (int kill_number = 0; kill_number < kKills; ++kill_number) {
    const auto path = scratch(folder);
    progress_->started = progress_->added = 0;
    const std::uint64_t rows_before =
        random() % 8 == 0 ? 0 : random() % 200;  // Some writers die while the file is being created.
    const auto moment = static_cast<useconds_t>(random() % 2000);
    write_and_kill(*progress_, rows_before, moment, [&] {
      GrowingFile file = make_file(path, GetParam());
      Row row(0);
      for (std::uint64_t number = 0; number < kMost; ++number) {
        row.set(number);
        progress_->started = number + 1;
        row.append_to(file);
        progress_->added = number + 1;
      }
    });
    const bool is_there = std::filesystem::exists(path);
    EXPECT_TRUE(is_there || progress_->started == 0);
    if (is_there) {
      const std::uint64_t rows = whole_rows(path, GetParam());
      EXPECT_GE(rows, progress_->added);
      EXPECT_LE(rows, progress_->started);
      // No larger than its contents and the hole at its end.
      EXPECT_LT(std::filesystem::file_size(path), 300'000 + (rows + 1) * (7208 + 2 * 2 * 64));
      ++killed_while_recording;
    }
    ASSERT_FALSE(HasFailure()) << "kill " << kill_number << " after " << progress_->added << " rows";
  }
  EXPECT_GT(killed_while_recording, kKills / 2);
}

// An existing file stays; new rows are in a file beside it.
TEST_P(KilledTest, EarlierFileStaysWheneverTheWriterOfTheNextIsKilled) {
  const std::string folder = GetParam() == Kind::kPlain ? "killed_over" : "killed_over_compressed";
  std::mt19937 random(8);
  for (int kill_number = 0; kill_number < 30; ++kill_number) {
    const auto path = scratch(folder);
    record(path, 3, GetParam());
    progress_->started = progress_->added = 0;
    write_and_kill(*progress_, random() % 50, static_cast<useconds_t>(random() % 2000), [&] {
      GrowingFile file = make_file(path, GetParam(), true);
      for (std::uint64_t number = 0;; ++number) {
        progress_->started = number + 1;
        Row(number).append_to(file);
        progress_->added = number + 1;
      }
    });
    EXPECT_EQ(whole_rows(path, GetParam()), 3U);
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
      if (entry.path() != path && progress_->started > 0) {
        EXPECT_GE(whole_rows(entry.path(), GetParam()), progress_->added);
      }
    }
    ASSERT_FALSE(HasFailure()) << "kill " << kill_number;
  }
}

// Consecutive recordings of a few rows, some killed while the last one is being closed. Each replaces the one before,
// or takes a free path and is readable there while it grows.
TEST_P(KilledTest, FileIsWholeWhileItIsBeingClosed) {
  constexpr int kKills = 40;
  const auto path = scratch(GetParam() == Kind::kPlain ? "closing" : "closing_compressed");
  record(path, 66, GetParam());
  std::mt19937 random(7);
  for (int kill_number = 0; kill_number < kKills; ++kill_number) {
    progress_->started = 0;
    const bool replace = kill_number % 2 == 0;
    write_and_kill(*progress_, 66 + random() % 100, static_cast<useconds_t>(random() % 3000), [&] {
      for (;;) {
        if (!replace) {
          std::filesystem::remove(path);
        }
        GrowingFile file = make_file(path, GetParam(), replace);
        for (std::uint64_t number = 0; number < 66; ++number) {  // Two nodes of the index: closing links them.
          Row(number).append_to(file);
          ++progress_->started;
        }
        file.close();
      }
    });
    if (std::filesystem::exists(path)) {
      const std::uint64_t rows = whole_rows(path, GetParam());
      EXPECT_TRUE(replace ? rows == 66 : rows <= 66) << rows;
    } else {
      EXPECT_FALSE(replace);
      record(path, 66, GetParam());
    }
    ASSERT_FALSE(HasFailure()) << "kill " << kill_number;
  }
}

// ---- Full ----------------------------------------------------------------------------------------------------------

TEST(GrowingFileTest, SaysWhenAFileMayNotGrowAndKeepsWhatWasWritten) {
  for (const Kind kind : kKinds) {
    const auto path = scratch("limit");
    GrowingFile file = make_file(path, kind);
    const auto empty = std::filesystem::file_size(path);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{.rlim_cur = empty + 60'000, .rlim_max = before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    std::uint64_t added = 0;
    const std::string message = message_of([&] {
      for (; added < 2000; ++added) {
        Row(added).append_to(file);
      }
    });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_EQ(message, path.string() + ": cannot write ping " + std::to_string(added) +
                           ": File too large; those before it stay readable");
    EXPECT_EQ(whole_rows(path, kind), added);
    EXPECT_LE(std::filesystem::file_size(path), empty + 60'000);
    // Once there is room again it continues where it stopped.
    for (int more = 0; more < 100; ++more, ++added) {
      Row(added).append_to(file);
    }
    EXPECT_EQ(whole_rows(path, kind), added);
  }
}

TEST(GrowingFileTest, SaysWhenTheDiskIsFullAndKeepsWhatWasWritten) {
  const auto folder = scratch("disk").parent_path();
  if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("none", folder.c_str(), "tmpfs", 0, "size=1m") != 0) {
    GTEST_SKIP() << "a small disk can only be made by root";
  }
  const auto path = folder / "fls.h5";
  {
    GrowingFile file = make_file(path);
    std::uint64_t added = 0;
    const std::string message = message_of([&] {
      for (; added < 10'000; ++added) {
        Row(added).append_to(file);
      }
    });
    EXPECT_EQ(message, path.string() + ": cannot write ping " + std::to_string(added) +
                           ": No space left on device; those before it stay readable");
    EXPECT_GT(added, 100U);  // 7208 bytes each: 1 MiB holds about 130 beside what HDF5 takes.
    EXPECT_EQ(whole_rows(path), added);
  }
  umount2(folder.c_str(), MNT_DETACH);
}

TEST(GrowingFileTest, SaysWhenThereIsNoSpaceForAnEmptyFile) {
  const auto folder = scratch("small_disk").parent_path();
  for (const char* size : {"size=4k", "size=8k", "size=20k", "size=40k"}) {
    if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("none", folder.c_str(), "tmpfs", 0, size) != 0) {
      GTEST_SKIP() << "a small disk can only be made by root";
    }
    const auto path = folder / "fls.h5";
    // 10 000 doubles, 80 kB, beside the rows.
    const auto describe = [](hid_t file) {
      const hsize_t length = 10'000;
      const std::vector<double> values(length, 1.5);
      const H5Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
      const H5Handle set(H5Dcreate2(file, "aside", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Dclose);
      H5Dwrite(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    };
    EXPECT_EQ(message_of([&] {
                GrowingFile(path, {{"time", H5T_IEEE_F64LE, {}}}, describe);
              }),
              path.string() + ": cannot create: No space left on device");
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << size;
    EXPECT_EQ(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0) << "HDF5 would fail at the end of the program";
    umount2(folder.c_str(), MNT_DETACH);
  }
}

// ---- Created or refused --------------------------------------------------------------------------------------------

std::vector<std::string> files_beside(const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
    names.push_back(entry.path().filename());
  }
  return names;
}

TEST(GrowingFileTest, TakesThePlaceOfAnOlderFileOnceItIsClosed) {
  const auto path = scratch("replaced");
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
  const auto path = scratch("older");
  record(path, 3);
  EXPECT_EQ(message_of([&] { make_file(path); }), path.string() + ": cannot create: it is there already");
  EXPECT_EQ(whole_rows(path), 3U);
  EXPECT_EQ(files_beside(path), std::vector<std::string>{"fls.h5"});
}

TEST(GrowingFileTest, StaysBesideTheOlderFileIfItIsNotClosed) {
  const auto path = scratch("beside");
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
  const auto path = scratch("only");
  record(path, 3);
  const GrowingFile first = make_file(path, Kind::kPlain, true);
  EXPECT_EQ(message_of([&] { make_file(path, Kind::kPlain, true); }),
            path.string() + ": cannot create: another run is writing it; choose another folder");
}

TEST(GrowingFileTest, LeavesTheOlderFileWhereANewOneCannotBeMade) {
  const auto path = scratch("kept");
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
  const auto path = scratch("folder");
  std::filesystem::create_directory(path);
  EXPECT_EQ(message_of([&] { make_file(path); }),
            path.string() + ": cannot create: it is there and is no regular file");
  EXPECT_EQ(message_of([] { make_file("/dev/null"); }), "/dev/null: cannot create: it is there and is no regular file");
  EXPECT_EQ(message_of([] { make_file("/proc/fls.h5"); }), "/proc/fls.h5: cannot create: No such file or directory");
}

}  // namespace
}  // namespace insonify
