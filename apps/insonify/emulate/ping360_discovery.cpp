// ping360_discovery.cpp -- listens for broadcasts and answers them.

#include "emulate/ping360_discovery.h"

#include <boost/asio/buffer.hpp>
#include <string_view>

#include "console/console.h"
#include "emulate/listening.h"
#include "insonify/wire/ping360.h"

namespace insonify {

using boost::asio::ip::address_v4;
using boost::system::error_code;

namespace {

constexpr unsigned short kDiscoveryPort = 30303;
constexpr std::string_view kQuestion = "Discovery";

}  // namespace

// A socket bound to a broadcast address receives what is sent to that only: programs on this machine that search can
// bind the same port of their own address.
Ping360Discovery::Ping360Discovery(Udp::socket& instrument) : instrument_(instrument) {
  const address_v4 address = instrument.local_endpoint().address().to_v4();
  try {
    if (address.is_unspecified()) {
      listen(address);
    } else {
      listen(address_v4::broadcast());
      listen(network_with(address).broadcast);
    }
  } catch (const std::exception& error) {
    complain(
        fmt::format("warning: searches for a Ping360 are not answered: UDP port {}: {}", kDiscoveryPort, error.what()));
  }
}

void Ping360Discovery::listen(const address_v4& address) {
  Listener& listener = listeners_.emplace_back(instrument_.get_executor());
  listener.socket.open(Udp::v4());
  listener.socket.set_option(boost::asio::socket_base::reuse_address(true));  // For several emulated sonars.
  listener.socket.bind({address, kDiscoveryPort});
  receive(listener);
}

void Ping360Discovery::receive(Listener& listener) {
  listener.socket.async_receive_from(boost::asio::buffer(listener.text), listener.client,
                                     [this, &listener](error_code failure, std::size_t size) {
                                       if (!failure && std::string_view(listener.text.data(), size) == kQuestion) {
                                         answer(listener.client);
                                       }
                                       if (failure != boost::asio::error::operation_aborted) {
                                         receive(listener);
                                       }
                                     });
}

void Ping360Discovery::answer(const Udp::endpoint& client) {
  error_code failure;  // A client that cannot be reached is not answered.
  address_v4 address = instrument_.local_endpoint().address().to_v4();
  if (address
          .is_unspecified()) {  // Connecting a socket says by which of its addresses this machine reaches the client.
    Udp::socket towards(instrument_.get_executor(), Udp::v4());
    towards.connect(client, failure);
    address = towards.local_endpoint(failure).address().to_v4();
  }
  if (!failure) {
    instrument_.send_to(boost::asio::buffer(ping360_introduction(address.to_bytes())), client, 0, failure);
  }
}

}  // namespace insonify
