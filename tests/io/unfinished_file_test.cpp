// unfinished_file_test.cpp -- a file is newly created, whatever exists beside it, and moved into place complete or not
// at all.

#include "io/file/unfinished_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::unfinished_file_test {
namespace {

std::size_t files_here() {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("."), {}));
}

TEST(UnfinishedFileTest, IsBesideItsPathUntilItIsPutInPlace) {
  const WorkingFolder folder;
  folder.write("a", "older");
  {
    UnfinishedFile file("a", "cannot create");
    EXPECT_EQ(write(file.descriptor(), "newer!", 6), 6);
    EXPECT_EQ(std::filesystem::file_size("a"), 5U);
    EXPECT_EQ(files_here(), 2U);
    file.put_in_place();
  }
  EXPECT_EQ(std::filesystem::file_size("a"), 6U);
  EXPECT_EQ(files_here(), 1U);
}

TEST(UnfinishedFileTest, IsRemovedWhereItWasNotPutInPlace) {
  const WorkingFolder folder;
  { const UnfinishedFile file("a", "cannot create"); }
  EXPECT_EQ(files_here(), 0U);
}

TEST(UnfinishedFileTest, TwoForOnePathDoNotMeet) {
  const WorkingFolder folder;
  UnfinishedFile one("a", "cannot create"), other("a", "cannot create");
  EXPECT_EQ(write(one.descriptor(), "1", 1), 1);
  EXPECT_EQ(write(other.descriptor(), "22", 2), 2);
  one.put_in_place();
  EXPECT_EQ(std::filesystem::file_size("a"), 1U);
  other.put_in_place();
  EXPECT_EQ(std::filesystem::file_size("a"), 2U);
}

TEST(UnfinishedFileTest, ALinkInItsPlaceIsReplacedAndNotFollowed) {
  const WorkingFolder folder;
  folder.write("target", "precious");
  std::filesystem::create_symlink("target", "a");
  UnfinishedFile file("a", "cannot create");
  file.put_in_place();
  EXPECT_FALSE(std::filesystem::is_symlink("a"));
  EXPECT_EQ(std::filesystem::file_size("target"), 8U);
}

TEST(UnfinishedFileTest, AReadOnlyFileStays) {
  const WorkingFolder folder;
  folder.write("a", "precious");
  std::filesystem::permissions("a", std::filesystem::perms::owner_read);
  EXPECT_EQ(message_of([] { const UnfinishedFile file("a", "cannot create"); }),
            "a: cannot create: it exists and is read-only");
  EXPECT_EQ(files_here(), 1U);
}

TEST(UnfinishedFileTest, SaysWhyThereCanBeNone) {
  const WorkingFolder folder;
  std::filesystem::create_directory("b");
  EXPECT_EQ(message_of([] { UnfinishedFile("nowhere/a", "cannot create"); }),
            "nowhere/a: cannot create: No such file or directory");
  EXPECT_EQ(message_of([] { UnfinishedFile("b", "cannot create"); }),
            "b: cannot create: it exists and is not a regular file");
}

}  // namespace
}  // namespace insonify::unfinished_file_test
