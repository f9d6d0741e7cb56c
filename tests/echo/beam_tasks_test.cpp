// beam_tasks_test.cpp -- division of a fan's beams into tasks.

#include "echo/cpu/beam_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace insonify::beam_tasks_test {
namespace {

std::vector<int> cuts(int beams, int workers) {
  std::vector<int> first_beams = {7, 8, 9};
  cut_beams(beams, workers, first_beams);
  return first_beams;
}

TEST(BeamTasksTest, OneWorkerTakesWholeCacheLines) {
  EXPECT_EQ(cuts(64, 1), (std::vector{0, 16, 32, 48, 64}));
  EXPECT_EQ(cuts(40, 1), (std::vector{0, 16, 32, 40}));
  EXPECT_EQ(cuts(1, 1), (std::vector{0, 1}));
}

TEST(BeamTasksTest, EveryBlockEndsWithSmallTasks) {
  EXPECT_EQ(cuts(128, 2), (std::vector{0, 16, 32, 48, 56, 64, 80, 96, 112, 120, 128}));
}

TEST(BeamTasksTest, FewBeamsAmongManyWorkersAreCutFiner) {
  EXPECT_EQ(cuts(48, 2), (std::vector{0, 4, 8, 12, 16, 32, 36, 40, 44, 48}));
  EXPECT_EQ(cuts(18, 8), (std::vector{0, 4, 8, 12, 16, 18}));
  EXPECT_EQ(cuts(1, 8), (std::vector{0, 1}));
}

// For any numbers of beams and workers, tasks are in order, none is empty, and each begins at a packet boundary (see
// BeamTask::run).
TEST(BeamTasksTest, TasksCoverTheFan) {
  for (int beams = 1; beams < 300; beams += 7) {
    for (int workers = 1; workers < 70; ++workers) {
      const std::vector<int> first_beams = cuts(beams, workers);
      ASSERT_EQ(first_beams.front(), 0);
      ASSERT_EQ(first_beams.back(), beams);
      ASSERT_TRUE(std::ranges::adjacent_find(first_beams, std::greater_equal()) == first_beams.end());
      ASSERT_TRUE(std::all_of(first_beams.begin(), first_beams.end() - 1,
                              [](int beam) { return beam % kLeastBeamsTogether == 0; }));
    }
  }
}

}  // namespace
}  // namespace insonify::beam_tasks_test
