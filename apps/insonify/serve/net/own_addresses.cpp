// own_addresses.cpp -- lists the addresses of the network interfaces.

#include "serve/net/own_addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <array>

namespace insonify {
namespace {

bool is_link_local(const sockaddr& address) {
  if (address.sa_family == AF_INET) {
    constexpr in_addr_t kMask = 0xffff0000, kLinkLocal = 0xa9fe0000;  // 169.254.0.0/16, RFC 3927.
    return (ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr) & kMask) == kLinkLocal;
  }
  return IN6_IS_ADDR_LINKLOCAL(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr);
}

std::vector<std::string> addresses_of(const ifaddrs* interfaces, int family, socklen_t size) {
  std::vector<std::string> found;
  for (const ifaddrs* one = interfaces; one != nullptr; one = one->ifa_next) {
    const bool serves = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_LOOPBACK) == 0;
    if (!serves || one->ifa_addr == nullptr || one->ifa_addr->sa_family != family || is_link_local(*one->ifa_addr)) {
      continue;
    }
    std::array<char, NI_MAXHOST> text{};
    if (getnameinfo(one->ifa_addr, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) == 0) {
      found.emplace_back(text.data());
    }
  }
  return found;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data() : "localhost";
}

}  // namespace

std::vector<std::string> own_addresses(bool with_ipv6) {
  std::vector<std::string> found;
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) == 0) {
    found = addresses_of(interfaces, AF_INET, sizeof(sockaddr_in));
    if (with_ipv6) {
      const std::vector<std::string> more = addresses_of(interfaces, AF_INET6, sizeof(sockaddr_in6));
      found.insert(found.end(), more.begin(), more.end());
    }
    freeifaddrs(interfaces);
  }
  if (found.empty()) {
    found.push_back(host_name());
  }
  return found;
}

}  // namespace insonify
