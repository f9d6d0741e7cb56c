// parallel.cpp -- worker threads on oneTBB.

#include "base/parallel.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

#include "insonify/error.h"
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

Workers::Workers(int threads)
    : count_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {
  if (threads < 0 || threads > kMost) {
    throw Error(fmt::format("threads = {} must be from 0 to {}", threads, kMost));
  }
  if (count_ > 1) {
    arena_ = std::make_unique<Arena>(count_);
    alone_.reset(new Workers(this));
  }
}

Workers::Workers(const Workers* many) : count_(1), many_(many) {}

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
  const auto run = [&](const tbb::blocked_range<int>& range) {
    for (int task = range.begin(); task < range.end(); ++task) {
      check_stop();
      function(body, task, tbb::this_task_arena::current_thread_index());
    }
  };
  arena_->arena.execute([&] { tbb::parallel_for(tbb::blocked_range<int>(0, tasks), run, tbb::simple_partitioner()); });
}

}  // namespace insonify
