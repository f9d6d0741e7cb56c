// parallel.h -- worker threads that run numbered tasks. The only door to oneTBB.

#pragma once

#include <memory>
#include <type_traits>

namespace insonify {

/// A fixed number of worker threads. Tasks must not depend on which worker runs them, so that results do not depend on
/// how many there are. Running tasks allocates nothing once the threads are up.
class Workers {
 public:
  /// @param threads  >= 1, or 0 for as many as there are processors.
  explicit Workers(int threads);
  ~Workers();

  [[nodiscard]] int count() const { return count_; }

  /// Calls run(task, worker) for every task in [0, tasks), worker in [0, count()). Returns when all are done; rethrows
  /// the first exception, after which no other task begins.
  ///
  /// Every worker has a block of the tasks, as long as the others', which it takes in order: the same at every call,
  /// so that its part of the memory stays near it. Who is done helps the others. With small tasks at the ends of the
  /// blocks nobody waits long.
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

  struct Arena;
  std::unique_ptr<Arena> arena_;
  int count_;
};

}  // namespace insonify
