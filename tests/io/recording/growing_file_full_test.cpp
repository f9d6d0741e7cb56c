// growing_file_full_test.cpp -- a growing file says when the disk is full, and keeps what was written.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>

#include "io/growing_rows.h"
#include "support/message_of.h"

namespace insonify::growing_file_full_test {
namespace {

TEST(FullDiskTest, SaysWhenAFileMayNotGrowAndKeepsWhatWasWritten) {
  for (const Kind kind : kKinds) {
    const auto path = place_for("limit");
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

TEST(FullDiskTest, SaysWhenTheDiskIsFullAndKeepsWhatWasWritten) {
  const auto folder = place_for("disk").parent_path();
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

TEST(FullDiskTest, SaysWhenThereIsNoSpaceForAnEmptyFile) {
  const auto folder = place_for("small_disk").parent_path();
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

}  // namespace
}  // namespace insonify::growing_file_full_test
