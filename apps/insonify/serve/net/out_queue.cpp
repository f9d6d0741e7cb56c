// out_queue.cpp -- bounds the queue of a slow client.

#include "serve/net/out_queue.h"

#include <algorithm>

namespace insonify {
namespace {

constexpr std::size_t kMostWaiting = std::size_t{64} * 1024 * 1024;  // Without pings [bytes].

}  // namespace

bool OutQueue::push(OutMessage message) {
  if (message.droppable) {
    const auto first = messages_.begin() + (sending_ ? 1 : 0);
    const auto is_alike = [&](const OutMessage& one) { return one.droppable && one.stream == message.stream; };
    if (static_cast<std::size_t>(std::count_if(first, messages_.end(), is_alike)) >= kQueuedPings) {
      messages_.erase(std::find_if(first, messages_.end(), is_alike));
      ++dropped_;
    }
  } else {
    waiting_bytes_ += message.bytes->size();
    if (waiting_bytes_ > kMostWaiting) {
      return false;
    }
  }
  messages_.push_back(std::move(message));
  return true;
}

const OutMessage& OutQueue::begin_sending() {
  sending_ = true;
  sent_ = messages_.front();
  return sent_;
}

void OutQueue::end_sending() {
  sending_ = false;
  if (messages_.empty()) {
    return;
  }
  if (!messages_.front().droppable) {
    waiting_bytes_ -= messages_.front().bytes->size();
  }
  messages_.pop_front();
}

void OutQueue::drop_pings() {
  const auto first = messages_.begin() + (sending_ ? 1 : 0);
  messages_.erase(std::remove_if(first, messages_.end(), [](const OutMessage& one) { return one.droppable; }),
                  messages_.end());
}

}  // namespace insonify
