// stream_client.cpp -- reads frames from a connection, and writes others without blocking.

#include "emulate/stream_client.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <utility>

namespace insonify {

using boost::system::error_code;

void StreamClient::read() {
  socket_.async_read_some(boost::asio::buffer(in_), [self = shared_from_this()](error_code failure, std::size_t size) {
    if (failure) {
      self->end();
      return;
    }
    self->parser_.add(std::span(self->in_).first(size));
    while (const std::optional<PingEvent> event = self->parser_.next()) {
      self->events_.event(*self, *event);
    }
    self->read();
  });
}

bool StreamClient::send(const std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t kMostWaiting = 1 << 20;
  if (ended_ || out_.size() + bytes.size() > kMostWaiting) {
    return ended_;
  }
  out_.insert(out_.end(), bytes.begin(), bytes.end());
  if (writing_.empty()) {
    write();
  }
  return true;
}

void StreamClient::write() {
  writing_ = std::exchange(out_, {});
  boost::asio::async_write(socket_, boost::asio::buffer(writing_),
                           [self = shared_from_this()](error_code failure, std::size_t) {
                             self->writing_.clear();
                             if (failure) {
                               self->end();
                             } else if (!self->out_.empty()) {
                               self->write();
                             }
                           });
}

void StreamClient::end() {
  if (!std::exchange(ended_, true)) {
    error_code ignored;  // It is closed in any case.
    socket_.close(ignored);
    events_.gone(*this);
  }
}

}  // namespace insonify
