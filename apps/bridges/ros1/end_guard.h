// end_guard.h -- limits the time that a program takes to exit.

#pragma once

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "console/outcome.h"

namespace insonify {

/// Exits the program, with success, unless it is destroyed in time. A roscore that runs but does not answer blocks
/// calls of roscpp for minutes.
class EndGuard {
 public:
  /// @param last_words  Called before exiting, unless said() was.
  explicit EndGuard(std::function<void()> last_words) : last_words_(std::move(last_words)) {}
  ~EndGuard() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  EndGuard(const EndGuard&) = delete;
  EndGuard& operator=(const EndGuard&) = delete;

  void said() {
    const std::lock_guard lock(mutex_);
    said_ = true;
  }

 private:
  void watch() {
    constexpr std::chrono::milliseconds kPatience{600};
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, kPatience, [this] { return done_; })) {
      return;
    }
    if (!said_) {
      last_words_();
    }
    _exit(kDone);
  }

  std::function<void()> last_words_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool said_ = false, done_ = false;
  std::thread thread_{[this] { watch(); }};
};

}  // namespace insonify
