// ipv4_network.h -- the network that an address of this machine is in.

#pragma once

#include <boost/asio/ip/address_v4.hpp>

#include "emulate/emulate.h"

namespace insonify {

struct Ipv4Network {
  boost::asio::ip::address_v4 address, mask;
  boost::asio::ip::address_v4 broadcast;  ///< Reaches all who should hear of a sonar at `address`: on loopback itself.
};

/// Reads --address, and warns as address_of().
/// @throws InputError for what is no IPv4 address; Error for one that this machine does not have.
[[nodiscard]] Ipv4Network network_of(const EmulateOptions& options);

}  // namespace insonify
