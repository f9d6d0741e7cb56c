// listen_address.h -- the address that an emulated instrument listens on, and its network.

#pragma once

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/address_v4.hpp>

#include "emulate/emulate.h"

namespace insonify {

/// Warns if other machines can reach it: instruments' protocols have no password.
/// @throws InputError for an invalid address.
[[nodiscard]] boost::asio::ip::address address_of(const EmulateOptions& options);

struct Ipv4Network {
  boost::asio::ip::address_v4 address, mask;
  boost::asio::ip::address_v4 broadcast;  ///< Broadcast address of its network; on loopback the address itself.
};

/// Reads --address, and warns as address_of().
/// @throws InputError for an invalid IPv4 address; Error for one that this machine does not have.
[[nodiscard]] Ipv4Network network_of(const EmulateOptions& options);

}  // namespace insonify
