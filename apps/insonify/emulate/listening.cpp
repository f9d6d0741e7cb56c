// listening.cpp -- reads --address and finds the network interface that has it; polls for requests to stop and to print
// the report.

#include "emulate/listening.h"

#include <ifaddrs.h>
#include <netinet/in.h>

#include <memory>

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "insonify/interrupted.h"

namespace insonify {

using boost::asio::ip::address_v4;

namespace {

// @return  0.0.0.0 for an address that is absent or not IPv4.
address_v4 ipv4_of(const sockaddr* address) {
  if (address == nullptr || address->sa_family != AF_INET) {
    return {};
  }
  return address_v4(ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr));
}

}  // namespace

boost::asio::ip::address address_of(const EmulateOptions& options) {
  boost::system::error_code failure;
  auto address = boost::asio::ip::make_address(options.address == "localhost" ? "127.0.0.1" : options.address, failure);
  if (failure) {
    throw InputError(fmt::format("--address {} must be an IP address, such as 127.0.0.1 or ::1, or localhost",
                                 printable(options.address)));
  }
  if (!address.is_loopback()) {
    complain(fmt::format("warning: whoever reaches {} can command this sonar: its protocol knows no password",
                         printable(options.address)));
  }
  return address;
}

Ipv4Network network_with(const address_v4& address) {
  if (address.is_loopback()) {
    return {address, address_v4(0xff000000U), address};
  }
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) {
    throw Error("cannot list the network interfaces of this machine");
  }
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> interfaces(first, &freeifaddrs);
  for (const ifaddrs* interface = first; interface != nullptr; interface = interface->ifa_next) {
    if (ipv4_of(interface->ifa_addr) == address) {
      const address_v4 mask = ipv4_of(interface->ifa_netmask);
      return {address, mask, address_v4(address.to_uint() | ~mask.to_uint())};
    }
  }
  throw Error(fmt::format("--address {}: no network interface of this machine has it", address.to_string()));
}

Ipv4Network network_of(const EmulateOptions& options) {
  const boost::asio::ip::address address = address_of(options);
  if (!address.is_v4() || address.is_unspecified()) {
    throw InputError(fmt::format("--address {} must be one IPv4 address: the sonar sends it in its status messages",
                                 printable(options.address)));
  }
  return network_with(address.to_v4());
}

void EventLoop::run() {
  watch_signals();
  try {
    context_.run();
  } catch (const Interrupted&) {
    // SIGINT during a ping.
  }
}

void EventLoop::watch_signals() {
  if (report_asked()) {
    say("{}\n", report_.text());
    flush_output();
  }
  constexpr std::chrono::milliseconds kInterval{50};
  timer_.expires_after(kInterval);
  timer_.async_wait([this](boost::system::error_code) { stop_asked() ? context_.stop() : watch_signals(); });
}

}  // namespace insonify
