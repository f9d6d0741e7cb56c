// listening.h -- what emulated instruments share: the address that they listen on, and their event loop.

#pragma once

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/address_v4.hpp>
#include <boost/asio/steady_timer.hpp>
#include <string>

#include "emulate/emulate.h"
#include "transport/transport_report.h"

namespace insonify {

/// Warns if other machines can reach it: instruments' protocols have no password.
/// @throws InputError for an invalid address.
[[nodiscard]] boost::asio::ip::address address_of(const EmulateOptions& options);

struct Ipv4Network {
  boost::asio::ip::address_v4 address, mask;
  boost::asio::ip::address_v4 broadcast;  ///< Broadcast address of its network; on loopback the address itself.
};

/// @throws Error for an address that this machine does not have.
[[nodiscard]] Ipv4Network network_with(const boost::asio::ip::address_v4& address);

/// Reads --address, and warns as address_of().
/// @throws InputError for an invalid IPv4 address; Error for one that this machine does not have.
[[nodiscard]] Ipv4Network network_of(const EmulateOptions& options);

/// "127.0.0.1:9092", "[::1]:9092"
template <typename Endpoint>
[[nodiscard]] std::string endpoint_text(const Endpoint& endpoint) {
  const std::string host = endpoint.address().to_string();
  return endpoint.address().is_v6() ? fmt::format("[{}]:{}", host, endpoint.port())
                                    : fmt::format("{}:{}", host, endpoint.port());
}

class EventLoop {
 public:
  /// @param report  Printed at SIGUSR1; must live as long as the loop.
  explicit EventLoop(const TransportReport& report) : report_(report) {}

  [[nodiscard]] boost::asio::io_context& context() { return context_; }

  /// Runs until SIGINT or SIGTERM, also while a ping is made.
  void run();

 private:
  void watch_signals();

  const TransportReport& report_;
  boost::asio::io_context context_{1};
  boost::asio::steady_timer timer_{context_};
};

}  // namespace insonify
