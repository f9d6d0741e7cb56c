#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>

#include <csignal>

#include "insonify/error.h"
#include "insonify/files.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::write_png_test {
namespace {

Picture gradient(int width, int height) {
  Picture picture{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) {
    picture.rgb.push_back(static_cast<std::uint8_t>(i * 7 % 256));
  }
  return picture;
}

TEST(WritePngTest, TheFileHoldsThePixels) {
  const WorkingFolder folder;
  const Picture picture = gradient(37, 21);
  write_png(folder.path() / "a.png", picture);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, (folder.path() / "a.png").c_str()), 0);
  EXPECT_EQ(image.width, 37U);
  EXPECT_EQ(image.height, 21U);
  EXPECT_EQ(image.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr), 0);
  EXPECT_EQ(read, picture.rgb);
}

TEST(WritePngTest, SaysWhichFileCannotBeWrittenAndWhy) {
  EXPECT_EQ(message_of([] { write_png("/no/such/folder/a.png", gradient(2, 2)); }),
            "/no/such/folder/a.png: cannot write the picture: No such file or directory");
  const WorkingFolder folder;
  EXPECT_EQ(message_of([&] { write_png(folder.path(), gradient(2, 2)); }),
            folder.path().string() + ": cannot write the picture: it exists and is not a regular file");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path()));
  EXPECT_EQ(message_of([] { write_png("/dev/full", gradient(2, 2)); }),
            "/dev/full: cannot write the picture: it exists and is not a regular file");
}

// A limit on the size of files stands in for a full disk.
TEST(WritePngTest, AFullDiskIsAnErrorAndLeavesWhatWasThere) {
  const WorkingFolder folder;
  folder.write("a.png", "an older picture");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = message_of([] { write_png("a.png", gradient(300, 200)); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message, "a.png: cannot write the picture: File too large");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator("."), {}), 1);
  EXPECT_EQ(std::filesystem::file_size("a.png"), std::string("an older picture").size());
}

TEST(WritePngTest, FollowsNoLink) {
  const WorkingFolder folder;
  const std::string precious = "precious";
  folder.write("target", precious);
  std::filesystem::create_symlink("target", "a.png");
  std::filesystem::create_symlink("target", "a.png.new");
  write_png("a.png", gradient(4, 3));
  EXPECT_FALSE(std::filesystem::is_symlink("a.png"));
  EXPECT_EQ(std::filesystem::file_size("target"), precious.size());
  EXPECT_TRUE(std::filesystem::is_symlink("a.png.new"));
}

TEST(WritePngTest, RefusesPicturesThatAreNotWhole) {
  Picture picture = gradient(4, 3);
  picture.rgb.pop_back();
  EXPECT_EQ(message_of([&] { write_png("x.png", picture); }),
            "x.png: a picture of 4 x 3 pixels must have at least one pixel and 3 bytes for each, not 35");
  EXPECT_EQ(message_of([] { write_png("x.png", Picture{}); }),
            "x.png: a picture of 0 x 0 pixels must have at least one pixel and 3 bytes for each, not 0");
}

}  // namespace
}  // namespace insonify::write_png_test
