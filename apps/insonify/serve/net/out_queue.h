// out_queue.h -- the queue of messages to one client.

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "serve/net/net_server.h"

namespace insonify {

/// First in, first out; drops the oldest pings of a stream.
class OutQueue {
 public:
  /// Adds a message. If kQueuedPings of its stream are queued, a ping replaces the oldest that is not being
  /// sent.
  /// @return  False if too many bytes other than pings are queued.
  [[nodiscard]] bool push(OutMessage message);

  [[nodiscard]] bool empty() const { return messages_.empty(); }

  /// Returns the first message for sending.
  [[nodiscard]] const OutMessage& begin_sending();
  /// Removes the message that has been sent.
  void end_sending();
  [[nodiscard]] bool sending() const { return sending_; }

  /// Drops the pings that are not being sent.
  void drop_pings();
  void clear() { messages_.clear(); }

  /// Number of dropped pings.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  std::deque<OutMessage> messages_;
  OutMessage sent_;  // Kept alive while it is being sent.
  bool sending_ = false;
  std::size_t waiting_bytes_ = 0;  // Without pings.
  std::uint64_t dropped_ = 0;
};

}  // namespace insonify
