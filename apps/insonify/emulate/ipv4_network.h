// ipv4_network.h -- the network of one of this machine's addresses.

#pragma once

#include <boost/asio/ip/address_v4.hpp>

#include "emulate/emulate.h"

namespace insonify {

struct Ipv4Network {
  boost::asio::ip::address_v4 address, mask;
  boost::asio::ip::address_v4 broadcast;  ///< Broadcast address of its network; on loopback the address itself.
};

/// Reads --address, and warns as address_of().
/// @throws InputError for an invalid IPv4 address; Error for one that this machine does not have.
[[nodiscard]] Ipv4Network network_of(const EmulateOptions& options);

}  // namespace insonify
