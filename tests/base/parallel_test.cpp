// parallel_test.cpp -- worker threads run every task once, share work and propagate exceptions.

#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "insonify/interrupted.h"

namespace insonify::parallel_test {
namespace {

using namespace std::chrono_literals;

TEST(WorkersTest, EveryTaskRunsOnce) {
  for (const int threads : {1, 2, 3, 16, 70}) {
    Workers workers(threads);
    for (const int tasks : {0, 1, 2, 7, 64, 1000}) {
      std::vector<std::atomic<int>> runs(tasks);
      std::atomic<bool> known = true;
      workers.for_each(tasks, [&](int task, int worker) {
        ++runs[task];
        known = known && worker >= 0 && worker < workers.count();
      });
      EXPECT_TRUE(known) << threads << " threads";
      for (int task = 0; task < tasks; ++task) {
        EXPECT_EQ(runs[task], 1) << "task " << task << " of " << tasks << ", " << threads << " threads";
      }
    }
  }
}

// Two tasks at a time never have the same worker.
TEST(WorkersTest, NoWorkerRunsTwoTasksAtATime) {
  Workers workers(4);
  std::vector<std::atomic<int>> busy(workers.count());
  std::atomic<bool> alone = true;
  workers.for_each(400, [&](int, int worker) {
    alone = alone && ++busy[worker] == 1;
    std::this_thread::sleep_for(20us);
    --busy[worker];
  });
  EXPECT_TRUE(alone);
}

// The first task of the first block takes as long as all others: another worker does them.
TEST(WorkersTest, IdleWorkersTakeTasksOfOthers) {
  Workers workers(2);
  constexpr int kTasks = 20;
  std::atomic<int> others = 0;
  std::atomic<bool> helped = false;
  workers.for_each(kTasks, [&](int task, int) {
    if (task > 0) {
      ++others;
      return;
    }
    for (int i = 0; i < 5000 && others < kTasks - 1; ++i) {
      std::this_thread::sleep_for(1ms);
    }
    helped = others == kTasks - 1;
  });
  EXPECT_TRUE(helped);
}

TEST(WorkersTest, TheFirstExceptionEndsTheWork) {
  for (const int threads : {1, 2, 8}) {
    Workers workers(threads);
    std::atomic<int> begun = 0;
    const auto run = [&] {
      workers.for_each(100000, [&](int, int) {
        ++begun;
        throw std::runtime_error("enough");
      });
    };
    EXPECT_THROW(run(), std::runtime_error);
    EXPECT_LE(begun, threads);
    std::atomic<int> after = 0;
    workers.for_each(10, [&](int, int) { ++after; });
    EXPECT_EQ(after, 10);
  }
}

// No task begins once a stop is asked for; the next call is as any other.
TEST(WorkersTest, EndEarlyWhenAskedTo) {
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    std::atomic<bool> asked = false;
    std::atomic<int> begun = 0;
    workers.stop_when(&asked);
    const auto stop_at_fifth = [&](int, int) { asked = asked || ++begun >= 5; };
    EXPECT_THROW(workers.for_each(1000, stop_at_fifth), Interrupted);
    EXPECT_LE(begun, 5 + threads);
    asked = false;
    begun = 0;
    workers.for_each(4, stop_at_fifth);
    EXPECT_EQ(begun, 4);
  }
}

}  // namespace
}  // namespace insonify::parallel_test
