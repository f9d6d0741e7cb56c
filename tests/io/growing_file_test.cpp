// growing_file_test.cpp -- a growing file is whole at every moment: when its writer is killed, when the disk is full,
// when it takes the place of another.

#include "io/recording/growing_file.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <fstream>
#include <numeric>
#include <random>

#include "io/h5_read.h"

namespace insonify {
namespace {

// A ping of 30 x 40 cells. Every value tells the row and the cell it belongs to.
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

GrowingFile make_file(const std::filesystem::path& path, std::uint64_t capacity) {
  const auto describe = [](hid_t file) { H5Gclose(H5Gcreate2(file, "aside", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); };
  return {path,
          {{"words", H5T_STD_U32LE, {30, 40}}, {"labels", H5T_STD_U16LE, {30, 40}}, {"time", H5T_IEEE_F64LE, {}}},
          capacity,
          describe};
}

void record(const std::filesystem::path& path, std::uint64_t rows) {
  GrowingFile file = make_file(path, rows);
  for (std::uint64_t number = 0; number < rows; ++number) {
    Row(number).append_to(file);
  }
}

// Opens the file as anyone would and returns how many rows it has, having looked at the first, the last and one
// between.
std::uint64_t whole_rows(const std::filesystem::path& path) {
  const H5Reader file(path);
  const std::uint64_t count = file.shape("time").at(0);
  EXPECT_EQ(file.shape("words"), (std::vector<hsize_t>{count, 30, 40}));
  EXPECT_EQ(file.shape("labels"), (std::vector<hsize_t>{count, 30, 40}));
  EXPECT_TRUE(file.has("aside"));
  // No more than HDF5 itself would have given that many rows, and no address where there are none: HDF5 2.0 takes an
  // empty dataset that has one for a damaged one.
  EXPECT_EQ(file.storage("words").first, count * 4 * kCells);
  EXPECT_EQ(file.storage("words").second == HADDR_UNDEF, count == 0);
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
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("growing_file_test_" + name);
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
  const auto path = scratch("rows");
  GrowingFile file = make_file(path, 5);
  EXPECT_EQ(whole_rows(path), 0U);
  for (std::uint64_t number = 0; number < 5; ++number) {
    Row(number).append_to(file);
    EXPECT_EQ(whole_rows(path), number + 1);
  }
  EXPECT_EQ(message_of([&] { Row(5).append_to(file); }),
            path.string() + ": cannot write ping 5: the file was made for 5");
  file.close();
  EXPECT_EQ(message_of([&] { Row(5).append_to(file); }), path.string() + ": cannot write: it is closed");
  EXPECT_EQ(whole_rows(path), 5U);
}

TEST(GrowingFileTest, CanBeExtendedAndRewrittenByHdf5Afterwards) {
  const auto path = scratch("rewritten");
  {
    GrowingFile file = make_file(path, 50);
    Row(0).append_to(file);
    Row(1).append_to(file);
  }
  {
    const H5Handle file = h5_own(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, path, "open");
    H5Gclose(H5Gcreate2(file.get(), "added", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  EXPECT_EQ(whole_rows(path), 2U);
  EXPECT_TRUE(H5Reader(path).has("added"));
}

TEST(GrowingFileTest, TakesDiskSpaceOnlyAsRowsCome) {
  const auto path = scratch("sparse");
  GrowingFile file = make_file(path, 1'000'000);  // 7.2 GB.
  Row(0).append_to(file);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_GT(status.st_size, 7'000'000'000);
  EXPECT_LT(status.st_blocks * 512, 1'000'000);
}

// ---- Killed --------------------------------------------------------------------------------------------------------

// What a writer tells while it lives; in memory shared with it.
struct Progress {
  std::atomic<std::uint64_t> started{0}, added{0};
};

TEST(GrowingFileTest, IsWholeWheneverItsWriterIsKilled) {
  constexpr int kKills = 60;
  constexpr std::uint64_t kCapacity = 3'000'000;  // Cells still fit 32 bits.
  const auto path = scratch("killed");
  record(path, 3);  // Something to be replaced, so that there is always a file.
  void* shared = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  std::mt19937 random(20240607);
  int killed_while_recording = 0;
  for (int kill_number = 0; kill_number < kKills; ++kill_number) {
    auto* progress = new (shared) Progress;
    const std::uint64_t rows_before = random() % 8 == 0 ? 0 : random() % 200;  // Some die while the file is being made.
    const auto moment = static_cast<useconds_t>(random() % 2000);
    const pid_t writer = fork();
    ASSERT_GE(writer, 0);
    if (writer == 0) {
      GrowingFile file = make_file(path, kCapacity);
      Row row(0);
      for (std::uint64_t number = 0; number < kCapacity; ++number) {
        row.set(number);
        progress->started = number + 1;
        row.append_to(file);
        progress->added = number + 1;
      }
      _exit(0);
    }
    while (progress->started < rows_before) {
      usleep(50);
    }
    usleep(moment);
    kill(writer, SIGKILL);
    int status = 0;
    waitpid(writer, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";

    const std::uint64_t rows = whole_rows(path);
    if (progress->started > 0) {
      EXPECT_GE(rows, progress->added);
      EXPECT_LE(rows, progress->started);
      ++killed_while_recording;
    }
    ASSERT_FALSE(HasFailure()) << "kill " << kill_number << " after " << progress->added << " rows";
  }
  munmap(shared, sizeof(Progress));
  EXPECT_GT(killed_while_recording, kKills / 2);
}

// ---- Full ----------------------------------------------------------------------------------------------------------

TEST(GrowingFileTest, SaysWhenAFileMayNotGrowAndKeepsWhatWasWritten) {
  const auto path = scratch("limit");
  GrowingFile file = make_file(path, 100);
  // `words` lie first in the file: 65536 bytes may hold some of the 4800-byte rows, never all.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{.rlim_cur = 65536 + 20'000, .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::uint64_t added = 0;
  const std::string message = message_of([&] {
    for (; added < 100; ++added) {
      Row(added).append_to(file);
    }
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(message, path.string() + ": cannot write ping " + std::to_string(added) +
                         ": File too large; those before it stay readable");
  EXPECT_EQ(whole_rows(path), added);
  // With room again it goes on where it stopped.
  Row(added).append_to(file);
  EXPECT_EQ(whole_rows(path), added + 1);
}

TEST(GrowingFileTest, SaysWhenTheDiskIsFullAndKeepsWhatWasWritten) {
  const auto folder = scratch("disk").parent_path();
  if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("none", folder.c_str(), "tmpfs", 0, "size=1m") != 0) {
    GTEST_SKIP() << "a small disk can only be made by root";
  }
  const auto path = folder / "fls.h5";
  {
    GrowingFile file = make_file(path, 10'000);
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
                GrowingFile(path, {{"time", H5T_IEEE_F64LE, {}}}, 100, describe);
              }),
              path.string() + ": cannot create: No space left on device");
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << size;
    EXPECT_EQ(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0) << "HDF5 would fail at the end of the program";
    umount2(folder.c_str(), MNT_DETACH);
  }
}

// ---- Made, or not --------------------------------------------------------------------------------------------------

std::vector<std::string> files_beside(const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
    names.push_back(entry.path().filename());
  }
  return names;
}

TEST(GrowingFileTest, TakesThePlaceOfAnOlderFile) {
  const auto path = scratch("replaced");
  record(path, 3);
  record(path, 7);
  EXPECT_EQ(whole_rows(path), 7U);
  EXPECT_EQ(files_beside(path), std::vector<std::string>{"fls.h5"});
}

TEST(GrowingFileTest, LeavesTheOlderFileWhereANewOneCannotBeMade) {
  const auto path = scratch("kept");
  record(path, 3);
  const auto fail = [](hid_t) { throw Error("described badly"); };
  EXPECT_EQ(message_of([&] { GrowingFile(path, {{"time", H5T_IEEE_F64LE, {}}}, 1, fail); }), "described badly");
  EXPECT_EQ(whole_rows(path), 3U);
  EXPECT_EQ(files_beside(path), std::vector<std::string>{"fls.h5"});
}

TEST(GrowingFileTest, SaysWhyAFileCannotBeMade) {
  EXPECT_EQ(message_of([] { make_file("/nowhere/fls.h5", 1); }),
            "/nowhere/fls.h5: cannot create: No such file or directory");
  const auto path = scratch("folder");
  std::filesystem::create_directory(path);
  EXPECT_EQ(message_of([&] { make_file(path, 1); }),
            path.string() + ": cannot create: it is there and is no regular file");
  EXPECT_EQ(message_of([] { make_file("/dev/null", 1); }),
            "/dev/null: cannot create: it is there and is no regular file");
  EXPECT_EQ(message_of([] { make_file("/proc/fls.h5", 1); }), "/proc/fls.h5: cannot create: No such file or directory");
}

TEST(GrowingFileTest, RefusesMoreThanAFileCanHold) {
  // 1200 x 4 + 1200 x 2 + 8 = 7208 bytes a row; 2^62 / 7208 = 639801056940536.8
  const auto path = scratch("huge");
  EXPECT_EQ(message_of([&] { make_file(path, 639'801'056'940'537); }),
            path.string() + ": cannot hold 639801056940537 pings of 7208 bytes, at most 639801056940536");
  // Few file systems take 4.6 EB.
  EXPECT_EQ(message_of([&] { make_file(path, 639'801'056'940'536); }),
            path.string() + ": cannot make room for 4611686018427383488 bytes: File too large");
  EXPECT_EQ(files_beside(path), std::vector<std::string>{});
}

}  // namespace
}  // namespace insonify
