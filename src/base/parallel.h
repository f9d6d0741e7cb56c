// parallel.h -- worker threads that run numbered tasks in parallel. The only file that exposes oneTBB.

#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <type_traits>

namespace insonify {

/// A fixed number of worker threads. Tasks must not depend on which worker runs them; then results do not depend on the
/// number of workers. Running tasks allocates nothing once the threads have been started.
class Workers {
 public:
  static constexpr int kMost = 1024;

  /// @param threads  1 to kMost, or 0 for as many as there are processors.
  /// @throws Error for another number.
  explicit Workers(int threads);
  ~Workers();

  [[nodiscard]] int count() const { return count_; }

  /// Length of the parts that `count` things are divided into, each a task: a multiple of `step` up to `most`, short
  /// enough for some parts a worker.
  [[nodiscard]] int part_length(int count, int step, int most) const {
    constexpr int kPartsPerWorker = 4;
    const int parts = kPartsPerWorker * count_ * step;
    return std::clamp((count + parts - 1) / parts * step, step, most);
  }

  /// One worker: the calling thread. It stops when this object does. For the steps of a task that itself runs in
  /// for_each().
  [[nodiscard]] Workers& alone() { return alone_ ? *alone_ : *this; }

  /// While `*asked` is true, for_each() throws Interrupted, also one that is running, before its next task. Null:
  /// never.
  void stop_when(const std::atomic<bool>* asked) { stop_asked_ = asked; }

  /// For tasks that take long: the same between two parts of a task.
  /// @throws Interrupted
  void check_stop() const {
    const std::atomic<bool>* asked = many_ != nullptr ? many_->stop_asked_ : stop_asked_;
    if (asked != nullptr && asked->load(std::memory_order_relaxed)) {
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
  explicit Workers(const Workers* many);

  std::unique_ptr<Arena> arena_;  // Null for one thread.
  int count_;
  std::unique_ptr<Workers> alone_;  // See alone(); null for one thread.
  const Workers* many_ = nullptr;   // Set in alone_: the workers it stops with.
  const std::atomic<bool>* stop_asked_ = nullptr;
};

}  // namespace insonify
