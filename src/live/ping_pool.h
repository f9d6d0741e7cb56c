// ping_pool.h -- a pool of pings that reuses the memory of released ones.

#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "insonify/live_loop.h"

namespace insonify {

/// One thread may request pings while others release them. Pings may outlive the pool.
class PingPool {
 public:
  /// An unshared ping, new or with the tables of a released one.
  [[nodiscard]] std::shared_ptr<LivePing> take();

 private:
  struct Shelf {
    std::mutex mutex;
    std::vector<std::unique_ptr<LivePing>> pings;
  };
  std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace insonify
