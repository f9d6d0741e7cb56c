// parallel.h -- worker threads that run numbered tasks in parallel. The only file that exposes oneTBB.

#pragma once

#include <atomic>
#include <memory>
#include <type_traits>

namespace insonify {

/// A fixed number of worker threads. Tasks must not depend on which worker runs them; then results do not depend on the
/// number of workers. Running tasks allocates nothing once the threads have been started.
class Workers {
 public:
  /// @param threads  >= 1, or 0 for as many as there are processors.
  explicit Workers(int threads);
  ~Workers();

  [[nodiscard]] int count() const { return count_; }

  /// While `*asked` is true, for_each() throws Interrupted, also one that is running, before its next task. Null:
  /// never.
  void stop_when(const std::atomic<bool>* asked) { stop_asked_ = asked; }

  /// For tasks that take long: the same between two parts of a task.
  /// @throws Interrupted
  void check_stop() const {
    if (stop_asked_ != nullptr && stop_asked_->load(std::memory_order_relaxed)) {
      throw_interrupted();
    }
  }

  /// Calls run(task, worker) for every task in [0, tasks), worker in [0, count()). Returns when all are done; rethrows
  /// the first exception, after which no other task begins.
  ///
  /// The tasks are halved again and again, down to one; a worker without tasks takes half of another's. Two workers
  /// begin with one half each. Idle time at the end is short if the last tasks of each half are small.
  template <typename Run>
  void for_each(int tasks, Run&& run) {
    using Body = std::remove_reference_t<Run>;
    call(
        tasks, [](void* body, int task, int worker) { (*static_cast<Body*>(body))(task, worker); },
        const_cast<void*>(static_cast<const void*>(&run)));
  }

 private:
  using Function = void (*)(void* body, int task, int worker);
  void call(int tasks, Function function, void* body);
  [[noreturn]] static void throw_interrupted();

  struct Arena;
  std::unique_ptr<Arena> arena_;
  int count_;
  const std::atomic<bool>* stop_asked_ = nullptr;
};

}  // namespace insonify
