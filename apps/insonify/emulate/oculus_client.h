// oculus_client.h -- one TCP connection of an emulated Oculus.

#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>

#include "insonify/wire/oculus_messages.h"

namespace insonify {

/// Lives until the connection ends: pending reads and writes own it.
class OculusClient : public std::enable_shared_from_this<OculusClient> {
 public:
  using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;
  using Socket = boost::asio::ip::tcp::socket;

  struct Events {
    std::function<void(OculusClient&, const OculusMessage&)> message;
    std::function<void(OculusClient&, std::uint64_t bytes)> skipped;  ///< Bytes that are not a message.
    std::function<void(OculusClient&)> gone;                          ///< Once, at the end of the connection.
  };

  OculusClient(Socket socket, Events events);

  /// Starts to read.
  void start() { read(); }

  /// Sends a ping result. Replaces an earlier one that is still queued because the client reads too slowly.
  /// @return  Whether none was replaced.
  bool send_ping(Bytes bytes);

  /// Sends another message. @return  False if the queue is full.
  bool send(Bytes bytes);

  /// Ends the connection, without calling Events::gone.
  void close();

  /// Ends the connection, and calls Events::gone.
  void end();

  /// When it last sent something, or connected.
  [[nodiscard]] std::chrono::steady_clock::time_point last_heard() const { return last_heard_; }

  [[nodiscard]] const boost::asio::ip::address_v4& address() const { return address_; }

  int layout = 1;  ///< Layout of the messages that this client sends and receives.

 private:
  void read();
  void write();

  Socket socket_;
  Events events_;
  boost::asio::ip::address_v4 address_;
  std::array<std::uint8_t, 4096> in_ = {};
  OculusParser parser_;
  std::deque<Bytes> out_;  // The first is being written.
  Bytes ping_;             // To be written after these.
  bool ended_ = false;
  std::chrono::steady_clock::time_point last_heard_ = std::chrono::steady_clock::now();
};

}  // namespace insonify
