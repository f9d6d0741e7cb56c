// oculus_client.cpp -- reads messages from a connection and writes answers without blocking.

#include "emulate/oculus_client.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>

namespace insonify {

using boost::system::error_code;

namespace {

constexpr std::size_t kMostWaitingMessages = 16;  // Messages other than pings.

}  // namespace

OculusClient::OculusClient(Socket socket, Events events) : socket_(std::move(socket)), events_(std::move(events)) {
  error_code ignored;  // These options are optional: they make a connection faster, or end a dead one.
  socket_.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  socket_.set_option(boost::asio::socket_base::keep_alive(true), ignored);
  if (const auto remote = socket_.remote_endpoint(ignored); !ignored && remote.address().is_v4()) {
    address_ = remote.address().to_v4();
  }
}

void OculusClient::read() {
  socket_.async_read_some(boost::asio::buffer(in_), [self = shared_from_this()](error_code failure, std::size_t size) {
    if (failure) {
      self->end();
      return;
    }
    self->last_heard_ = std::chrono::steady_clock::now();
    const std::uint64_t skipped = self->parser_.skipped();
    self->parser_.add(std::span(self->in_).first(size));
    while (const std::optional<OculusMessage> message = self->parser_.next()) {
      self->events_.message(*self, *message);
    }
    if (self->parser_.skipped() != skipped) {
      self->events_.skipped(*self, self->parser_.skipped() - skipped);
    }
    if (!self->ended_) {
      self->read();
    }
  });
}

bool OculusClient::send_ping(Bytes bytes) {
  if (ended_) {
    return true;
  }
  const bool replaced = ping_ != nullptr;
  ping_ = std::move(bytes);
  if (out_.empty()) {
    write();
  }
  return !replaced;
}

bool OculusClient::send(Bytes bytes) {
  if (ended_ || out_.size() >= kMostWaitingMessages) {
    return ended_;
  }
  out_.push_back(std::move(bytes));
  if (out_.size() == 1) {
    write();
  }
  return true;
}

void OculusClient::write() {
  if (out_.empty()) {
    out_.push_back(std::move(ping_));
    ping_ = nullptr;
  }
  boost::asio::async_write(socket_, boost::asio::buffer(*out_.front()),
                           [self = shared_from_this()](error_code failure, std::size_t) {
                             if (failure) {
                               self->end();
                               return;
                             }
                             self->out_.pop_front();
                             if (!self->ended_ && (!self->out_.empty() || self->ping_ != nullptr)) {
                               self->write();
                             }
                           });
}

void OculusClient::close() {
  ended_ = true;
  error_code ignored;  // It is closed in any case.
  socket_.close(ignored);
}

void OculusClient::end() {
  if (!ended_) {
    close();
    events_.gone(*this);
  }
}

}  // namespace insonify
