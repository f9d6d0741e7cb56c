// parallel.cpp -- worker threads on oneTBB.

#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace insonify {

struct Workers::Arena {
  explicit Arena(int threads)
      : allowance(tbb::global_control::max_allowed_parallelism,
                  std::max<std::size_t>(threads, std::thread::hardware_concurrency())),
        arena(threads) {}

  tbb::global_control allowance;  // More threads than processors, when asked for.
  tbb::task_arena arena;
};

namespace {

// Tasks [0, tasks) in stretches, one for each worker.
class Stretches {
 public:
  Stretches(int tasks, int workers) : count_(std::min({tasks, workers, kMost})) {
    for (int i = 0; i < count_; ++i) {
      stretches_[i].next = start(tasks, i);
      stretches_[i].last = start(tasks, i + 1);
    }
  }

  [[nodiscard]] int count() const { return count_; }

  // The next of a worker's own stretch, or of another's when that is done; negative when all are.
  int take(int worker) {
    for (int i = 0; i < count_; ++i) {
      Stretch& stretch = stretches_[(worker + i) % count_];
      if (stretch.next < stretch.last) {
        if (const int task = stretch.next++; task < stretch.last) {
          return task;
        }
      }
    }
    return -1;
  }

  // Nobody begins another.
  void end() {
    for (int i = 0; i < count_; ++i) {
      stretches_[i].next = stretches_[i].last;
    }
  }

 private:
  static constexpr int kMost = 256;  // More workers than that have nothing to do.
  struct alignas(64) Stretch {
    std::atomic<int> next;
    int last;
  };

  [[nodiscard]] int start(int tasks, int stretch) const {
    return static_cast<int>(std::int64_t{tasks} * stretch / count_);
  }

  std::array<Stretch, kMost> stretches_;
  int count_;
};

}  // namespace

Workers::Workers(int threads)
    : count_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {
  arena_ = std::make_unique<Arena>(count_);
}

Workers::~Workers() = default;

void Workers::call(int tasks, Function function, void* body) {
  if (count_ == 1 || tasks == 1) {
    for (int task = 0; task < tasks; ++task) {
      function(body, task, 0);
    }
    return;
  }
  Stretches stretches(tasks, count_);
  const auto work = [&](int) {
    const int worker = tbb::this_task_arena::current_thread_index();
    try {
      for (int task = stretches.take(worker); task >= 0; task = stretches.take(worker)) {
        function(body, task, worker);
      }
    } catch (...) {
      stretches.end();
      throw;
    }
  };
  arena_->arena.execute([&] { tbb::parallel_for(0, stretches.count(), work, tbb::simple_partitioner()); });
}

}  // namespace insonify
