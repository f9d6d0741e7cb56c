// own_addresses.h -- addresses under which other machines reach this one.

#pragma once

#include <string>
#include <vector>

namespace insonify {

/// Numeric addresses of the network interfaces that are up, without loopback and link-local ones: IPv4, and after
/// them IPv6 where that is wanted. Where there is none, the name of this machine.
[[nodiscard]] std::vector<std::string> own_addresses(bool with_ipv6);

}  // namespace insonify
