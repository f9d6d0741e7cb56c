// sdf_console_test.cpp -- libsdformat errors are captured for one thread and printed for the others.

#include "io/sdf/sdf_console.h"

#include <gmock/gmock.h>

#include <iostream>
#include <thread>

namespace insonify::sdf_console_test {
namespace {

TEST(SdfConsoleTest, KeepsWhatItsOwnThreadWrites) {
  testing::internal::CaptureStderr();
  {
    const SdfConsole console;
    std::cerr << "\033[1;33mWarning [Model.cc:174]\033[0m Twice.\n\033[1;33mWarning [Model.cc:174]\033[0m Twice.\n";
    std::cerr << "Error:   of somebody else\n\033[1;31mError [Param.cc:399]\033[0m " << 3 << " times\n";
    EXPECT_THAT(console.sentences(), testing::ElementsAre("Twice", "3 times"));
  }
  std::cerr << "after";
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "after");
}

TEST(SdfConsoleTest, LetsOtherThreadsWrite) {
  testing::internal::CaptureStderr();
  {
    const SdfConsole console;
    std::thread([] { std::cerr << "progress " << 7 << '\n'; }).join();
    EXPECT_TRUE(console.sentences().empty());
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "progress 7\n");
}

TEST(SdfConsoleTest, NestsInItself) {
  testing::internal::CaptureStderr();
  const SdfConsole outer;
  { const SdfConsole inner; }
  std::cerr << "\033[1;31mError [a.cc:1]\033[0m kept\n";
  EXPECT_THAT(outer.sentences(), testing::ElementsAre("kept"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace insonify::sdf_console_test
