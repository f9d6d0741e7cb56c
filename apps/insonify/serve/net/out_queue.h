// out_queue.h -- messages that wait for one client.

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "serve/net/net_server.h"

namespace insonify {

/// First in, first out, where of each stream of pings the oldest fall out.
class OutQueue {
 public:
  /// Adds a message. A ping that finds kQueuedPings of its stream waiting drops the oldest of them; the one that is
  /// being sent stays.
  /// @return  False where too many bytes other than pings wait.
  [[nodiscard]] bool push(OutMessage message);

  [[nodiscard]] bool empty() const { return messages_.empty(); }

  /// Begins to send the first message.
  [[nodiscard]] const OutMessage& begin_sending();
  /// The message is sent: it leaves the queue.
  void end_sending();
  [[nodiscard]] bool sending() const { return sending_; }

  /// Drops the pings that are not being sent.
  void drop_pings();
  void clear() { messages_.clear(); }

  /// Pings that fell out because others came.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  std::deque<OutMessage> messages_;
  OutMessage sent_;  // Stays alive while it is being sent, whatever happens to the queue.
  bool sending_ = false;
  std::size_t waiting_bytes_ = 0;  // Besides pings.
  std::uint64_t dropped_ = 0;
};

}  // namespace insonify
