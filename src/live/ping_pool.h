// ping_pool.h -- pool of pings, which reuses the memory of released ones.

#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "insonify/live_loop.h"

namespace insonify {

/// May be asked by one thread while others let go of what it gave. Pings may outlive it.
class PingPool {
 public:
  /// A ping of which nobody else knows, with the tables of an earlier one or new.
  [[nodiscard]] std::shared_ptr<LivePing> take();

 private:
  struct Shelf {
    std::mutex mutex;
    std::vector<std::unique_ptr<LivePing>> pings;
  };
  std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace insonify
