// parallel.cpp -- worker threads on oneTBB.

#include "base/parallel.h"

#include <fmt/format.h>
#include <pthread.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

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

namespace {

// oneTBB starts threads when it needs them, and ends the program where the system refuses one. So as many as have not
// been seen to start are started here, all at once and with stacks as large as its own.
void try_to_start(int threads) {
  static std::atomic<int> known = 1;
  constexpr std::size_t kStack = std::size_t{4} << 20U;
  if (threads <= known) {
    return;
  }
  std::vector<pthread_t> started(static_cast<std::size_t>(threads));
  std::latch all_tried(1);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStack);
  const auto wait = [](void* latch) -> void* {
    static_cast<std::latch*>(latch)->wait();
    return nullptr;
  };
  std::size_t count = 0;
  int failure = 0;
  while (count < started.size() && failure == 0) {
    failure = pthread_create(&started[count], &attributes, wait, &all_tried);
    count += failure == 0 ? 1 : 0;
  }
  pthread_attr_destroy(&attributes);
  all_tried.count_down();
  for (std::size_t i = 0; i < count; ++i) {
    pthread_join(started[i], nullptr);
  }
  if (failure != 0) {
    throw Error(fmt::format("threads = {}: only {} can be started: {}", threads, count,
                            std::generic_category().message(failure)));
  }
  known = threads;
}

}  // namespace

Workers::Workers(int threads)
    : count_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {
  if (threads < 0 || threads > kMost) {
    throw Error(fmt::format("threads = {} must be from 0 to {}", threads, kMost));
  }
  if (count_ > 1) {
    try_to_start(count_);
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
