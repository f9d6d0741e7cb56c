// ping_pool.cpp -- returns a ping to the pool when its last reference is released.

#include "live/ping_pool.h"

#include <utility>

namespace insonify {

std::shared_ptr<LivePing> PingPool::take() {
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

}  // namespace insonify
