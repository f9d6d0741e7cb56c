// hdf5_test.cpp -- HDF5 failures become one-line Errors, and handles close what they own.

#include "io/file/hdf5.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify::hdf5_test {
namespace {

std::filesystem::path scratch(const std::string& name) {
  return process_folder() / name;
}

void open_to_read(const std::filesystem::path& path) {
  const H5Quiet quiet;
  const H5Handle file = h5_own(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path, "open it");
}

TEST(Hdf5Test, TellsTheSystemsReason) {
  EXPECT_EQ(message_of([] { open_to_read("/nowhere/grid.bag"); }),
            "/nowhere/grid.bag: cannot open it: No such file or directory");
}

TEST(Hdf5Test, TellsTheInnermostReason) {
  const std::filesystem::path path = scratch("hdf5_test_not_hdf5.bag");
  std::ofstream(path) << "certainly not a superblock";
  EXPECT_EQ(message_of([&] { open_to_read(path); }), path.string() + ": cannot open it: file signature not found");
}

TEST(Hdf5Test, PrintsNothingAndRestoresWhatPrinted) {
  H5E_auto2_t before = nullptr;
  H5E_auto2_t after = nullptr;
  void* data = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &before, &data);
  testing::internal::CaptureStderr();
  EXPECT_THROW(open_to_read("/nowhere/grid.bag"), Error);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  H5Eget_auto2(H5E_DEFAULT, &after, &data);
  EXPECT_EQ(before, after);
  EXPECT_NE(after, nullptr);
}

TEST(Hdf5Test, ClosesWhatItOwnsOnce) {
  const H5Handle first(H5Screate(H5S_SCALAR), H5Sclose);
  const hid_t id = first.get();
  {
    H5Handle second(H5Screate(H5S_SCALAR), H5Sclose);
    const hid_t other = second.get();
    H5Handle moved = std::move(second);
    EXPECT_EQ(H5Iis_valid(other), 1);
    moved.reset();
    EXPECT_EQ(H5Iis_valid(other), 0);
    EXPECT_FALSE(moved);
  }
  EXPECT_EQ(H5Iis_valid(id), 1);
}

}  // namespace
}  // namespace insonify::hdf5_test
