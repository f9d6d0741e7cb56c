// ping_pool.h -- a pool of pings that reuses the memory of released ones: a ping returns to it with its last reference.

#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "insonify/live_loop.h"

namespace insonify {

/// One thread may request pings while others release them. Pings may outlive the pool.
class PingPool {
 public:
  /// An unshared ping, new or with the tables of a released one.
  [[nodiscard]] std::shared_ptr<LivePing> take() {
    std::unique_ptr<LivePing> ping;
    {
      const std::lock_guard lock(shelf_->mutex);
      if (!shelf_->pings.empty()) {
        ping = std::move(shelf_->pings.back());
        shelf_->pings.pop_back();
      }
    }
    if (!ping) {
      ping = std::make_unique<LivePing>();
    }
    const auto put_back = [shelf = shelf_](LivePing* used) {
      constexpr std::size_t kMost = 16;
      std::unique_ptr<LivePing> owned(used);
      owned->world.reset();
      const std::lock_guard lock(shelf->mutex);
      if (shelf->pings.size() < kMost) {
        shelf->pings.push_back(std::move(owned));
      }
    };
    return {ping.release(), put_back};
  }

 private:
  struct Shelf {
    std::mutex mutex;
    std::vector<std::unique_ptr<LivePing>> pings;
  };
  std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace insonify
