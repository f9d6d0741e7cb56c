// ping360_discovery.h -- answers the broadcasts by which clients look for a Ping360.

#pragma once

#include <array>
#include <boost/asio/ip/udp.hpp>
#include <list>

namespace insonify {

/// Clients broadcast "Discovery" to UDP port 30303, and connect to port 12345 of each sonar that answers. It answers
/// from the instrument's socket, so that the answer has the address that the instrument listens on.
class Ping360Discovery {
 public:
  using Udp = boost::asio::ip::udp;

  /// Warns if the ports are taken. @param instrument  Bound to an IPv4 address; must outlive this.
  explicit Ping360Discovery(Udp::socket& instrument);

 private:
  struct Listener {
    explicit Listener(const Udp::socket::executor_type& executor) : socket(executor) {}
    Udp::socket socket;
    std::array<char, 16> text = {};
    Udp::endpoint client = {};
  };

  void listen(const boost::asio::ip::address_v4& address);
  void receive(Listener& listener);
  void answer(const Udp::endpoint& client);

  Udp::socket& instrument_;
  std::list<Listener> listeners_;
};

}  // namespace insonify
