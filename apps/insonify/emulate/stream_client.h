// stream_client.h -- one TCP connection of an emulated sonar that speaks the ping protocol.

#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <memory>
#include <vector>

#include "insonify/wire/ping_protocol.h"

namespace insonify {

/// Lives until the connection ends: pending reads and writes own it.
class StreamClient : public std::enable_shared_from_this<StreamClient> {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  struct Events {
    std::function<void(StreamClient&, const PingEvent&)> event;
    std::function<void(StreamClient&)> gone;  ///< Once, at the end of the connection.
  };

  StreamClient(Socket socket, Events events) : socket_(std::move(socket)), events_(std::move(events)) {}

  /// Reads until the connection ends.
  void read();

  /// Sends without blocking. @return  False if the client reads too slowly: nothing is sent then.
  bool send(const std::vector<std::uint8_t>& bytes);

 private:
  void write();
  void end();

  Socket socket_;
  Events events_;
  std::array<std::uint8_t, 4096> in_ = {};
  PingParser parser_;
  std::vector<std::uint8_t> out_, writing_;
  bool ended_ = false;
};

}  // namespace insonify
