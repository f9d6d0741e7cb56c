// own_addresses.h -- addresses at which other machines reach this one.

#pragma once

#include <string>
#include <vector>

namespace insonify {

/// Numeric addresses of the active network interfaces except loopback and link-local ones: IPv4, then IPv6 if
/// requested. The name of this machine if there are none.
[[nodiscard]] std::vector<std::string> own_addresses(bool with_ipv6);

}  // namespace insonify
