// ping_pool.h -- a pool of one sonar's pings that Python has released, whose memory the next ones reuse.

#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "bind.h"

namespace insonify::python {

/// Allocating a ping's tables takes as long as computing a small ping. A ping returns to the pool when neither Python
/// nor an array refers to it.
class PingPool : public std::enable_shared_from_this<PingPool> {
 public:
  [[nodiscard]] std::shared_ptr<PythonPing> take() {
    std::unique_ptr<PythonPing> ping;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!unused_.empty()) {
        ping = std::move(unused_.back());
        unused_.pop_back();
      }
    }
    if (ping == nullptr) {
      ping = std::make_unique<PythonPing>();
    }
    const auto give_back = [pool = weak_from_this()](PythonPing* used) {
      std::unique_ptr<PythonPing> own(used);
      if (const std::shared_ptr<PingPool> there = pool.lock()) {
        there->keep(std::move(own));
      }
    };
    return {ping.release(), give_back};
  }

 private:
  void keep(std::unique_ptr<PythonPing> ping) {
    constexpr std::size_t kMost = 2;  // A loop holds the last ping while it makes the next.
    const std::lock_guard<std::mutex> lock(mutex_);
    if (unused_.size() < kMost) {
      unused_.push_back(std::move(ping));
    }
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<PythonPing>> unused_;
};

}  // namespace insonify::python
