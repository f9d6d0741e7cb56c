// parallel.cpp -- worker threads on oneTBB, with tasks divided into one block per worker.

#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "insonify/interrupted.h"

namespace insonify {

struct Workers::Arena {
  explicit Arena(int threads)
      : allowance(tbb::global_control::max_allowed_parallelism,
                  std::max<std::size_t>(threads, std::thread::hardware_concurrency())),
        arena(threads) {}

  tbb::global_control allowance;  // Permits more threads than processors, if asked for.
  tbb::task_arena arena;
};

namespace {

// Divides the tasks [0, tasks) into contiguous blocks, one per worker.
class Blocks {
 public:
  Blocks(int tasks, int workers) : count_(std::min({tasks, workers, kMost})) {
    for (int i = 0; i < count_; ++i) {
      blocks_[i].next = start(tasks, i);
      blocks_[i].last = start(tasks, i + 1);
    }
  }

  [[nodiscard]] int count() const { return count_; }

  // Returns the next task of the worker's own block or, when that is empty, of another worker's; negative when all
  // blocks are empty.
  int take(int worker) {
    for (int i = 0; i < count_; ++i) {
      Block& block = blocks_[(worker + i) % count_];
      if (block.next < block.last) {
        if (const int task = block.next++; task < block.last) {
          return task;
        }
      }
    }
    return -1;
  }

  // Empties all blocks, so that no further task begins.
  void end() {
    for (int i = 0; i < count_; ++i) {
      blocks_[i].next = blocks_[i].last;
    }
  }

 private:
  static constexpr int kMost = 256;  // Workers beyond this number get no tasks.
  struct alignas(64) Block {
    std::atomic<int> next;
    int last;
  };

  [[nodiscard]] int start(int tasks, int block) const { return static_cast<int>(std::int64_t{tasks} * block / count_); }

  std::array<Block, kMost> blocks_;
  int count_;
};

}  // namespace

Workers::Workers(int threads)
    : count_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {
  arena_ = std::make_unique<Arena>(count_);
}

Workers::~Workers() = default;

void Workers::throw_interrupted() {
  throw Interrupted();
}

void Workers::call(int tasks, Function function, void* body) {
  if (count_ == 1 || tasks <= 1) {
    for (int task = 0; task < tasks; ++task) {
      check_stop();
      function(body, task, 0);
    }
    return;
  }
  Blocks blocks(tasks, count_);
  const auto work = [&](int) {
    const int worker = tbb::this_task_arena::current_thread_index();
    try {
      for (int task = blocks.take(worker); task >= 0; task = blocks.take(worker)) {
        check_stop();
        function(body, task, worker);
      }
    } catch (...) {
      blocks.end();
      throw;
    }
  };
  arena_->arena.execute([&] { tbb::parallel_for(0, blocks.count(), work, tbb::simple_partitioner()); });
}

}  // namespace insonify
