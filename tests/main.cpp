// main.cpp -- the main function of all test programs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace {

// What ctest takes for a skipped test. Several cases may be one entry of ctest: a failure counts more than a skip.
constexpr int kSkipped = 77;

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  if (RUN_ALL_TESTS() != 0) {
    return 1;
  }
  const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
  if (tests.test_to_run_count() == 0) {
    std::fputs("no test has such a name\n", stderr);
    return 1;
  }
  return tests.skipped_test_count() > 0 ? kSkipped : 0;
}
